//! Finds axis and extent of a lumen that is hardly longer than wide, for scans of few slices.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use crate::trace::lumen::directions::{half_sphere, longest_axis};
use crate::trace::lumen::lumen_model::quantile;
use crate::trace::lumen::surroundings::Surroundings;
use crate::voxels::Voxels;

/// Number of directions that cover half a sphere.
pub(crate) const DIRECTIONS: u32 = 200;

/// Maximum distance to which a lumen is followed (mm).
const SEARCH_MM: f64 = 60.0;

/// Number of directions across the axis in which the width is measured.
const TURNS: u32 = 12;

/// The lumen around a position, recognised by its values.
pub struct OwnLumen<'a, 'v> {
    voxels: &'a Voxels<'v>,
    place: DVec3,
    value: f64,
    /// Maximum difference between lumen values and the value at the position.
    most_away: f64,
    step: f64,
}

impl<'a, 'v> OwnLumen<'a, 'v> {
    /// The lumen around a position (mm, LPS).
    pub fn around(voxels: &'a Voxels<'v>, place: DVec3) -> Self {
        let tissue = Surroundings::of(voxels, &[place]).tissue();
        let near = voxels.ball(place, 1.75 * voxels.smallest_side);
        let mut near: Vec<f32> = near.into_iter().map(|(_, value)| value).collect();
        near.sort_unstable_by(f32::total_cmp);
        let value = quantile(&near, 0.5);
        Self { voxels, place, value, most_away: 0.5 * (value - tissue), step: 0.5 * voxels.smallest_side }
    }

    /// Distance over which the lumen extends in a direction (mm), at most `most`.
    pub fn reach(&self, direction: DVec3, most: f64) -> f64 {
        let value = |n: u32| f64::from(self.voxels.at(self.place + direction * (self.step * f64::from(n))));
        let is_lumen = |n: &u32| (value(*n) - self.value).abs() < self.most_away;
        self.step * (1..=(most / self.step) as u32).take_while(is_lumen).count() as f64
    }

    /// Sum of the distances over which the lumen extends along a direction and against it (mm); each is at
    /// most `most`.
    pub fn extent(&self, direction: DVec3, most: f64) -> f64 {
        self.reach(direction, most) + self.reach(-direction, most)
    }

    /// Both ends, along its axis, of a lumen that the scan cuts off; None if the lumen is not longer than wide.
    pub fn cut_ends(&self) -> Option<[DVec3; 2]> {
        let axis = self.axis();
        let reaches = [-1.0, 1.0].map(|side| self.reach(axis * side, SEARCH_MM));
        let place = |side: f64, way: f64| self.place + axis * (side * way);
        let is_cut =
            |side: f64, reach: f64| self.voxels.voxel_at(place(side, reach + 2.0 * self.step)).is_none();
        let across = axis.any_orthonormal_vector();
        let turned =
            (0..TURNS).map(|n| DQuat::from_axis_angle(axis, PI * f64::from(n) / f64::from(TURNS)) * across);
        let width = turned.map(|direction| self.extent(direction, SEARCH_MM)).fold(0.0, f64::max);
        let is_known = reaches[0] + reaches[1] > width;
        let within = |reach: f64| (reach - 2.0 * self.voxels.smallest_side).max(0.0);
        (is_known && is_cut(-1.0, reaches[0]) && is_cut(1.0, reaches[1]))
            .then(|| [place(-1.0, within(reaches[0])), place(1.0, within(reaches[1]))])
    }

    fn axis(&self) -> DVec3 {
        let weighted = half_sphere(DIRECTIONS).map(|way| (way, self.extent(way, SEARCH_MM).powi(3)));
        // The start must not be symmetric to the directions, because the iteration would stay there.
        longest_axis(weighted, DVec3::new(0.6, 0.5, 0.7)).unwrap_or_default()
    }
}

/// A path runs across a lumen if the lumen's extent along it is at most this multiple of the smallest extent,
/// and less than this fraction of the largest.
const MOST_WIDTHS: f64 = 1.3;
const LEAST_SHARE: f64 = 0.6;

/// Search distance on each side in directions other than the path, in multiples of the extent along it.
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
