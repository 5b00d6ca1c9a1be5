//! The cut locus of a vessel: the distance up to which each of its points is the nearest one. Beyond lies
//! what belongs to another part of it.

use glam::DVec3;

use super::segments::Segments;
use crate::math::centerline_path::CenterlinePath;

/// A point belongs to another part of the vessel if that is nearer by more than this share. Images tilt a
/// little at rounded corners and where a bent vessel changes its depth, which moves the nearest point.
pub(super) const NEARER: f64 = 0.05;

pub(super) struct CutLocus<'a> {
    path: &'a CenterlinePath,
    segments: Segments,
}

impl<'a> CutLocus<'a> {
    pub(super) fn new(path: &'a CenterlinePath) -> Self {
        let ends = path.points().windows(2).map(|ends| [ends[0], ends[1]]).collect();
        Self { path, segments: Segments::new(ends) }
    }

    /// Whether a point shown next to the vessel at an arc length (mm) lies beyond the cut locus.
    pub(super) fn is_beyond(&self, point: DVec3, at: f64) -> bool {
        self.segments.any_within(point, point.distance(self.path.at(at)) * (1.0 - NEARER))
    }
}
