//! The ellipse that, blurred as the volume is, comes nearest to the voxels of a section.

use std::marker::PhantomData;

use super::ellipse::{Boundary, Ellipse, SHAPE, Whitening};
use super::least_squares::{Minimum, Normal, minimum, solved, variance};
use super::model::{Model, ThreeLevels, TwoLevels};
use super::parameters::{BACKGROUND, HARMONICS, LUMEN, PLAIN, SECTORS, THICKNESS, WALL, WALLED};
use super::parts::Parts;
use super::slab::Samples;
use super::sums::{Missing, Moves, Sums};
use super::terms::{Term, unit};
use super::texture::Texture;
use super::wall::{KnownWall, Wall};
use lumencut_core::math::lanes::{FAN, Isa, dispatch};
use lumencut_core::math::statistics::median;

/// Samples that miss by more than this number of standard deviations do not count (Tukey's weights).
const TUKEY: f64 = 5.0;

/// Steps before and after samples are weighed by how much they miss.
const STEPS: [usize; 2] = [12, 8];

/// Weights fall evenly with the distance from the plane: the noise of the weighted mean is smaller than the weights say by this factor.
const EVENLY_FALLING: f64 = 2.0 / 3.0;

/// What is known beforehand: means and standard deviations.
#[derive(Clone, Copy, Debug)]
pub struct Expected<'a> {
    /// The level of the lumen, as a share.
    pub lumen: [f64; 2],
    /// The level of its background, as a share.
    pub background: [f64; 2],
    /// By how much semi-axes differ from their mean, as a share of it: the standard deviation alone, around 0.
    pub stretch: f64,
    /// The noise of a voxel, as a share.
    pub noise: f64,
    /// Whether that is a guess: samples are then weighed by what they miss by and large.
    pub is_guessed: bool,
    /// The wall, where it is told apart from the surroundings.
    pub wall: Option<KnownWall>,
    /// What else makes a diameter unsure, where that is asked.
    pub unsure: Option<&'a Unsure<'a>>,
}

/// What makes a diameter unsure besides what a section tells itself.
#[derive(Clone, Copy, Debug)]
pub struct Unsure<'a> {
    /// The texture of the noise.
    pub texture: &'a Texture,
    /// The blur of a point spread that is wider by its standard deviation; None where it is known.
    pub wider: Option<Whitening>,
    /// The wall that may be there where it is not told apart from the surroundings.
    pub wall: Option<KnownWall>,
}

/// Surroundings differ from side to side by these shares (standard deviations), in the order of the harmonics.
const SIDES: [f64; HARMONICS] = [0.3, 0.3, 0.15, 0.15, 0.1, 0.1];

/// The centre stays within this number of radii of where it began, and the size within these shares of that.
const TRUSTED: (f64, [f64; 2]) = (1.0, [0.15, 2.0]);

/// A fitted section.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    /// The lumen.
    pub ellipse: Ellipse,
    /// Its level, as a share, and the standard deviation of that.
    pub lumen: [f64; 2],
    /// The level of its background, as a share.
    pub background: f64,
    /// Its wall, where that is told apart.
    pub wall: Option<Wall>,
    /// What the samples miss, as a root of the mean square and as a share: the noise, where the lumen is an ellipse.
    pub missed: f64,
    /// The standard deviation of the diameter of a circle of the same area (mm); NaN where it was not asked.
    pub uncertainty: f64,
    /// What that is made of.
    pub parts: Parts,
    /// The share of all directions in which nothing was in the way of the wall.
    pub free: f64,
    /// What it was last begun from, where begun from what it ended at it would not stay there: the lumen may be the one or the other.
    pub other: Option<Ellipse>,
}

