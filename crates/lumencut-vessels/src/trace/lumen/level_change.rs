//! Finds a lasting change of brightness along a line, which means that the line enters another lumen.

use lumencut_core::math::arc_length::arc_lengths;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lumen::lumen_model::median_of;
use crate::trace::lumen::surroundings::Surroundings;
use crate::voxels::Voxels;

/// Length of the parts compared before and after a point, and their distance from it: mm, or radii if larger.
const STRETCH_MM: f64 = 15.0;
const STRETCH_RADII: f64 = 2.0;
const GAP_MM: f64 = 3.0;
const APART_RADII: f64 = 0.5;

/// Minimum change: a fraction of the contrast, and a multiple of the noise on each side.
const LEAST_CHANGE: f64 = 0.25;
const LEAST_NOISES: f64 = 3.0;

/// Values that differ from the median by more than this multiple of the noise are ignored, such as stent struts and
/// calcium.
const OUTLIER: f64 = 3.0;

/// Steps of at least this fraction of the largest step count as equally large.
const NEARLY: f64 = 0.9;

/// Minimum radius in voxels. Values at the centre of a narrower lumen are mixed with those of the tissue.
const LEAST_VOXELS: f64 = 2.0;

/// A sudden and lasting change of brightness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelChange {
    /// Index of the point.
    pub at: usize,
    /// Medians of the values before and after it.
    pub levels: [f64; 2],
}

/// The point at which the lumen brightness changes suddenly and for good. The method is our own: two
/// lines of common slope are fitted to the values along 15 mm (or two radii) before and after a point. The
/// step between them must be at least a quarter of the contrast and three times the noise.
pub fn level_change(voxels: &Voxels, line: &Centerline) -> Option<LevelChange> {
    let along = Along::new(voxels, line);
    let steps = (0..line.points.len()).filter_map(|n| Some((n, along.step_at(n)?)));
    let mut steps: Vec<(usize, Step)> = steps.collect();
    let largest = steps.iter().map(|(_, step)| step.size).fold(0.0, f64::max);
    // Around the change, several points show about the same step, so the middle one is taken.
    steps.retain(|(_, step)| step.size >= NEARLY * largest);
    let (at, step) = *steps.get(steps.len() / 2)?;
    let tissue = Surroundings::of(voxels, &[line.points[at]]).tissue();
    let least = LEAST_CHANGE * (step.levels[0].max(step.levels[1]) - tissue);
    (step.size >= least).then_some(LevelChange { at, levels: step.levels })
}

#[derive(Clone, Copy, Debug)]
struct Step {
    size: f64,
    levels: [f64; 2],
}

/// Values along one part of the line: statistics, and the sums for fitting a line, without outliers.
#[derive(Clone, Copy, Debug)]
struct Side {
    median: f64,
    noise: f64,
    mean: f64,
    /// Mean of the arc lengths (mm).
    middle: f64,
    /// Sums of arc length × value, and of arc length squared, both relative to the means.
    products: [f64; 2],
}

struct Along<'a> {
    line: &'a Centerline,
    lengths: Vec<f64>,
    values: Vec<f32>,
    thin: f64,
}

impl<'a> Along<'a> {
    fn new(voxels: &Voxels, line: &'a Centerline) -> Self {
        let sides = voxels.world_from_index.matrix3;
        let largest = sides.x_axis.length().max(sides.y_axis.length()).max(sides.z_axis.length());
        Self {
            line,
            lengths: arc_lengths(&line.points),
            values: line.points.iter().map(|point| voxels.at(*point)).collect(),
            thin: LEAST_VOXELS * largest,
        }
    }

    fn step_at(&self, n: usize) -> Option<Step> {
        let radius = self.line.radius[n];
        let (apart, stretch) = (GAP_MM.max(APART_RADII * radius), STRETCH_MM.max(STRETCH_RADII * radius));
        let at = self.lengths[n];
        let before = self.side(at - apart - stretch, at - apart)?;
        let after = self.side(at + apart, at + apart + stretch)?;
        let [products, squares] = [0, 1].map(|part| before.products[part] + after.products[part]);
        let slope = products / squares.max(f64::MIN_POSITIVE);
        let step = after.mean - before.mean - slope * (after.middle - before.middle);
        let change = after.median - before.median;
        let size = step.abs().min(change.abs());
        let is_seen = step * change > 0.0 && size >= LEAST_NOISES * before.noise.max(after.noise);
        is_seen.then_some(Step { size, levels: [before.median, after.median] })
    }

    /// The values between two arc lengths; None if the line ends before, or if the vessel is thin there.
    fn side(&self, from: f64, to: f64) -> Option<Side> {
        if from < 0.0 || to > self.lengths[self.lengths.len() - 1] {
            return None;
        }
        let first = self.lengths.partition_point(|length| *length < from);
        let end = self.lengths.partition_point(|length| *length <= to);
        if end <= first || self.line.radius[first..end].iter().any(|radius| *radius < self.thin) {
            return None;
        }
        let values = &self.values[first..end];
        let median = median_of(values.to_vec());
        let away = |value: f32| (f64::from(value) - median).abs();
        let noise = 1.4826 * median_of(values.iter().map(|value| away(*value) as f32).collect());
        let kept = (first..end).filter(|n| away(self.values[*n]) <= OUTLIER * noise);
        let kept: Vec<(f64, f64)> = kept.map(|n| (self.lengths[n], f64::from(self.values[n]))).collect();
        let mean_of =
            |part: &dyn Fn(&(f64, f64)) -> f64| kept.iter().map(part).sum::<f64>() / kept.len() as f64;
        let (middle, mean) = (mean_of(&|kept| kept.0), mean_of(&|kept| kept.1));
        let products = kept.iter().fold([0.0; 2], |[products, squares], (length, value)| {
            let away = length - middle;
            [products + away * (value - mean), squares + away * away]
        });
        Some(Side { median, noise, mean, middle, products })
    }
}
