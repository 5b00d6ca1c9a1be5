//! Flights: the views on the way from one camera to another.

use glam::{DMat3, DQuat};
use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};

/// The most frames of a flight.
pub(crate) const MOST_FRAMES: usize = 1_000_000;

/// The views of a flight from one camera to another, the first and the last of which are these cameras to the bit.
///
/// It begins and ends at rest: the way that is done grows as 3t² − 2t³ with the time t from 0 to 1. The view turns by the shortest
/// rotation, evenly with the way, and the pixel spacing changes by equal factors on equal parts of it. What is in the middle of the
/// closer view goes straight to the middle of the picture, or from it: seen in pixels its way is even too. So a flight back is the
/// same flight from its end.
///
/// # Errors
/// [`ErrorKind::Camera`] for fewer than two frames, for more than [`MOST_FRAMES`], or for cameras of different sizes.
pub fn flight(from: &Camera, to: &Camera, frames: usize) -> Result<Vec<Camera>> {
    if !(2..=MOST_FRAMES).contains(&frames) {
        let expected = format!("2 to {MOST_FRAMES} frames");
        return Err(Error::new(
            ErrorKind::Camera,
            "frames of the flight",
            format!("{frames} frame(s)"),
            expected,
        ));
    }
    if from.size() != to.size() {
        let [[a, b], [c, d]] = [from.size(), to.size()];
        let found = format!("{a} × {b} pixels at its start and {c} × {d} at its end");
        return Err(Error::new(ErrorKind::Camera, "size of the flight", found, "one size"));
    }
    let last = frames - 1;
    let view = |frame: usize| match frame {
        0 => Ok(*from),
        frame if frame == last => Ok(*to),
        frame => between(from, to, eased(frame as f64 / last as f64)),
    };
    (0..frames).map(view).collect()
}

/// The share of the way that is done at a time from 0 to 1.
fn eased(time: f64) -> f64 {
    time * time * (3.0 - 2.0 * time)
}

/// The view at a share of the way.
fn between(from: &Camera, to: &Camera, way: f64) -> Result<Camera> {
    let [start, end] = [from, to].map(orientation);
    let turned = DMat3::from_quat(start.slerp(end, way));
    let spacing = from.pixel_spacing() * (to.pixel_spacing() / from.pixel_spacing()).powf(way);
    // What stays of the way of the center is counted from the closer view, whose middle it leads to.
    let is_closer = to.pixel_spacing() <= from.pixel_spacing();
    let (near, far, left) = if is_closer { (to, from, 1.0 - way) } else { (from, to, way) };
    let center = near.center() + (far.center() - near.center()) * (left * spacing / far.pixel_spacing());
    Camera::new(center, turned.z_axis, turned.y_axis, from.size(), spacing)
}

/// The rotation of the axes of the world to left, up and direction of a camera; right, up and direction are left-handed.
fn orientation(camera: &Camera) -> DQuat {
    DQuat::from_mat3(&DMat3::from_cols(-camera.right(), camera.up(), camera.direction())).normalize()
}

#[cfg(test)]
#[path = "tests/flight.rs"]
mod tests;
