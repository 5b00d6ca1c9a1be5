//! Fits a blurred ellipse to the voxels of a section.

pub(crate) mod fitting;
pub(crate) mod sections;
pub(crate) mod stable_fit;
pub(crate) mod sums;

use std::marker::PhantomData;

use self::sums::{Missing, Moves, Sums};
use crate::measure::estimation::least_squares::{Minimum, Normal, minimum, solved, variance};
use crate::measure::estimation::{Term, unit};
use crate::measure::model::ellipse::{Ellipse, SHAPE, Whitening};
use crate::measure::model::parameters::{
    BACKGROUND, HARMONICS, LUMEN, PLAIN, SECTORS, THICKNESS, WALL, WALLED,
};
use crate::measure::model::wall::{KnownWall, Wall};
use crate::measure::model::{Model, ThreeLevels, TwoLevels};
use crate::measure::section::slab::Samples;
use crate::measure::uncertainty::Parts;
use crate::measure::uncertainty::texture::Texture;
use lumencut_core::math::lanes::{FAN, Isa, dispatch};
use lumencut_core::math::statistics::median;

/// Tukey's biweight gives weight 0 to residuals above this multiple of their standard deviation.
const TUKEY: f64 = 5.0;

/// Maximum number of steps before, and after, the samples are reweighted.
const STEPS: [usize; 2] = [12, 8];

/// Σw² / Σw for weights w that fall linearly to 0: a fit gives the variance σ² / Σw, but a mean has σ² Σw² / (Σw)².
const EVENLY_FALLING: f64 = 2.0 / 3.0;

/// Prior knowledge for a fit: means and standard deviations. Levels are fractions of the contrast.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expected<'a> {
    pub lumen: [f64; 2],
    pub background: [f64; 2],
    /// Standard deviation of the relative difference between the semi-axes; the mean difference is 0.
    pub stretch: f64,
    pub noise: f64,
    /// Whether `noise` is only a guess, which the typical residual may replace.
    pub(crate) is_guessed: bool,
    /// The wall's prior; None if the wall cannot be separated from the surroundings.
    pub wall: Option<KnownWall>,
    /// Data for the uncertainty of the diameter; None if it is not wanted.
    pub unsure: Option<&'a Unsure<'a>>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Unsure<'a> {
    pub texture: &'a Texture,
    /// The blur of a point spread that is wider by one standard deviation; None if its width is known exactly.
    pub wider: Option<Whitening>,
    /// A wall that may exist, if none can be separated from the surroundings.
    pub wall: Option<KnownWall>,
}

/// Standard deviations of the harmonics with which the surroundings vary by direction (fractions of the contrast).
const SIDES: [f64; HARMONICS] = [0.3, 0.3, 0.15, 0.15, 0.1, 0.1];

/// Maximum shift of the centre (radii), and range of the size relative to the start of the fit.
const TRUSTED: (f64, [f64; 2]) = (1.0, [0.15, 2.0]);

#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    pub ellipse: Ellipse,
    /// Intensity level of the lumen and its standard deviation, as fractions of the contrast.
    pub lumen: [f64; 2],
    pub background: f64,
    pub wall: Option<Wall>,
    /// Root mean square of the residuals (fraction of the contrast). It is the noise if the lumen is an ellipse.
    pub(crate) missed: f64,
    /// Standard deviation of the equivalent diameter (mm); NaN if not requested.
    pub uncertainty: f64,
    pub parts: Parts,
    /// Fraction of directions in which nothing obstructs the wall.
    pub free: f64,
    /// Second solution, given if a fit restarted from its own result finds another ellipse (ambiguous lumen).
    pub other: Option<Ellipse>,
}

impl Fit {
    /// Fits an ellipse from `start`; None if there are too few samples or no ellipse fits.
    pub(crate) fn new(
        samples: &Samples,
        whitening: Whitening,
        start: &Ellipse,
        expected: &Expected,
    ) -> Option<Self> {
        let Some(known) = expected.wall else {
            let work = Work::<TwoLevels, PLAIN>::new(samples, whitening, start, expected, plain(expected));
            let (minimum, missed, parts) = work.done()?;
            return Self::of(&minimum, missed, parts);
        };
        let terms = walled(expected, &known, start);
        let (minimum, missed, parts) =
            Work::<ThreeLevels, WALLED>::new(samples, whitening, start, expected, terms).done()?;
        let wall = Wall::new(&minimum, start.center)?;
        Some(Self { wall: Some(wall), ..Self::of(&minimum, missed, parts)? })
    }

