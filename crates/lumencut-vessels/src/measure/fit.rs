//! The ellipse that, blurred as the volume is, comes nearest to the voxels of a section.

use super::ellipse::{Boundary, Ellipse, SHAPE, Whitening};
use super::least_squares::{Minimum, Normal, minimum, variance};
use super::slab::Samples;
use lumencut_core::math::lanes::{FAN, Isa, Kernel, dispatch};
use lumencut_core::math::statistics::median;

/// The parameters of a fit: those of the ellipse, the level of the lumen and that of its background.
const PARAMETERS: usize = SHAPE + 2;
const LUMEN: usize = SHAPE;
const BACKGROUND: usize = SHAPE + 1;

/// Samples that miss by more than this number of standard deviations do not count (Tukey's weights).
const TUKEY: f64 = 5.0;

/// Steps before and after samples are weighed by how much they miss.
const STEPS: [usize; 2] = [12, 8];

/// Weights fall evenly with the distance from the plane: the noise of the weighted mean is smaller than the weights say by this factor.
const EVENLY_FALLING: f64 = 2.0 / 3.0;

/// What is known beforehand: means and standard deviations.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
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
}

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
    /// What the samples miss, as a root of the mean square and as a share: the noise, where the lumen is an ellipse.
    pub missed: f64,
    /// The standard deviation of the diameter of a circle of the same area (mm).
    pub uncertainty: f64,
    /// The share of all directions in which nothing was in the way of the wall.
    pub free: f64,
}

impl Fit {
    /// The fit that begins with an ellipse; None where there are too few samples or no ellipse fits.
    pub fn new(
        samples: &Samples,
        whitening: Whitening,
        start: &Ellipse,
        expected: &Expected,
    ) -> Option<Self> {
        if samples.count < 2 * PARAMETERS {
            return None;
        }
        let mut work = Work { samples, whitening, expected, start, kept: samples.weight.clone() };
        let mut at = [0.0; PARAMETERS];
        at[..SHAPE].copy_from_slice(&start.parameters());
        (at[LUMEN], at[BACKGROUND]) = (expected.lumen[0], expected.background[0]);
        let first = minimum(at, STEPS[0], |at| work.evaluate(at))?;
        let missed = work.weigh(&first.at)?;
        let last = minimum(first.at, STEPS[1], |at| work.evaluate(at))?;
        Self::of(&last, missed, expected)
    }

    fn of(minimum: &Minimum<PARAMETERS>, missed: f64, expected: &Expected) -> Option<Self> {
        let at = &minimum.at;
        let ellipse = Ellipse::from_parameters(at)?;
        let diameter = ellipse.equivalent_diameter();
        let mut by = [0.0; PARAMETERS];
        by[2] = 4.0 * ellipse.mean / diameter;
        by[3] = -4.0 * ellipse.stretch.x / diameter;
        by[4] = -4.0 * ellipse.stretch.y / diameter;
        let mut lumen = [0.0; PARAMETERS];
        lumen[LUMEN] = 1.0;
        // What misses more than noise does says that the lumen is no ellipse, or the surroundings are not even.
        let excess = (missed / expected.noise).max(1.0);
        let deviation = |by: &[f64; PARAMETERS]| {
            let square = variance(&minimum.normal.matrix, by)?;
            square.is_finite().then(|| (square * EVENLY_FALLING).sqrt() * excess)
        };
        Some(Self {
            ellipse,
            lumen: [at[LUMEN], deviation(&lumen)?],
            background: at[BACKGROUND],
            missed,
            uncertainty: deviation(&by)?,
            free: 1.0,
        })
    }

    /// The blurred ellipse of a fit.
    pub fn boundary(&self, whitening: Whitening) -> Boundary {
        Boundary::new(&self.ellipse, whitening)
    }
}

/// Samples and what is fitted to them.
struct Work<'a> {
    samples: &'a Samples,
    whitening: Whitening,
    expected: &'a Expected,
    start: &'a Ellipse,
    /// How much each sample counts.
    kept: Vec<[f32; FAN]>,
}

