//! How the values of a volume are distributed, for the strip beside the window.

use lumencut_core::volume::{Real, Voxel};
use serde::Serialize;

/// The most voxels that are looked at.
const MOST: usize = 500_000;

/// How many voxels are in each of equally wide ranges of values.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Histogram {
    /// The smallest value.
    pub(crate) low: f32,
    /// The largest value.
    pub(crate) high: f32,
    /// The number of voxels of each range, the lowest first; the largest value counts to the last.
    pub counts: Vec<u32>,
}

impl Histogram {
    /// That of the voxels, of which only a part is looked at where they are many; NaN does not count.
    pub(crate) fn of<T: Voxel>(voxels: &[T], bins: usize) -> Self {
        let values = || {
            let looked_at = voxels.iter().step_by(voxels.len().div_ceil(MOST).max(1));
            looked_at.map(|voxel| voxel.real().to_f32()).filter(|value| value.is_finite())
        };
        let low = values().fold(f32::MAX, f32::min);
        let high = values().fold(f32::MIN, f32::max);
        let mut counts = vec![0; bins.max(1)];
        let last = counts.len() - 1;
        let per_value = counts.len() as f32 / (high - low).max(f32::MIN_POSITIVE);
        for value in values() {
            // From 0 on: it is not below the smallest value.
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