    fn of<const N: usize>(minimum: &Minimum<N>, missed: f64, parts: Parts) -> Option<Self> {
        let at = &minimum.at;
        Some(Self {
            ellipse: Ellipse::from_parameters(at)?,
            lumen: [at[LUMEN], deviation(minimum, &unit(LUMEN))?],
            background: at[BACKGROUND],
            wall: None,
            missed,
            uncertainty: parts.total(),
            parts,
            free: 1.0,
            other: None,
        })
    }

    /// [`Fit::missed`] of a fit from `start` without the steps after reweighting.
    pub(crate) fn missed_by(
        samples: &Samples,
        whitening: Whitening,
        start: &Ellipse,
        expected: &Expected,
    ) -> Option<f64> {
        match expected.wall {
            None => Work::<TwoLevels, PLAIN>::new(samples, whitening, start, expected, plain(expected))
                .weighed()
                .map(|(_, missed)| missed),
            Some(known) => {
                let terms = walled(expected, &known, start);
                Work::<ThreeLevels, WALLED>::new(samples, whitening, start, expected, terms)
                    .weighed()
                    .map(|(_, missed)| missed)
            }
        }
    }

    pub(crate) fn missing(&self, samples: &Samples, whitening: Whitening) -> Vec<[f32; FAN]> {
        let levels = [self.lumen[0], self.background];
        match &self.wall {
            Some(wall) => missing(samples, &ThreeLevels::of(&self.ellipse, wall, levels, whitening)),
            None => missing(samples, &TwoLevels::of(&self.ellipse, levels, whitening)),
        }
    }

    /// Adds the difference between the diameters of two equally plausible fits to the uncertainty.
    #[must_use]
    pub(crate) fn or(mut self, other: &Self) -> Self {
        let apart = self.ellipse.equivalent_diameter() - other.ellipse.equivalent_diameter();
        self.parts.surroundings = self.parts.surroundings.hypot(apart);
        self.uncertainty = self.parts.total();
        self
    }
}

fn plain<const N: usize>(expected: &Expected) -> Vec<Term<N>> {
    vec![Term::one(LUMEN, expected.lumen), Term::one(BACKGROUND, expected.background)]
}

/// Priors for the model with a wall, and with surroundings that differ from side to side.
fn walled(expected: &Expected, known: &KnownWall, start: &Ellipse) -> Vec<Term<WALLED>> {
    let mut terms = plain(expected);
    terms.push(Term::one(WALL, known.level));
    let thickness = Term::one(THICKNESS, known.log_thickness(start));
    terms.push(thickness.less(WALL, known.slope, known.level[0]));
    terms.extend(SIDES.into_iter().enumerate().map(|(h, side)| Term::one(SECTORS + h, [0.0, side])));
    terms
}

fn missing<M: Model<N>, const N: usize>(samples: &Samples, model: &M) -> Vec<[f32; FAN]> {
    dispatch(Isa::widest(), Missing { samples, model })
}

fn deviation<const N: usize>(minimum: &Minimum<N>, by: &[f64; N]) -> Option<f64> {
    let square = variance(&minimum.normal.matrix, by)?;
    square.is_finite().then(|| (square * EVENLY_FALLING).sqrt())
}

fn diameter_by<const N: usize>(ellipse: &Ellipse) -> [f64; N] {
    let diameter = ellipse.equivalent_diameter();
    let mut by = [0.0; N];
    by[2] = 4.0 * ellipse.mean / diameter;
    by[3] = -4.0 * ellipse.stretch.x / diameter;
    by[4] = -4.0 * ellipse.stretch.y / diameter;
    by
}

