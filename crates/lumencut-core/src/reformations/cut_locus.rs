//! The cut locus of a vessel: beyond it, points are nearer to another part of the vessel.

use glam::DVec3;

use super::segments::Segments;
use crate::math::centerline_path::CenterlinePath;

/// Another part counts as nearer only by this fraction of the distance, because images are slightly distorted.
pub(super) const MIN_DISTANCE_EXCESS: f64 = 0.05;

pub(super) struct CutLocus<'a> {
    path: &'a CenterlinePath,
    segments: Segments,
}

impl<'a> CutLocus<'a> {
    pub(super) fn new(path: &'a CenterlinePath) -> Self {
        let ends = path.points().windows(2).map(|ends| [ends[0], ends[1]]).collect();
        Self { path, segments: Segments::new(ends) }
    }

    pub(super) fn is_beyond(&self, point: DVec3, at: f64) -> bool {
        self.segments.any_within(point, point.distance(self.path.at(at)) * (1.0 - MIN_DISTANCE_EXCESS))
    }
}
