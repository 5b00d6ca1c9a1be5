//! The values of lumen and of the tissue around it. Membership in lumen is gradual between bounds.

use glam::DVec3;
use lumencut_core::polarity::Polarity;

use crate::kind::AIR;

/// Values of a lumen and of its surroundings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LumenModel {
    /// Intensity level of the surrounding tissue, without fat and air.
    pub tissue: f64,
    /// Lowest of the lumen medians at the clicks.
    pub low: f64,
    /// Highest of the lumen medians at the clicks.
    pub high: f64,
    /// Standard deviation of the values within the lumen.
    pub noise: f64,
    /// Whether the values are Hounsfield units.
    pub is_hounsfield: bool,
    /// Whether the values are those of the volume, or negated.
    pub polarity: Polarity,
}

/// Level of lung (HU).
const LUNG: f64 = -780.0;

/// Whether a lumen with this value, as it is traced, holds air in CT.
pub(crate) fn holds_air(polarity: Polarity, lumen: f64) -> bool {
    polarity == Polarity::Dark && AIR.contains(&polarity.turned(lumen))
}

/// The level of the tissue beside a lumen; beside air at least that of lung, so that nothing leaks into lung.
pub(crate) fn tissue_beside(polarity: Polarity, lumen: f64, tissue: f64) -> f64 {
    if holds_air(polarity, lumen) { tissue.max(polarity.turned(LUNG)) } else { tissue }
}

impl LumenModel {
    /// Smallest contrast between lumen and tissue.
    pub fn contrast(&self) -> f64 {
        self.low - self.tissue
    }

    /// Membership of a value in lumen, from 0 to 1: 0 up to a fifth of the contrast, and 1 from three
    /// quarters on. Brighter values (bone, stents, calcium) keep 0.12, so that paths can cross them.
    pub fn membership(&self, value: f32) -> f32 {
        let (contrast, value) = (self.contrast(), f64::from(value));
        let (empty, full) = (self.tissue + 0.2 * contrast, self.tissue + 0.75 * contrast);
        let (above, far_above) = (self.brightest(), self.far_above());
        let share = if value >= above {
            1.0 - ABOVE_IS_NOT * ((value - above) / (far_above - above)).min(1.0)
        } else {
            ((value - empty) / (full - empty)).clamp(0.0, 1.0)
        };
        // NaN is not lumen.
        if share.is_finite() { share as f32 } else { 0.0 }
    }

    fn far_above(&self) -> f64 {
        self.high + (0.9 * self.contrast()).max(6.0 * self.noise)
    }

    pub(crate) fn is_far_above(&self, value: f32) -> bool {
        f64::from(value) >= self.far_above()
    }

    /// Standard deviation of the membership that noise causes, for values between tissue and lumen.
    pub(crate) fn noise_of_membership(&self) -> f64 {
        self.noise / (0.55 * self.contrast())
    }

    /// Upper limit of the values that are certainly lumen.
    pub fn brightest(&self) -> f64 {
        self.high + (0.35 * self.contrast()).max(3.0 * self.noise)
    }

    /// Whether the lumen values of another model lie within those of this model.
    pub fn covers(&self, other: &Self) -> bool {
        let slack = 0.15 * self.contrast();
        other.low >= self.low - slack && other.high <= self.high + slack
    }
}

/// Values far above the lumen lose this much membership.
const ABOVE_IS_NOT: f64 = 0.88;

/// Quantile of sorted values; NaN if there are none.
pub(crate) fn quantile(sorted: &[f32], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1) as f64;
    sorted.get((last * share).round() as usize).map_or(f64::NAN, |value| f64::from(*value))
}

/// The median; of two middle values, the upper one. NaN if there are none.
pub(crate) fn median_of(mut values: Vec<f32>) -> f64 {
    values.sort_unstable_by(f32::total_cmp);
    quantile(&values, 0.5)
}

/// Noise, estimated from the small differences between neighbours, because most neighbours do not lie at an edge.
pub(crate) fn noise_of(neighbours: &[f32]) -> f64 {
    let mut steps: Vec<f32> = neighbours.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    steps.retain(|step| step.is_finite());
    steps.sort_unstable_by(f32::total_cmp);
    // A quarter of the absolute differences between two normal deviates is below 0.451 standard deviations.
    if steps.is_empty() { 0.0 } else { quantile(&steps, 0.25) / 0.451 }
}

/// Upper quartile of the sorted values that are darker than midway between their median and the lumen.
pub(crate) fn tissue_level(tissue: &[f32], clicks: &[f64]) -> f64 {
    let median = quantile(tissue, 0.5);
    let values: Vec<f64> = clicks.iter().copied().filter(|value| value.is_finite()).collect();
    let lumen = if values.is_empty() { median } else { lower_median(values) };
    let middle = f64::midpoint(median, lumen);
    let below = tissue.partition_point(|value| f64::from(*value) < middle);
    if below == 0 { quantile(tissue, 0.01) } else { quantile(&tissue[..below], 0.75) }
}

/// The median; of two middle values, the lower one. There must be at least one value.
pub(crate) fn lower_median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[(values.len() - 1) / 2]
}

pub(crate) fn in_words(place: DVec3) -> String {
    format!("({:.1}, {:.1}, {:.1}) mm", place.x, place.y, place.z)
}