struct Work<'a, M, const N: usize> {
    samples: &'a Samples,
    whitening: Whitening,
    expected: &'a Expected<'a>,
    start: &'a Ellipse,
    terms: Vec<Term<N>>,
    /// Weight that reweighting left to each sample; 0 for outliers.
    kept: Vec<[f32; FAN]>,
    model: PhantomData<M>,
}

impl<'a, M: Model<N>, const N: usize> Work<'a, M, N> {
    fn new(
        samples: &'a Samples,
        whitening: Whitening,
        start: &'a Ellipse,
        expected: &'a Expected<'a>,
        terms: Vec<Term<N>>,
    ) -> Self {
        Self { samples, whitening, expected, start, terms, kept: samples.weight.clone(), model: PhantomData }
    }

    /// Best parameters before reweighting and their residual after it; None if there are too few samples.
    fn weighed(&mut self) -> Option<([f64; N], f64)> {
        if self.samples.count < 2 * N {
            return None;
        }
        let mut at = [0.0; N];
        for term in &self.terms {
            at[term.parameter] = term.start;
        }
        at[..SHAPE].copy_from_slice(&self.start.parameters());
        let first = minimum(at, STEPS[0], |at| self.evaluate(at))?;
        let missed = self.weigh(&first.at)?;
        Some((first.at, missed))
    }

    /// Best parameters, root mean square of the residuals, and the parts of the uncertainty if requested.
    fn done(mut self) -> Option<(Minimum<N>, f64, Parts)> {
        let (first, missed) = self.weighed()?;
        let last = minimum(first, STEPS[1], |at| self.evaluate(at))?;
        let parts = match self.expected.unsure {
            Some(unsure) => self.parts(&last, missed, unsure)?,
            None => Parts::unknown(),
        };
        Some((last, missed, parts))
    }

    /// Parts of the uncertainty. Let A be the normal matrix and c the derivatives of the diameter. Then a =
    /// A⁻¹ c gives the shift of the diameter caused by each sample and each prior.
    fn parts(&self, minimum: &Minimum<N>, missed: f64, unsure: &Unsure) -> Option<Parts> {
        let ellipse = Ellipse::from_parameters(&minimum.at)?;
        let towards = solved(&minimum.normal.matrix, &diameter_by(&ellipse))?;
        let expected = self.expected;
        let model = self.model(&minimum.at, &ellipse);
        let weight = 1.0 / expected.noise.powi(2);
        let towards_shares = towards.map(|share| (share * weight) as f32);
        let kernel =
            Moves { samples: self.samples, kept: &self.kept, model: &model, towards: towards_shares };
        let moves = dispatch(Isa::widest(), kernel);
        let noise = expected.noise * unsure.texture.variance(self.samples, &moves).sqrt();
        // Residuals above the noise mean that the lumen is no ellipse or that the surroundings are uneven.
        let excess = (missed / expected.noise).max(1.0);
        let wall = match unsure.wall {
            Some(hidden) => self.moved(&moves, &model, &self.with_wall(&minimum.at, &ellipse, &hidden)),
            None => self.expectations(&towards, |n| n == WALL || n == THICKNESS),
        };
        let point_spread = unsure.wider.map_or(0.0, |wider| {
            let blurred = M::new(&minimum.at, &ellipse, wider, self.start.center);
            self.moved(&moves, &model, &blurred)
        });
        let parts = Parts {
            noise,
            point_spread,
            wall,
            lumen: self.expectations(&towards, |n| n == LUMEN),
            surroundings: noise * (excess * excess - 1.0).sqrt(),
        };
        parts.total().is_finite().then_some(parts)
    }

    /// Error of the diameter (mm) if the priors that `of` selects are wrong by one standard deviation.
    fn expectations(&self, towards: &[f64; N], of: impl Fn(usize) -> bool) -> f64 {
        let own = self.terms.iter().filter(|term| of(term.parameter));
        let moved = |term: &Term<N>| (0..N).map(|n| term.by[n] * towards[n]).sum::<f64>() / term.level[1];
        own.map(|term| moved(term).powi(2)).sum::<f64>().sqrt()
    }

