//! Detects scans whose dark values were cut off: many voxels then have the smallest value, and tissue among them is black
//! in every window.

use lumencut_core::math::statistics::rising_quantile;
use lumencut_core::volume::Volume;

use crate::populations::{VoxelSample, padding, without_padding};
use crate::text::rounded;

/// Values above the smallest one are counted in this number of equal ranges: up to this quantile, and near the smallest, where
/// this number of ranges reach the median.
const RANGES: usize = 8;
const LAST_QUANTILE: f64 = 0.99;
const TO_MEDIAN: f64 = 4.0;
/// In a scan that was cut off, no range holds more voxels than the first, up to this factor, and the second holds at least
/// this share of them. Around padding the second is nearly empty.
const MORE: f64 = 1.25;
const NEXT_SHARE: f64 = 0.15;
/// Below this value (HU) lies only air, so nothing is lost.
const AIR: f64 = -900.0;

/// A note for the user if dark values were cut off.
pub fn cut_off_note(volume: &Volume) -> Option<String> {
    note_of(&VoxelSample::at(volume))
}

pub(crate) fn note_of(sampled: &VoxelSample) -> Option<String> {
    let smallest = padding(&sampled.voxels).filter(|smallest| *smallest > AIR)?;
    let rest = without_padding(&sampled.voxels);
    let [median, last] = [0.5, LAST_QUANTILE].map(|part| rising_quantile(rest, part));
    // A range holds two of the values of a coarse scale.
    let near = ((median? - smallest) / TO_MEDIAN).max(2.0 * (rest.first()? - smallest));
    let fades = |width: f64| fades(rest, smallest, width);
    if !fades(near) || !fades((last? - smallest) / RANGES as f64) {
        return None;
    }
    let percent = 100.0 * (sampled.voxels.len() - rest.len()) as f64 / sampled.voxels.len() as f64;
    let smallest = rounded(smallest, 4);
    Some(format!(
        "{percent:.0} % of the voxels have the smallest value, {smallest}: darker values were cut off, so dark tissue looks like air"
    ))
}

/// Whether the rising values become fewer above `smallest`, in ranges of this width.
fn fades(rising: &[f64], smallest: f64, width: f64) -> bool {
    let end = |n: usize| rising.partition_point(|value| *value <= smallest + width * n as f64);
    let counts: [f64; RANGES] = std::array::from_fn(|n| (end(n + 1) - end(n)) as f64);
    let [first, next, ..] = counts;
    counts.iter().all(|count| *count <= MORE * first) && next >= NEXT_SHARE * first
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;
    use lumencut_core::volume::Voxels;

    use super::*;

    fn note(voxels: &[f32]) -> Option<String> {
        let size = [voxels.len(), 1, 1];
        let volume = Volume::new(Voxels::F32(voxels), size, [1, size[0], size[0]], DAffine3::IDENTITY);
        cut_off_note(&volume.expect("a volume"))
    }

    /// Values of a normal distribution at equal steps of its logistic approximation.
    fn tissue(middle: f64, deviation: f64, count: usize) -> impl Iterator<Item = f32> {
        let part = move |n: usize| (n as f64 + 0.5) / count as f64;
        (0..count).map(move |n| (middle + 0.55 * deviation * (part(n) / (1.0 - part(n))).ln()) as f32)
    }

    fn cut_at(smallest: f32, values: impl Iterator<Item = f32>) -> Vec<f32> {
        values.map(|value| value.max(smallest)).collect()
    }

    #[test]
    fn tissue_that_was_cut_in_its_middle_is_reported_with_its_share() {
        let words = note(&cut_at(20.0, tissue(20.0, 40.0, 4000).chain(tissue(300.0, 20.0, 100))));
        let words = words.expect("a note");
        assert!(words.starts_with("49 % of the voxels have the smallest value, 20:"), "{words}");
    }

    #[test]
    fn whole_distributions_padding_and_cut_air_are_not() {
        let body = || tissue(40.0, 30.0, 3000).chain(tissue(350.0, 30.0, 200));
        let air = |count| tissue(-1000.0, 20.0, count);
        assert_eq!(note(&body().collect::<Vec<_>>()), None, "no value is common");
        assert_eq!(note(&cut_at(-1000.0, air(2000).chain(body()))), None, "noise of air was cut off");
        let padded: Vec<f32> =
            tissue(60.0, 15.0, 3000).chain(tissue(350.0, 30.0, 200)).chain([0.0; 4000]).collect();
        assert_eq!(note(&padded), None, "no tissue lies near the padding");
        assert_eq!(note(&[0.0, 0.0, 1.0, 1.0]), None, "a mask");
        assert_eq!(note(&[7.0; 50]), None, "a constant volume");
        assert_eq!(note(&[f32::NAN; 4]), None);
    }
}
