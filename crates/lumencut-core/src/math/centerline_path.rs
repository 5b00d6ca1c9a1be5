//! The centerline of one vessel as a curve: a polyline parametrised by arc length.

use glam::DVec3;

use crate::error::{Error, ErrorKind, Result};
use crate::limits::Limits;
use crate::math::arc_length::{arc_lengths, segment_at};
use crate::math::centerline_smoothing::smooth_centerlines;
use crate::math::same_place::REPEATED_POINT;
use crate::vessel_tree::{Vessel, VesselTree};

const SMOOTHING: Limits = Limits::new(0.0, 1e3, "mm");

/// A polyline without repeated points, extended straight beyond both ends.
#[derive(Clone, Debug)]
pub struct CenterlinePath {
    points: Vec<DVec3>,
    arc_length: Vec<f64>,
    direction: Vec<DVec3>,
}

impl CenterlinePath {
    /// The centerline of a vessel, smoothed along its arc length by a Gaussian with a standard deviation of
    /// `smoothing` mm (0: unchanged). Both ends stay fixed. Fails with [`ErrorKind::VesselTree`] for a vessel
    /// without length, [`ErrorKind::Settings`] for a smoothing outside 0 to 1000 mm.
    pub fn new(vessel: &Vessel, smoothing: f64) -> Result<Self> {
        SMOOTHING.check("smoothing of the centerline", smoothing)?;
        let smoothed = if smoothing > 0.0 { smoothed(vessel, smoothing)? } else { vessel.clone() };
        let mut points: Vec<DVec3> = Vec::with_capacity(smoothed.points().len());
        for point in smoothed.points() {
            if points.last().is_none_or(|last| last.distance(*point) > REPEATED_POINT) {
                points.push(*point);
            }
        }
        if points.len() < 2 {
            let found = "a vessel without length: all of its points coincide";
            let expected = "points at two or more positions";
            return Err(Error::new(ErrorKind::VesselTree, "points of the vessel", found, expected));
        }
        let direction: Vec<_> = points.windows(2).map(|ends| (ends[1] - ends[0]).normalize()).collect();
        let arc_length = arc_lengths(&points);
        Ok(Self { points, arc_length, direction })
    }

    /// The points (mm, LPS).
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Arc length of each point (mm).
    pub fn arc_length(&self) -> &[f64] {
        &self.arc_length
    }

    /// The unit vectors along the segments, one fewer than points.
    pub fn direction(&self) -> &[DVec3] {
        &self.direction
    }

    /// The length of the path (mm).
    pub fn length(&self) -> f64 {
        self.arc_length[self.arc_length.len() - 1]
    }

    /// The segment at arc length `t` (mm); beyond the ends the first or last one.
    pub fn segment(&self, t: f64) -> usize {
        segment_at(&self.arc_length, t)
    }

    /// The point at arc length `t` (mm), extrapolated straight beyond both ends.
    pub fn at(&self, t: f64) -> DVec3 {
        let segment = self.segment(t);
        self.points[segment] + self.direction[segment] * (t - self.arc_length[segment])
    }
}

/// The vessel without radii, its points averaged by a Gaussian with a standard deviation of `length` (mm). Ends stay. Fails with
/// [`ErrorKind::VesselTree`] for a length that no radius can have.
pub fn smoothed(vessel: &Vessel, length: f64) -> Result<Vessel> {
    let points = vessel.points().to_vec();
    let lengths = vec![length; points.len()];
    let tree = VesselTree::new(vec![Vessel::new(points, Some(lengths))?])?;
    Ok(smooth_centerlines(&tree, 1.0).vessels()[0].clone())
}

#[cfg(test)]
#[path = "tests/centerline_path.rs"]
mod tests;
