//! The cut locus of a vessel: how far around it each of its places is the nearest one. What lies beyond belongs to another part of it.

use glam::DVec3;

use super::segments::Segments;
use crate::math::centerline_path::CenterlinePath;

/// A point belongs to another part of the vessel where that is nearer by more than this share: images are tilted a little where
/// corners of the centerline are rounded, and where a bent vessel changes its depth, which moves the nearest place.
pub(super) const NEARER: f64 = 0.05;

/// The cut locus of one vessel.
pub(super) struct CutLocus<'a> {
    path: &'a CenterlinePath,
    segments: Segments,
}

impl<'a> CutLocus<'a> {
    pub(super) fn new(path: &'a CenterlinePath) -> Self {
        let ends = path.points().windows(2).map(|ends| [ends[0], ends[1]]).collect();
        Self { path, segments: Segments::new(ends) }
    }

    /// Whether a point that is shown beside the vessel at an arc length (mm) lies beyond.
    pub(super) fn is_beyond(&self, point: DVec3, at: f64) -> bool {
        self.segments.any_within(point, point.distance(self.path.at(at)) * (1.0 - NEARER))
    }
}