    /// The model with a wall that is brighter than its surroundings by a plausible amount.
    fn with_wall(&self, at: &[f64; N], ellipse: &Ellipse, hidden: &KnownWall) -> ThreeLevels {
        let [level, deviation] = hidden.level;
        let brighter = at[BACKGROUND] + deviation.hypot(level - at[BACKGROUND]);
        let wall = Wall::assumed([brighter, deviation], hidden.log_thickness(ellipse), self.start.center);
        ThreeLevels::of(ellipse, &wall, [at[LUMEN], at[BACKGROUND]], self.whitening)
    }

    /// Shift of the diameter (mm) if the true image is `other` instead of `model`.
    fn moved<O: Model<P>, const P: usize>(&self, moves: &[[f32; FAN]], model: &M, other: &O) -> f64 {
        let (own, others) = (missing(self.samples, model), missing(self.samples, other));
        let mut sum = 0.0;
        for (n, moves) in moves.iter().enumerate() {
            for l in 0..FAN {
                sum += f64::from(moves[l] * (others[n][l] - own[n][l]));
            }
        }
        sum
    }

    fn model(&self, at: &[f64; N], ellipse: &Ellipse) -> M {
        M::new(at, ellipse, self.whitening, self.start.center)
    }

    fn evaluate(&self, at: &[f64; N]) -> Option<Normal<N>> {
        let ellipse = Ellipse::from_parameters(at).filter(|ellipse| self.trusts(ellipse) && M::allows(at))?;
        let model = self.model(at, &ellipse);
        let kernel = Sums { samples: self.samples, kept: &self.kept, model: &model };
        let mut normal = dispatch(Isa::widest(), kernel);
        let weight = 1.0 / self.expected.noise.powi(2);
        normal.cost *= weight;
        normal.slope = normal.slope.map(|slope| slope * weight);
        normal.matrix = normal.matrix.map(|row| row.map(|product| product * weight));
        for term in &self.terms {
            normal.expect(&term.by, term.missing(at), term.level[1]);
        }
        let deviation = self.expected.stretch * ellipse.mean;
        normal.expect(&unit(3), -at[3], deviation);
        normal.expect(&unit(4), -at[4], deviation);
        Some(normal)
    }

    /// Standard deviation of a normal distribution whose median absolute residual equals that of the samples.
    fn typical(&self, missing: &[[f32; FAN]]) -> Option<f64> {
        let weights = self.samples.weight.iter().flatten();
        let mut all: Vec<f64> = missing
            .iter()
            .flatten()
            .zip(weights)
            .filter(|(_, weight)| **weight > 0.0)
            .map(|(missing, _)| f64::from(missing.abs()))
            .collect();
        median(&mut all).map(|middle| 1.4826 * middle)
    }

    fn trusts(&self, ellipse: &Ellipse) -> bool {
        let (far, [small, large]) = TRUSTED;
        let size = ellipse.mean / self.start.mean;
        ellipse.center.distance(self.start.center) <= far * self.start.semi_axes()[1]
            && (small..=large).contains(&size)
    }

    /// Reweights the samples by their residuals; returns the root mean square of those that keep weight.
    fn weigh(&mut self, at: &[f64; N]) -> Option<f64> {
        let model = self.model(at, &Ellipse::from_parameters(at)?);
        let missing = missing(self.samples, &model);
        let Expected { noise, is_guessed, .. } = *self.expected;
        let scale = TUKEY * if is_guessed { noise.max(self.typical(&missing)?) } else { noise };
        let scale = scale as f32;
        let (mut squares, mut all, mut count) = (0.0, 0.0, 0usize);
        for (n, missing) in missing.iter().enumerate() {
            for l in 0..FAN {
                let share = (missing[l] / scale).abs().min(1.0);
                let tukey = (1.0 - share * share).powi(2);
                let weight = self.samples.weight[n][l];
                self.kept[n][l] = weight * tukey;
                if weight > 0.0 && tukey > 0.0 {
                    squares += f64::from(weight * missing[l] * missing[l]);
                    all += f64::from(weight);
                    count += 1;
                }
            }
        }
        let free = count.checked_sub(N).filter(|free| *free >= N)?;
        Some((squares / all * count as f64 / free as f64).sqrt())
    }
}
