//! Views of one vessel: about a place on it, or showing as much of it as possible.

use std::f64::consts::PI;

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::math::frames::{Frames, MovingFrame};
use lumencut_core::vessel_tree::Vessel;

use crate::text::rounded;
use crate::views::{Axis, FINEST, fitted, rotated};

/// Half the width of a view about a place, in radii at the place.
const HALF_WIDTH_RADII: f64 = 8.0;
/// Used if a radius is unknown (mm); equals the default of `unknown_radius`.
const UNKNOWN_RADIUS_MM: f64 = 1.0;
/// If the sine of the angle between vessel and anterior direction is below this, the view at angle 0 looks along the body.
const MIN_ANTERIOR_SINE: f64 = 0.05;
const TRIED_DIRECTIONS: usize = 256;
const VISIBILITY_SAMPLES: usize = 200;
/// The smallest margin around a whole vessel, in radii.
const MARGIN_RADII: f64 = 2.0;
/// The cost of turning the view by half a turn, as a fraction of the vessel's length.
const TURN_COST: f64 = 0.2;

/// The view about a place `at` mm along a vessel, which runs upwards through the middle. The view extends eight radii
/// to each side. Angle 0 is the view nearest to anterior; from there the viewer moves by `angle` (radians), as
/// [`rotated`] about `up`. Fails with [`ErrorKind::Camera`] for a place off the vessel, a non-finite angle or an
/// invalid size; [`ErrorKind::VesselTree`] for a vessel without length.
pub fn about(vessel: &Vessel, at: f64, angle: f64, size: [usize; 2]) -> Result<Camera> {
    let first = about_lumen(vessel, Lumen { at, radius: radius_at(vessel, at) }, size)?;
    rotated(&first, angle, Axis::Up)
}

/// The lumen at a place on a vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lumen {
    /// Arc length (mm).
    pub at: f64,
    /// Radius (mm).
    pub radius: f64,
}

/// As [`about`] at angle 0, with a radius that the caller knows.
pub(crate) fn about_lumen(vessel: &Vessel, Lumen { at, radius }: Lumen, size: [usize; 2]) -> Result<Camera> {
    let path = CenterlinePath::new(vessel, 0.0)?;
    if !(0.0..=path.length()).contains(&at) {
        let found = format!("{} mm on a vessel of {} mm", rounded(at, 6), rounded(path.length(), 6));
        let expected = "a place between its first and its last point";
        return Err(Error::new(ErrorKind::Camera, "place of the view", found, expected));
    }
    let tangent = tangent_at(&path, at);
    let up = if tangent.z < 0.0 { -tangent } else { tangent };
    let across = DVec3::Y.reject_from_normalized(up);
    let ahead =
        if across.length() < MIN_ANTERIOR_SINE { DVec3::Z.reject_from_normalized(up) } else { across };
    let shorter = size[0].min(size[1]).max(1) as f64;
    let spacing = (2.0 * HALF_WIDTH_RADII * radius / shorter).max(FINEST);
    Camera::new(path.at(at), ahead, up, size, spacing)
}

fn tangent_at(path: &CenterlinePath, at: f64) -> DVec3 {
    let first = MovingFrame::looking(path.direction()[0], DVec3::Y);
    Frames::new(path, first).at(at).tangent.normalize()
}

/// The radius of a vessel at a place (mm), linearly interpolated; 1 mm if unknown.
pub fn radius_at(vessel: &Vessel, at: f64) -> f64 {
    known_radius_at(vessel, at).unwrap_or(UNKNOWN_RADIUS_MM)
}

/// As [`radius_at`]; None if unknown.
pub(crate) fn known_radius_at(vessel: &Vessel, at: f64) -> Option<f64> {
    let lengths = vessel.arc_length();
    let after = lengths.partition_point(|length| *length < at).clamp(1, lengths.len() - 1);
    let step = lengths[after] - lengths[after - 1];
    let t = if step > 0.0 { ((at - lengths[after - 1]) / step).clamp(0.0, 1.0) } else { 0.0 };
    let [from, to] = [after - 1, after].map(|point| vessel.radius_or_zero(point));
    Some(from + (to - from) * t).filter(|radius| *radius > 0.0)
}

