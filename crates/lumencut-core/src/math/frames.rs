//! A rotation-minimising frame along a path, by double reflection (Wang, Jüttler, Zheng, Liu: Computation of
//! Rotation Minimizing Frames, ACM Transactions on Graphics 27(1), 2008, doi:10.1145/1330511.1330513).
//!
//! In the middle of a segment the tangent is the segment's direction. Around each inner point it turns along
//! a great circle at a constant rate: over half of the shorter neighbouring segment, at most `MAX_CORNER_MM`,
//! to each side. So the tangent never jumps, and sections are perpendicular to straight runs.

use glam::{DQuat, DVec3};

use super::centerline_path::CenterlinePath;

/// The largest length before and after a point over which its corner is rounded (mm).
pub(crate) const MAX_CORNER_MM: f64 = 5.0;

/// Two directions count as equal if the sine of their angle is below this.
const SAME_DIRECTION: f64 = 1e-12;

/// A right-handed set of unit vectors: `across` × `tangent` = `ahead`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingFrame {
    /// Along the path; downwards in a picture.
    pub tangent: DVec3,
    /// To the right in a picture.
    pub across: DVec3,
    /// From the viewer of a picture into the scene.
    pub ahead: DVec3,
}

impl MovingFrame {
    /// The frame with this unit tangent; `ahead` is made perpendicular to it, or replaced if parallel to it.
    pub fn looking(tangent: DVec3, ahead: DVec3) -> Self {
        let perpendicular = ahead.reject_from_normalized(tangent).try_normalize();
        let ahead = perpendicular.unwrap_or_else(|| tangent.any_orthonormal_vector());
        Self { tangent, across: tangent.cross(ahead), ahead }
    }

    /// The frame turned about its tangent by the angle of this sine and cosine: the viewer moves right.
    #[must_use]
    pub fn turned(self, [sine, cosine]: [f64; 2]) -> Self {
        let Self { tangent, across, ahead } = self;
        Self { tangent, across: across * cosine + ahead * sine, ahead: ahead * cosine - across * sine }
    }

    fn rotated(self, by: DQuat) -> Self {
        Self { tangent: by * self.tangent, across: by * self.across, ahead: by * self.ahead }
    }
}

/// A position on the path; from there to the next station the frame turns at a constant rate.
#[derive(Clone, Copy, Debug)]
pub struct Station {
    /// Arc length (mm).
    pub at: f64,
    /// The frame here.
    pub frame: MovingFrame,
    /// Rotation vector per mm up to the next station (radians per mm).
    pub turn: DVec3,
}

impl Station {
    pub(crate) fn frame_at(&self, t: f64) -> MovingFrame {
        if self.turn == DVec3::ZERO {
            return self.frame;
        }
        self.frame.rotated(DQuat::from_scaled_axis(self.turn * (t - self.at)))
    }
}

/// The moving frame along a path.
#[derive(Clone, Debug)]
pub struct Frames {
    stations: Vec<Station>,
}

impl Frames {
    /// The frame along `path`. It starts as `first`, whose tangent is that of the first segment.
    pub fn new(path: &CenterlinePath, first: MovingFrame) -> Self {
        let mut stations = vec![Station { at: 0.0, frame: first, turn: DVec3::ZERO }];
        for i in 1..path.direction().len() {
            let [from, to] = [path.direction()[i - 1], path.direction()[i]];
            if from.dot(to) > 0.0 && from.cross(to).length() < SAME_DIRECTION {
                continue;
            }
            let [before, at, after] = [-1, 0, 1].map(|n| path.arc_length()[i.wrapping_add_signed(n)]);
            let reach = MAX_CORNER_MM.min((at - before).min(after - at) / 2.0);
            let frame = stations[stations.len() - 1].frame;
            let [start, end] = [at - reach, at + reach];
            stations.push(Station { at: start, frame, turn: turn(frame, to) / (end - start) });
            let next = double_reflection(frame, path.at(end) - path.at(start), to);
            stations.push(Station { at: end, frame: next, turn: DVec3::ZERO });
        }
        Self { stations }
    }

    /// The stations by rising arc length. The frame is constant before the first and after the last.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// The last station at or before arc length `t`; if there is none, the first station.
    pub fn station(&self, t: f64) -> &Station {
        &self.stations[self.stations.partition_point(|station| station.at <= t).max(1) - 1]
    }

    /// The frame at arc length `t` (mm).
    pub fn at(&self, t: f64) -> MovingFrame {
        self.station(t).frame_at(t)
    }
}

/// The smallest rotation vector (radians) that turns the tangent to `to`; a reversal turns about `ahead`.
fn turn(frame: MovingFrame, to: DVec3) -> DVec3 {
    let axis = frame.tangent.cross(to);
    let angle = axis.length().atan2(frame.tangent.dot(to));
    axis.try_normalize().filter(|_| axis.length() >= SAME_DIRECTION).unwrap_or(frame.ahead) * angle
}

/// The frame with the tangent `to` after a step along `chord`, by reflection in two planes.
pub fn double_reflection(frame: MovingFrame, chord: DVec3, to: DVec3) -> MovingFrame {
    let [tangent, ahead] = [frame.tangent, frame.ahead].map(|vector| reflected(vector, chord));
    let ahead = reflected(ahead, to - tangent);
    MovingFrame::looking(to, ahead)
}

/// A vector mirrored in the plane perpendicular to `normal` (of any length); unchanged if `normal` is zero.
fn reflected(vector: DVec3, normal: DVec3) -> DVec3 {
    let square = normal.length_squared();
    if square < SAME_DIRECTION * SAME_DIRECTION {
        vector
    } else {
        vector - normal * (2.0 * normal.dot(vector) / square)
    }
}

#[cfg(test)]
#[path = "tests/frames.rs"]
mod tests;