impl Fit {
    /// The fit that begins with an ellipse; None where there are too few samples or no ellipse fits.
    pub fn new(
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

    /// What samples miss under the fit that begins with an ellipse, as [`Fit::missed`]; None where [`Fit::new`] has none.
    pub fn missed_by(
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

    /// What samples miss under a blur.
    pub fn missing(&self, samples: &Samples, whitening: Whitening) -> Vec<[f32; FAN]> {
        let levels = [self.lumen[0], self.background];
        match &self.wall {
            Some(wall) => missing(samples, &ThreeLevels::of(&self.ellipse, wall, levels, whitening)),
            None => missing(samples, &TwoLevels::of(&self.ellipse, levels, whitening)),
        }
    }

    /// The same fit where another one may be right as well: the diameter is then as unsure as both differ.
    #[must_use]
    pub fn or(mut self, other: &Self) -> Self {
        let apart = self.ellipse.equivalent_diameter() - other.ellipse.equivalent_diameter();
        self.parts.surroundings = self.parts.surroundings.hypot(apart);
        self.uncertainty = self.parts.total();
        self
    }

    /// The blurred ellipse of a fit.
    pub fn boundary(&self, whitening: Whitening) -> Boundary {
        Boundary::new(&self.ellipse, whitening)
    }
}

/// What is expected of the levels of a lumen in even surroundings.
fn plain<const N: usize>(expected: &Expected) -> Vec<Term<N>> {
    vec![Term::one(LUMEN, expected.lumen), Term::one(BACKGROUND, expected.background)]
}

/// The same of a lumen with a wall, in surroundings that differ from side to side.
fn walled(expected: &Expected, known: &KnownWall, start: &Ellipse) -> Vec<Term<WALLED>> {
    let mut terms = plain(expected);
    terms.push(Term::one(WALL, known.level));
    let thickness = Term::one(THICKNESS, known.log_thickness(start));
    terms.push(thickness.less(WALL, known.slope, known.level[0]));
    terms.extend(SIDES.into_iter().enumerate().map(|(h, side)| Term::one(SECTORS + h, [0.0, side])));
    terms
}

/// What samples miss of a model.
fn missing<M: Model<N>, const N: usize>(samples: &Samples, model: &M) -> Vec<[f32; FAN]> {
    dispatch(Isa::widest(), Missing { samples, model })
}

/// The standard deviation of a combination of parameters.
fn deviation<const N: usize>(minimum: &Minimum<N>, by: &[f64; N]) -> Option<f64> {
    let square = variance(&minimum.normal.matrix, by)?;
    square.is_finite().then(|| (square * EVENLY_FALLING).sqrt())
}

/// The derivatives of the diameter of a circle of the same area.
fn diameter_by<const N: usize>(ellipse: &Ellipse) -> [f64; N] {
    let diameter = ellipse.equivalent_diameter();
    let mut by = [0.0; N];
    by[2] = 4.0 * ellipse.mean / diameter;
    by[3] = -4.0 * ellipse.stretch.x / diameter;
    by[4] = -4.0 * ellipse.stretch.y / diameter;
    by
}

/// Samples and what is fitted to them.
struct Work<'a, M, const N: usize> {
    samples: &'a Samples,
    whitening: Whitening,
    expected: &'a Expected<'a>,
    start: &'a Ellipse,
    /// What is expected of the parameters.
    terms: Vec<Term<N>>,
    /// How much each sample counts.
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

    /// The parameters that fit best before samples are weighed by how much they miss, and how much they miss then; None where
    /// there are too few samples.
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

    /// The parameters that fit best, what the samples miss then, and what the diameter is unsure by, where that is asked.
    fn done(mut self) -> Option<(Minimum<N>, f64, Parts)> {
        let (first, missed) = self.weighed()?;
        let last = minimum(first, STEPS[1], |at| self.evaluate(at))?;
        let parts = match self.expected.unsure {
            Some(unsure) => self.parts(&last, missed, unsure)?,
            None => Parts::unknown(),
        };
        Some((last, missed, parts))
    }

    /// What makes the diameter unsure: each sample moves it by its noise, and each expectation by how wrong it may be.
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
        // What misses more than noise does says that the lumen is no ellipse, or the surroundings are not even.
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

    /// By how much the diameter is wrong (mm) as what is expected of some parameters is, by its standard deviations.
    fn expectations(&self, towards: &[f64; N], of: impl Fn(usize) -> bool) -> f64 {
        let own = self.terms.iter().filter(|term| of(term.parameter));
        let moved = |term: &Term<N>| (0..N).map(|n| term.by[n] * towards[n]).sum::<f64>() / term.level[1];
        own.map(|term| moved(term).powi(2)).sum::<f64>().sqrt()
    }

    /// The section with a wall that is brighter than its surroundings by what it may be.
    fn with_wall(&self, at: &[f64; N], ellipse: &Ellipse, hidden: &KnownWall) -> ThreeLevels {
        let [level, deviation] = hidden.level;
        let brighter = at[BACKGROUND] + deviation.hypot(level - at[BACKGROUND]);
        let wall = Wall::assumed([brighter, deviation], hidden.log_thickness(ellipse), self.start.center);
        ThreeLevels::of(ellipse, &wall, [at[LUMEN], at[BACKGROUND]], self.whitening)
    }

    /// By how much a diameter is another one (mm) where the samples are not as one model has them but as another one has.
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

    /// What samples miss by and large, as the standard deviation of a normal distribution with their median.
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

    /// Whether an ellipse is still one of this section.
    fn trusts(&self, ellipse: &Ellipse) -> bool {
        let (far, [small, large]) = TRUSTED;
        let size = ellipse.mean / self.start.mean;
        ellipse.center.distance(self.start.center) <= far * self.start.semi_axes()[1]
            && (small..=large).contains(&size)
    }

    /// Weighs the samples by how much they miss; gives the root of the mean square of that over those that count.
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
