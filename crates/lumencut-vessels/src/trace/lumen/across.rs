//! Tests whether the path between two clicks runs across a lumen instead of along it.

use glam::DVec3;

use crate::trace::lumen::directions::half_sphere;
use crate::trace::lumen::own_axis::{DIRECTIONS, OwnLumen};
use crate::voxels::Voxels;

/// A path runs across a lumen if the lumen's extent along it is at most this multiple of the smallest extent,
/// and less than this fraction of the largest.
const MOST_WIDTHS: f64 = 1.3;
const LEAST_SHARE: f64 = 0.6;

/// Search distance on each side: in mm along the path; in other directions, in multiples of the extent along it.
const SEARCH_MM: f64 = 60.0;
const REACH_WIDTHS: f64 = 3.0;

/// Whether the straight line between two clicks (mm, LPS) stays within one lumen and runs across it.
pub fn runs_across(voxels: &Voxels, [from, to]: [DVec3; 2]) -> bool {
    let lumen = OwnLumen::around(voxels, from.midpoint(to));
    let along = lumen.extent((to - from).normalize_or_zero(), SEARCH_MM);
    if along < from.distance(to) {
        return false;
    }
    let extents = half_sphere(DIRECTIONS).map(|way| lumen.extent(way, REACH_WIDTHS * along));
    let (width, length) =
        extents.fold((f64::MAX, 0.0), |(least, most), extent| (extent.min(least), extent.max(most)));
    along <= MOST_WIDTHS * width && along < LEAST_SHARE * length
}
