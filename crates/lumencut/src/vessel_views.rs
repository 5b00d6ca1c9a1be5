//! Views of one vessel: about a place on it, and from where most of it is seen.

use std::f64::consts::PI;

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::math::frames::{Frames, MovingFrame};
use lumencut_core::vessel_tree::Vessel;

use crate::text::rounded;
use crate::views::{Axis, FINEST, fitted, rotated};

/// How far a view about a place reaches to each side of it, in radii of the vessel there.
const REACH: f64 = 8.0;
/// What stands for a radius that is not known (mm), as `unknown_radius` by default.
const UNKNOWN_RADIUS: f64 = 1.0;
/// The sine of the angle within which a vessel runs along an anterior view, and has no view nearest to it.
const ALONG: f64 = 0.05;
/// The directions that are tried.
const DIRECTIONS: usize = 256;
/// The steps along the vessel at which it is judged what is seen.
const STEPS: usize = 200;
/// How far around a vessel the view of all of it reaches at least, in radii.
const AROUND: f64 = 2.0;
/// What a turn by half a circle costs, as a share of the length of the vessel.
const TURN_COST: f64 = 0.2;

/// The view about a place on a vessel, `at` mm from its first point: the vessel runs upwards in the middle of the picture, which
/// reaches eight radii to each side. At angle 0 it is the one of these views that is nearest to the anterior view; from there the
/// viewer moves by `angle` (radians) about the vessel, as [`rotated`] about the axis `up` does.
///
/// # Errors
/// [`ErrorKind::Camera`] for a place that is not on the vessel, an angle that is not finite, or a size that makes no camera;
/// [`ErrorKind::VesselTree`] for a vessel without length.
pub fn about(vessel: &Vessel, at: f64, angle: f64, size: [usize; 2]) -> Result<Camera> {
    let first = about_lumen(vessel, Lumen { at, radius: radius_at(vessel, at) }, size)?;
    rotated(&first, angle, Axis::Up)
}

/// The lumen at a place on a vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lumen {
    /// How far the place is from the vessel's first point (mm).
    pub at: f64,
    /// Its radius there (mm).
    pub radius: f64,
}

/// The view of [`about`] at angle 0, for a radius that is known otherwise than from the vessel.
///
/// # Errors
/// As [`about`].
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
    let ahead = if across.length() < ALONG { DVec3::Z.reject_from_normalized(up) } else { across };
    let shorter = size[0].min(size[1]).max(1) as f64;
    let spacing = (2.0 * REACH * radius / shorter).max(FINEST);
    Camera::new(path.at(at), ahead, up, size, spacing)
}

/// The direction of a path at a place, whose corners are rounded.
fn tangent_at(path: &CenterlinePath, at: f64) -> DVec3 {
    let first = MovingFrame::looking(path.direction()[0], DVec3::Y);
    Frames::new(path, first).at(at).tangent.normalize()
}

/// The radius of a vessel at a place (mm), linear between its points; 1 mm where it is not known.
pub fn radius_at(vessel: &Vessel, at: f64) -> f64 {
    known_radius_at(vessel, at).unwrap_or(UNKNOWN_RADIUS)
}

/// The same; None where it is not known.
pub(crate) fn known_radius_at(vessel: &Vessel, at: f64) -> Option<f64> {
    let lengths = vessel.arc_length();
    let after = lengths.partition_point(|length| *length < at).clamp(1, lengths.len() - 1);
    let step = lengths[after] - lengths[after - 1];
    let t = if step > 0.0 { ((at - lengths[after - 1]) / step).clamp(0.0, 1.0) } else { 0.0 };
    let [from, to] = [after - 1, after].map(|point| vessel.radius_or_zero(point));
    Some(from + (to - from) * t).filter(|radius| *radius > 0.0)
}

/// The view from which most of a vessel is seen, fitted to all within two radii of it, so that a short one is seen amid what lies
/// beside it: of 256 directions the one with the largest
/// ∫ visible·|T × v| ds − 0.2·L·turn/π, where T is the direction of the vessel, v that of the view, L the length of the vessel and
/// the turn the angle from `camera`. A place is visible where no other stretch of the vessel lies before it. Head, or front, is up;
/// the size is that of `camera`.
///
/// # Errors
/// [`ErrorKind::VesselTree`] for a vessel without length.
pub fn refocused(camera: &Camera, vessel: &Vessel) -> Result<Camera> {
    let path = CenterlinePath::new(vessel, 0.0)?;
    let steps = Steps::along(&path, vessel);
    let worth = |direction: &DVec3| {
        let turn = direction.dot(camera.direction()).clamp(-1.0, 1.0).acos();
        steps.seen(*direction) - TURN_COST * path.length() * turn / PI
    };
    // Where the view does not turn it costs nothing.
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

/// Directions that lie evenly all around: along a spiral by the golden angle.
fn directions() -> impl Iterator<Item = DVec3> {
    let golden = PI * (3.0 - 5f64.sqrt());
    (0..DIRECTIONS).map(move |n| {
        let z = 1.0 - (2 * n + 1) as f64 / DIRECTIONS as f64;
        let (sine, cosine) = (golden * n as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        DVec3::new(across * cosine, across * sine, z)
    })
}

/// What points upwards in a view: the head, or the front where the view runs along the body.
fn upright(direction: DVec3) -> DVec3 {
    let across = direction.x.hypot(direction.y);
    if across > ALONG * direction.z.abs() { DVec3::Z } else { DVec3::NEG_Y }
}

/// Places at even steps along a vessel.
struct Steps {
    /// The length of a step (mm).
    length: f64,
    points: Vec<DVec3>,
    tangents: Vec<DVec3>,
    radii: Vec<f64>,
}

impl Steps {
    fn along(path: &CenterlinePath, vessel: &Vessel) -> Self {
        let length = path.length() / STEPS as f64;
        let places: Vec<_> = (0..STEPS).map(|n| (n as f64 + 0.5) * length).collect();
        Self {
            length,
            points: places.iter().map(|at| path.at(*at)).collect(),
            tangents: places.iter().map(|at| path.direction()[path.segment(*at)]).collect(),
            radii: places.iter().map(|at| radius_at(vessel, *at)).collect(),
        }
    }

    /// The length of the vessel (mm) that is seen along a direction, as long as it is in the picture.
    fn seen(&self, direction: DVec3) -> f64 {
        let seen = |n: usize| self.tangents[n].cross(direction).length();
        (0..STEPS).filter(|n| !self.is_hidden(*n, direction)).map(seen).sum::<f64>() * self.length
    }

    /// The outermost points of all that is to be seen around the vessel in a view.
    fn surroundings(&self, view: &Camera) -> Vec<DVec3> {
        let around = |n: usize| {
            let reach = AROUND * self.radii[n];
            [view.right(), -view.right(), view.up(), -view.up()].map(|side| self.points[n] + side * reach)
        };
        (0..STEPS).flat_map(around).collect()
    }

    /// Whether another stretch of the vessel, farther along it than both are wide, lies before a place.
    fn is_hidden(&self, n: usize, direction: DVec3) -> bool {
        (0..STEPS).any(|other| {
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
