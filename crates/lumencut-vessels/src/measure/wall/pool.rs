//! Pools the wall of a vessel over its sections, which share one level and a slowly varying thickness.

use crate::measure::estimation::Level;
use crate::measure::fit::Fit;
use crate::measure::fit::sections::noise;
use crate::measure::model::ellipse::Ellipse;
use crate::measure::model::wall::{KnownWall, Wall};

/// Distance (mm) over which the weight of a section falls to 1/e; minimum standard deviation of the log thickness.
const EVEN: (f64, f64) = (10.0, 0.1);

/// Minimum standard deviation of the level, as a fraction of the contrast.
const LEAST_LEVEL: f64 = 0.01;

/// Sections within these distances (mm) count as one. The first is for the level, because errors of the model
/// persist along a vessel; the second is for the thickness, because close sections share voxels.
const SHARED_WIDTHS: [f64; 2] = [5.0, 2.0];

/// Minimum fraction of the sections in which the wall must be visible.
const MIN_VISIBLE_WALLS: f64 = 1.0 / 3.0;

/// A fit shows no wall if its residuals exceed this multiple of the median.
const NOT_DESCRIBED: f64 = 2.0;

/// Plaque does not share its level: it differs from the expected one by this multiple of both standard deviations.
const OTHER_LEVEL: f64 = 2.0;

/// Pooled wall at each section. `inflation` is the variance factor of correlated noise, `known` the prior
/// used in the fits, and `expected` the current prior level, which other vessels may have refined.
pub(crate) fn pooled(
    at: &[f64],
    fits: &[Option<Fit>],
    known: &KnownWall,
    expected: Level,
    inflation: f64,
) -> Vec<KnownWall> {
    let apart = independent(at, SHARED_WIDTHS[1]) / inflation;
    let most = NOT_DESCRIBED * noise(fits);
    let shown = |(at, fit): (&f64, &Option<Fit>)| {
        let fit = fit.filter(|fit| fit.missed <= most)?;
        Some((*at, fit.ellipse, fit.wall?))
    };
    let walls: Vec<(f64, Ellipse, Wall)> = at.iter().zip(fits).filter_map(shown).collect();
    let is_usual = |wall: &Wall| own_level(wall, known).is_none_or(|own| !is_other(own, known.level));
    let [mean, deviation] =
        level_by(at, fits, (known, WeightedLevel::new(expected)), inflation, is_usual).level();
    let level = [mean, deviation.max(LEAST_LEVEL)];
    let thickness = |here: f64, lumen: &Ellipse| {
        let first = known.beforehand(lumen);
        let mut weighted = WeightedLevel::new(first);
        let (mut slopes, mut shares) = (0.0, f64::MIN_POSITIVE);
        for (there, other, wall) in &walls {
            let weight = (-(there - here).abs() / EVEN.0).exp() * apart;
            // Pools the difference from the thickness that the lumen width predicts.
            let [mean, deviation] = wall.log_thickness_at(level[0]);
            weighted.add([mean - known.beforehand(other)[0] + first[0], deviation], first, weight);
            let share = weight / deviation.powi(2);
            (slopes, shares) = (slopes + share * wall.slope, shares + share);
        }
        let [mean, deviation] = weighted.level();
        ([mean, deviation.max(EVEN.1)], slopes / shares)
    };
    at.iter()
        .zip(fits)
        .map(|(at, fit)| {
            let thickness = fit.map(|fit| thickness(*at, &fit.ellipse));
            let slope = thickness.map_or(0.0, |(_, slope)| slope);
            KnownWall { level, log_thickness: thickness.map(|(thickness, _)| thickness), slope, ..*known }
        })
        .collect()
}

/// Wall level without the prior `known`, as a fraction of the contrast; None if the sections do not show it.
pub(crate) fn unpooled_level(
    at: &[f64],
    fits: &[Option<Fit>],
    known: &KnownWall,
    inflation: f64,
) -> Option<Level> {
    let weighted =
        level_by(at, fits, (known, WeightedLevel { precision: 0.0, weighted: 0.0 }), inflation, |_| true);
    let [mean, deviation] = weighted.level();
    (weighted.precision > 0.0).then_some([mean, deviation.max(LEAST_LEVEL)])
}

fn level_by(
    at: &[f64],
    fits: &[Option<Fit>],
    (known, mut first): (&KnownWall, WeightedLevel),
    inflation: f64,
    is_one: impl Fn(&Wall) -> bool,
) -> WeightedLevel {
    let apart = independent(at, SHARED_WIDTHS[0]) / inflation;
    let most = NOT_DESCRIBED * noise(fits);
    for wall in fits.iter().flatten().filter(|fit| fit.missed <= most).filter_map(|fit| fit.wall) {
        if is_one(&wall) {
            first.add(wall.level, known.level, apart);
        }
    }
    first
}

fn own_level(wall: &Wall, known: &KnownWall) -> Option<Level> {
    let mut own = WeightedLevel { precision: 0.0, weighted: 0.0 };
    own.add(wall.level, known.level, 1.0);
    (own.precision > 0.0).then(|| own.level())
}

fn is_other([level, deviation]: Level, [expected, unsure]: Level) -> bool {
    (level - expected).abs() > OTHER_LEVEL * deviation.hypot(unsure)
}

pub(crate) fn is_apart(known: &KnownWall, pooled: &[KnownWall], fits: &[Option<Fit>]) -> bool {
    let is_apart = |(wall, fit): (&KnownWall, &Option<Fit>)| {
        fit.map(|fit| (wall.level[0] - fit.background).abs() > known.level[1])
    };
    let all: Vec<bool> = pooled.iter().zip(fits).filter_map(is_apart).collect();
    all.iter().filter(|is| **is).count() as f64 >= MIN_VISIBLE_WALLS * all.len() as f64
}

/// Fraction of a section's information that neighbouring sections do not repeat.
fn independent(at: &[f64], shared: f64) -> f64 {
    let length = at.last().zip(at.first()).map_or(0.0, |(last, first)| last - first);
    let step = length / (at.len().max(2) - 1) as f64;
    (step / shared).min(1.0)
}

struct WeightedLevel {
    precision: f64,
    weighted: f64,
}

impl WeightedLevel {
    fn new([mean, deviation]: Level) -> Self {
        let precision = 1.0 / (deviation * deviation);
        Self { precision, weighted: mean * precision }
    }

    /// Adds what a section shows beyond the prior `before` of its fit, multiplied by `weight`.
    fn add(&mut self, level: Level, before: Level, weight: f64) {
        let [after, prior] = [level, before].map(Self::new);
        let precision = (after.precision - prior.precision).max(0.0);
        if precision > 0.0 {
            self.precision += weight * precision;
            self.weighted += weight * (after.weighted - prior.weighted);
        }
    }

    fn level(&self) -> Level {
        [self.weighted / self.precision, (1.0 / self.precision).sqrt()]
    }
}
