//! The parts of a diameter's standard deviation.

/// Parts of the standard deviation of a diameter (mm), added as squares.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parts {
    /// Noise.
    pub noise: f64,
    /// Width of the point spread; signed by the effect of a wider one.
    pub point_spread: f64,
    /// Level and thickness of the wall.
    pub wall: f64,
    /// Level of the lumen.
    pub lumen: f64,
    /// Model errors: uneven surroundings and lumens that are no ellipses.
    pub surroundings: f64,
}

impl Parts {
    pub(crate) fn unknown() -> Self {
        Self::default().map(|_| f64::NAN)
    }

    #[must_use]
    pub(crate) fn with(&self, other: &Self, both: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            noise: both(self.noise, other.noise),
            point_spread: both(self.point_spread, other.point_spread),
            wall: both(self.wall, other.wall),
            lumen: both(self.lumen, other.lumen),
            surroundings: both(self.surroundings, other.surroundings),
        }
    }

    /// Root of the sum of squares.
    pub fn total(&self) -> f64 {
        let Self { noise, point_spread, wall, lumen, surroundings } = self;
        [noise, point_spread, wall, lumen, surroundings].map(|part| part * part).iter().sum::<f64>().sqrt()
    }

    #[must_use]
    pub(crate) fn scaled(&self, by: f64) -> Self {
        self.map(|part| part * by)
    }

    fn map(&self, each: impl Fn(f64) -> f64) -> Self {
        Self {
            noise: each(self.noise),
            point_spread: each(self.point_spread),
            wall: each(self.wall),
            lumen: each(self.lumen),
            surroundings: each(self.surroundings),
        }
    }
}

/// Names a part of [`Parts`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// [`Parts::noise`].
    Noise,
    /// [`Parts::point_spread`].
    PointSpread,
    /// [`Parts::wall`].
    Wall,
    /// [`Parts::lumen`].
    Lumen,
    /// [`Parts::surroundings`].
    Surroundings,
}

impl Part {
    /// All, in the order of tables.
    pub const ALL: [Self; 5] = [Self::Noise, Self::PointSpread, Self::Wall, Self::Lumen, Self::Surroundings];

    /// The name in files and programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Noise => "noise",
            Self::PointSpread => "point_spread",
            Self::Wall => "wall",
            Self::Lumen => "lumen_level",
            Self::Surroundings => "surroundings",
        }
    }

    /// The value of this part (mm, signed).
    pub fn of(self, parts: &Parts) -> f64 {
        match self {
            Self::Noise => parts.noise,
            Self::PointSpread => parts.point_spread,
            Self::Wall => parts.wall,
            Self::Lumen => parts.lumen,
            Self::Surroundings => parts.surroundings,
        }
    }
}

/// Standard deviation of a weighted sum of diameters of one vessel. Errors of point spread, wall and lumen
/// level are common to all places and add with their signs; noise and surroundings are independent.
pub(crate) fn deviation_of_sum(diameters: &[(f64, Parts)]) -> f64 {
    let together =
        |part: Part| diameters.iter().map(|(weight, parts)| weight * part.of(parts)).sum::<f64>().powi(2);
    let apart =
        |part: Part| diameters.iter().map(|(weight, parts)| (weight * part.of(parts)).powi(2)).sum::<f64>();
    let square: f64 = Part::ALL
        .into_iter()
        .map(|part| match part {
            Part::Noise | Part::Surroundings => apart(part),
            Part::PointSpread | Part::Wall | Part::Lumen => together(part),
        })
        .sum();
    square.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_everywhere_is_not_wrong_of_a_difference() {
        let parts = Parts { noise: 0.03, point_spread: -0.1, wall: 0.2, lumen: 0.05, surroundings: 0.04 };
        let same = deviation_of_sum(&[(1.0, parts), (-1.0, parts)]);
        assert!((same - 0.05 * 2.0_f64.sqrt()).abs() < 1e-12);
        assert!((deviation_of_sum(&[(1.0, parts)]) - parts.total()).abs() < 1e-12);
    }
}
