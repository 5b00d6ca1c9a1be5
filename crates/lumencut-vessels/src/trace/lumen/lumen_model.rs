//! What lumen looks like: a soft membership of values with a lower and an upper bound, and the tissue below it.

use glam::DVec3;

/// The values of lumen and of what surrounds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LumenModel {
    /// The values of the tissue around the lumen, without fat and air.
    pub tissue: f64,
    /// The smallest and the largest median of lumen that was seen.
    pub low: f64,
    /// See `low`.
    pub high: f64,
    /// The standard deviation of the values within the lumen.
    pub noise: f64,
    /// Whether the values are Hounsfield units.
    pub is_hounsfield: bool,
}

impl LumenModel {
    /// The smallest distance of lumen from tissue.
    pub fn contrast(&self) -> f64 {
        self.low - self.tissue
    }

    /// How much a value is that of lumen, 0 to 1. Bone, stents and calcium lie above: they keep a little.
    pub fn membership(&self, value: f32) -> f32 {
        let (contrast, value) = (self.contrast(), f64::from(value));
        let (empty, full) = (self.tissue + 0.2 * contrast, self.tissue + 0.75 * contrast);
        let (above, far_above) = (self.brightest(), self.far_above());
        let share = if value >= above {
            1.0 - ABOVE_IS_NOT * ((value - above) / (far_above - above)).min(1.0)
        } else {
            ((value - empty) / (full - empty)).clamp(0.0, 1.0)
        };
        // What is no number is no lumen.
        if share.is_finite() { share as f32 } else { 0.0 }
    }

    /// From here on a value is that of bone, calcium or metal.
    fn far_above(&self) -> f64 {
        self.high + (0.9 * self.contrast()).max(6.0 * self.noise)
    }

    /// Whether a value is that of bone, calcium or metal.
    pub fn is_far_above(&self, value: f32) -> bool {
        f64::from(value) >= self.far_above()
    }

    /// The standard deviation that noise gives the membership of values between tissue and lumen.
    pub fn noise_of_membership(&self) -> f64 {
        self.noise / (0.55 * self.contrast())
    }

    /// The brightest value that lumen has for sure; bone, stents and calcium may lie above.
    pub fn brightest(&self) -> f64 {
        self.high + (0.35 * self.contrast()).max(3.0 * self.noise)
    }

    /// Whether a median of lumen lies within what the model already takes for lumen.
    pub fn covers(&self, other: &Self) -> bool {
        let slack = 0.15 * self.contrast();
        other.low >= self.low - slack && other.high <= self.high + slack
    }
}

/// How much membership values far above the lumen lose.
const ABOVE_IS_NOT: f64 = 0.88;

/// The value below which a share of some values lies, which are sorted; no number of none.
pub(crate) fn quantile(sorted: &[f32], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1) as f64;
    sorted.get((last * share).round() as usize).map_or(f64::NAN, |value| f64::from(*value))
}

/// The noise of values beside each other, as neighbours differ where they differ little: most are not at the edge of a vessel.
pub(crate) fn noise_of(neighbours: &[f32]) -> f64 {
    let mut steps: Vec<f32> = neighbours.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    steps.retain(|step| step.is_finite());
    steps.sort_unstable_by(f32::total_cmp);
    // A quarter of the differences of two normal deviates is below this part of the standard deviation of one.
    if steps.is_empty() { 0.0 } else { quantile(&steps, 0.25) / 0.451 }
}

/// The tissue around the lumen: bright for what is not lumen. Its values are sorted.
pub(crate) fn tissue_level(tissue: &[f32], clicks: &[f64]) -> f64 {
    let median = quantile(tissue, 0.5);
    let values: Vec<f64> = clicks.iter().copied().filter(|value| value.is_finite()).collect();
    let lumen = if values.is_empty() { median } else { lower_median(values) };
    let middle = f64::midpoint(median, lumen);
    let below = tissue.partition_point(|value| f64::from(*value) < middle);
    if below == 0 { quantile(tissue, 0.01) } else { quantile(&tissue[..below], 0.75) }
}

/// The median, of an even number of values the lower one of the middle; not of none.
pub(crate) fn lower_median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[(values.len() - 1) / 2]
}

/// A position in words.
pub(crate) fn in_words(place: DVec3) -> String {
    format!("({:.1}, {:.1}, {:.1}) mm", place.x, place.y, place.z)
}
