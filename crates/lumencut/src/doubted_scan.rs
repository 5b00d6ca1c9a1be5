//! Detects scans of implausible size or direction, for example because the header uses another unit of length.

use glam::{DAffine3, DVec3};

use crate::places::LARGEST;
use crate::text::rounded;

/// A scan is implausible if its longest side is shorter than this (mm).
const MIN_LENGTH_MM: f64 = 1.0;
/// Factors that correct micrometres or metres read as mm.
const UNIT_FACTORS: [f64; 2] = [1e-3, 1e3];
const DIGITS: usize = 6;

/// No body is this long from front to back (mm), and longer than in both other directions by this factor.
const LONG_FROM_FRONT: (f64, f64) = (200.0, 1.5);

/// Describes an implausible size or direction of a grid of `size` voxels (i, j, k).
pub fn doubted_grid(size: [usize; 3], world_from_index: DAffine3) -> Option<String> {
    doubted_size(size, world_from_index).or_else(|| doubted_axes(size, world_from_index))
}

/// The doubt about a scan that runs from front to back as others do from head to foot.
fn doubted_axes(size: [usize; 3], world_from_index: DAffine3) -> Option<String> {
    let axes = world_from_index.matrix3;
    let extents = [axes.x_axis, axes.y_axis, axes.z_axis]
        .iter()
        .zip(size)
        .map(|(axis, count)| axis.abs() * count as f64)
        .sum::<DVec3>();
    let (least, factor) = LONG_FROM_FRONT;
    let is_odd = extents.y >= least && extents.y > factor * extents.x.max(extents.z);
    let [across, front, up] = extents.to_array().map(|length| rounded(length.round(), DIGITS));
    is_odd.then(|| {
        format!(
            "the scan is {front} mm long from front to back, but {across} mm from side to side and {up} mm from foot to head: its axes may be named wrongly"
        )
    })
}

/// The doubt about a size that is larger than a body or smaller than a vessel.
fn doubted_size(size: [usize; 3], world_from_index: DAffine3) -> Option<String> {
    let axes = world_from_index.matrix3;
    let sides = [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::length);
    let longest = (0..3).map(|axis| sides[axis] * size[axis] as f64).fold(0.0, f64::max);
    if (MIN_LENGTH_MM..=LARGEST).contains(&longest) || !longest.is_finite() {
        return None;
    }
    let mm = |length: f64| rounded(length, DIGITS);
    let likelier = UNIT_FACTORS.map(|factor| longest * factor);
    let likelier = likelier.iter().find(|length| (10.0 * MIN_LENGTH_MM..=LARGEST).contains(*length));
    let likelier = likelier.map(|length| format!("; perhaps it is {} mm long", mm(*length)));
    let found = format!("the scan is {} mm long by its header", mm(longest));
    Some(format!("{found}{}: check the unit of length", likelier.unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scan_that_is_long_from_front_to_back_has_doubted_axes() {
        let grid = |size: [usize; 3], axes: DAffine3| doubted_grid(size, axes);
        let coronal = DAffine3::from_scale(DVec3::new(0.88, 0.88, 1.5));
        let words = grid([157, 393, 34], coronal).expect("a doubt");
        assert!(
            words.starts_with(
                "the scan is 346 mm long from front to back, but 138 mm from side to side and 51 mm from foot to head"
            ),
            "{words}"
        );
        // The same voxels with their long axis from foot to head, and an axial slab of a head, are plausible.
        let upright = DAffine3::from_rotation_x(std::f64::consts::FRAC_PI_2) * coronal;
        assert_eq!(grid([157, 393, 34], upright), None);
        assert_eq!(grid([400, 512, 60], DAffine3::from_scale(DVec3::new(0.45, 0.45, 0.6))), None);
    }

    fn doubt(size: usize, spacing: f64) -> Option<String> {
        doubted_size([4, size, 4], DAffine3::from_scale(DVec3::splat(spacing)))
    }

    #[test]
    fn sizes_of_no_body_are_doubted() {
        for (size, spacing) in [(512, 0.7), (40, 0.03), (2000, 1.0)] {
            assert_eq!(doubt(size, spacing), None, "{size} times {spacing}");
        }
        let large =
            "the scan is 20000 mm long by its header; perhaps it is 20 mm long: check the unit of length";
        assert_eq!(doubt(20, 1000.0).as_deref(), Some(large));
        let small = doubt(400, 5e-4).expect("0.2 mm");
        assert!(small.contains("0.2 mm long by") && small.contains("perhaps it is 200 mm long"), "{small}");
        assert!(doubt(9, 1e9).is_some_and(|words| !words.contains("perhaps")));
    }
}