/// The view that shows most of a vessel, fitted to it with a margin of two radii. Of 256 directions it is the one
/// with the largest ∫ visible·sin∠(T, v) ds − 0.2·L·turn/π. T is the vessel's direction, v the view's direction, L
/// the length, and turn the angle from `camera`. A place is visible if no other stretch lies in front of it. The
/// head, else the front, is up; the size is that of `camera`. Fails with [`ErrorKind::VesselTree`] for a vessel
/// without length.
pub fn refocused(camera: &Camera, vessel: &Vessel) -> Result<Camera> {
    let path = CenterlinePath::new(vessel, 0.0)?;
    let steps = Steps::along(&path, vessel);
    let worth = |direction: &DVec3| {
        let turn = direction.dot(camera.direction()).clamp(-1.0, 1.0).acos();
        steps.seen(*direction) - TURN_COST * path.length() * turn / PI
    };
    // Keeping the current direction costs nothing.
    let best = std::iter::once(camera.direction())
        .chain(directions())
        .map(|direction| (worth(&direction), direction))
        .fold(
            (f64::NEG_INFINITY, camera.direction()),
            |best, next| if next.0 > best.0 { next } else { best },
        );
    let up = upright(best.1);
    let view = Camera::new(camera.center(), best.1, up, camera.size(), 1.0)?;
    fitted(&view, &steps.surroundings(&view))
}

fn directions() -> impl Iterator<Item = DVec3> {
    let golden = PI * (3.0 - 5f64.sqrt());
    (0..TRIED_DIRECTIONS).map(move |n| {
        let z = 1.0 - (2 * n + 1) as f64 / TRIED_DIRECTIONS as f64;
        let (sine, cosine) = (golden * n as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        DVec3::new(across * cosine, across * sine, z)
    })
}

/// What is up in a view: the head, or the front if the view runs along the body.
fn upright(direction: DVec3) -> DVec3 {
    let across = direction.x.hypot(direction.y);
    if across > MIN_ANTERIOR_SINE * direction.z.abs() { DVec3::Z } else { DVec3::NEG_Y }
}

struct Steps {
    /// Step (mm).
    length: f64,
    points: Vec<DVec3>,
    tangents: Vec<DVec3>,
    radii: Vec<f64>,
}

impl Steps {
    fn along(path: &CenterlinePath, vessel: &Vessel) -> Self {
        let length = path.length() / VISIBILITY_SAMPLES as f64;
        let places: Vec<_> = (0..VISIBILITY_SAMPLES).map(|n| (n as f64 + 0.5) * length).collect();
        Self {
            length,
            points: places.iter().map(|at| path.at(*at)).collect(),
            tangents: places.iter().map(|at| path.direction()[path.segment(*at)]).collect(),
            radii: places.iter().map(|at| radius_at(vessel, *at)).collect(),
        }
    }

    /// The visible length (mm), projected along a direction.
    fn seen(&self, direction: DVec3) -> f64 {
        let seen = |n: usize| self.tangents[n].cross(direction).length();
        (0..VISIBILITY_SAMPLES).filter(|n| !self.is_hidden(*n, direction)).map(seen).sum::<f64>()
            * self.length
    }

    fn surroundings(&self, view: &Camera) -> Vec<DVec3> {
        let around = |n: usize| {
            let reach = MARGIN_RADII * self.radii[n];
            [view.right(), -view.right(), view.up(), -view.up()].map(|side| self.points[n] + side * reach)
        };
        (0..VISIBILITY_SAMPLES).flat_map(around).collect()
    }

    fn is_hidden(&self, n: usize, direction: DVec3) -> bool {
        (0..VISIBILITY_SAMPLES).any(|other| {
            let offset = self.points[other] - self.points[n];
            let along = other.abs_diff(n) as f64 * self.length;
            let depth = offset.dot(direction);
            let aside = (offset - direction * depth).length();
            depth < 0.0 && aside < self.radii[other] && along > 2.0 * (self.radii[other] + self.radii[n])
        })
    }
}

#[cfg(test)]
#[path = "tests/vessel_views.rs"]
mod tests;