impl Work<'_> {
    fn evaluate(&self, at: &[f64; PARAMETERS]) -> Option<Normal<PARAMETERS>> {
        let ellipse = Ellipse::from_parameters(at).filter(|ellipse| self.trusts(ellipse))?;
        let levels = [at[LUMEN], at[BACKGROUND]];
        let boundary = Boundary::new(&ellipse, self.whitening);
        let kernel = Sums { samples: self.samples, kept: &self.kept, boundary: &boundary, levels };
        let mut normal = dispatch(Isa::widest(), kernel);
        let weight = 1.0 / self.expected.noise.powi(2);
        normal.cost *= weight;
        normal.slope = normal.slope.map(|slope| slope * weight);
        normal.matrix = normal.matrix.map(|row| row.map(|product| product * weight));
        let Expected { lumen, background, stretch, .. } = self.expected;
        normal.expect(LUMEN, lumen[0] - at[LUMEN], lumen[1]);
        normal.expect(BACKGROUND, background[0] - at[BACKGROUND], background[1]);
        let deviation = stretch * ellipse.mean;
        normal.expect(3, -at[3], deviation);
        normal.expect(4, -at[4], deviation);
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
    fn weigh(&mut self, at: &[f64; PARAMETERS]) -> Option<f64> {
        let boundary = Boundary::new(&Ellipse::from_parameters(at)?, self.whitening);
        let levels = [at[LUMEN] as f32, at[BACKGROUND] as f32];
        let missing = dispatch(Isa::widest(), Missing { samples: self.samples, boundary: &boundary, levels });
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
        let free = count.checked_sub(PARAMETERS).filter(|free| *free >= PARAMETERS)?;
        Some((squares / all * count as f64 / free as f64).sqrt())
    }
}

/// The sums over all samples as a kernel.
struct Sums<'a> {
    samples: &'a Samples,
    kept: &'a [[f32; FAN]],
    boundary: &'a Boundary,
    levels: [f64; 2],
}

impl Kernel for Sums<'_> {
    type Output = Normal<PARAMETERS>;

    #[inline(always)]
    fn run(self) -> Normal<PARAMETERS> {
        let Self { samples, kept, boundary, levels } = self;
        let (contrast, background) = ((levels[0] - levels[1]) as f32, levels[1] as f32);
        let mut cost = [0.0; FAN];
        let mut slope = [[0.0; FAN]; PARAMETERS];
        let mut matrix = [[[0.0; FAN]; PARAMETERS]; PARAMETERS];
        for n in 0..samples.x.len() {
            let blurred = boundary.blurred(&samples.x[n], &samples.y[n]);
            let mut by = [[0.0; FAN]; PARAMETERS];
            for a in 0..SHAPE {
                for l in 0..FAN {
                    by[a][l] = contrast * blurred.slopes[a][l];
                }
            }
            let mut missing = [0.0; FAN];
            for l in 0..FAN {
                by[LUMEN][l] = blurred.value[l];
                by[BACKGROUND][l] = 1.0 - blurred.value[l];
                missing[l] = samples.share[n][l] - (background + contrast * blurred.value[l]);
            }
            for l in 0..FAN {
                cost[l] += kept[n][l] * missing[l] * missing[l];
            }
            for a in 0..PARAMETERS {
                let mut weighted = [0.0; FAN];
                for l in 0..FAN {
                    weighted[l] = kept[n][l] * by[a][l];
                    slope[a][l] += weighted[l] * missing[l];
                }
                for b in 0..=a {
                    for l in 0..FAN {
                        matrix[a][b][l] += weighted[l] * by[b][l];
                    }
                }
            }
        }
        let sum = |lanes: &[f32; FAN]| lanes.iter().map(|lane| f64::from(*lane)).sum::<f64>();
        Normal {
            cost: sum(&cost),
            slope: std::array::from_fn(|a| sum(&slope[a])),
            matrix: std::array::from_fn(|a| std::array::from_fn(|b| sum(&matrix[a.max(b)][a.min(b)]))),
        }
    }
}

/// What each sample misses, as a kernel.
struct Missing<'a> {
    samples: &'a Samples,
    boundary: &'a Boundary,
    levels: [f32; 2],
}

impl Kernel for Missing<'_> {
    type Output = Vec<[f32; FAN]>;

    #[inline(always)]
    fn run(self) -> Vec<[f32; FAN]> {
        let Self { samples, boundary, levels } = self;
        let mut all = Vec::with_capacity(samples.x.len());
        for n in 0..samples.x.len() {
            let blurred = boundary.blurred(&samples.x[n], &samples.y[n]);
            let mut missing = [0.0; FAN];
            for l in 0..FAN {
                let model = levels[1] + (levels[0] - levels[1]) * blurred.value[l];
                missing[l] = samples.share[n][l] - model;
            }
            all.push(missing);
        }
        all
    }
}
