//! The histogram of a volume's values, for the window control.

use lumencut_core::volume::{Real, Voxel};
use serde::Serialize;

const MAX_VOXELS: usize = 500_000;

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Histogram {
    pub(crate) low: f32,
    pub(crate) high: f32,
    /// Number of values in each range, from the lowest range on; the largest value counts in the last range.
    pub counts: Vec<u32>,
}

impl Histogram {
    /// Counts the values; large volumes are sampled, and NaN is ignored.
    pub(crate) fn of<T: Voxel>(voxels: &[T], bins: usize) -> Self {
        let values = || {
            let looked_at = voxels.iter().step_by(voxels.len().div_ceil(MAX_VOXELS).max(1));
            looked_at.map(|voxel| voxel.real().to_f32()).filter(|value| value.is_finite())
        };
        let low = values().fold(f32::MAX, f32::min);
        let high = values().fold(f32::MIN, f32::max);
        let mut counts = vec![0; bins.max(1)];
        let last = counts.len() - 1;
        let per_value = counts.len() as f32 / (high - low).max(f32::MIN_POSITIVE);
        for value in values() {
            // The index is not negative, since `low` is the smallest value.
            counts[(((value - low) * per_value) as usize).min(last)] += 1;
        }
        Self { low, high, counts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_counted_once() {
        let made = Histogram::of(&[0i16, 1, 2, 3, 4, 5, 6, 8], 4);
        assert_eq!(made, Histogram { low: 0.0, high: 8.0, counts: vec![2, 2, 2, 2] });
        assert_eq!(Histogram::of(&[5i16; 9], 3).counts.iter().sum::<u32>(), 9);
    }

    #[test]
    fn what_is_no_number_does_not_count() {
        let made = Histogram::of(&[f32::NAN, 1.0, f32::INFINITY, 2.0], 2);
        assert_eq!((made.low, made.high, made.counts), (1.0, 2.0, vec![1, 1]));
    }
}
