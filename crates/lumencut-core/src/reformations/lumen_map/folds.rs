//! Where sections across a vessel have met before they reach a place, so that the place belongs to another part of the vessel.

use glam::{DVec2, DVec3};

use crate::math::centerline_path::CenterlinePath;
use crate::reformations::cpr::Straightened;

/// A place belongs to another part of the vessel where that is nearer by more than this share. Sections are tilted by as much as
/// corners of the centerline are rounded, which moves the nearest point a little.
const NEARER: f64 = 0.05;

/// The cut locus of a vessel: how far around it each of its points is the nearest one.
pub(super) struct Folds<'a> {
    path: &'a CenterlinePath,
    straightened: &'a Straightened,
}

impl<'a> Folds<'a> {
    pub fn new(path: &'a CenterlinePath, straightened: &'a Straightened) -> Self {
        Self { path, straightened }
    }

    /// Whether the places at these offsets (mm) in the section at an arc length are folded.
    pub fn row(&self, at: f64, offsets: impl Iterator<Item = DVec2>) -> Vec<bool> {
        let offsets: Vec<DVec2> = offsets.collect();
        let farthest = offsets.iter().map(|offset| offset.length()).fold(0.0, f64::max);
        let near = self.near(self.path.at(at), 2.0 * farthest);
        let is_folded = |offset: &DVec2| {
            self.straightened.advance(at, *offset) <= 0.0
                || self.is_elsewhere(
                    self.straightened.world_from_straightened(offset.extend(at)),
                    *offset,
                    &near,
                )
        };
        offsets.iter().map(is_folded).collect()
    }

    /// The segments of the path within a distance (mm) of a point.
    fn near(&self, point: DVec3, distance: f64) -> Vec<[DVec3; 2]> {
        let ends = self.path.points().windows(2).map(|ends| [ends[0], ends[1]]);
        ends.filter(|ends| squared_distance(point, *ends) <= distance * distance).collect()
    }

    fn is_elsewhere(&self, point: DVec3, offset: DVec2, near: &[[DVec3; 2]]) -> bool {
        let own = offset.length() * (1.0 - NEARER);
        near.iter().any(|ends| squared_distance(point, *ends) < own * own)
    }
}

fn squared_distance(point: DVec3, [start, end]: [DVec3; 2]) -> f64 {
    let along = end - start;
    let share = ((point - start).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    point.distance_squared(start + along * share)
}
