//! Computes camera flights: the views between two cameras.

use glam::{DMat3, DQuat};
use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};

pub(crate) const MOST_FRAMES: usize = 1_000_000;

/// The views of a flight between two cameras; the first and last view are exactly these cameras.
///
/// The flight starts and ends slowly: the progress is 3t² − 2t³ for the time t in 0 to 1. The view turns by the
/// shortest rotation, in proportion to the progress; the pixel spacing changes geometrically. The centre of the
/// closer view moves in a straight line on screen, at a constant speed in pixels, so a flight back retraces the path.
/// Fails with [`ErrorKind::Camera`] for fewer than two or more than `MOST_FRAMES` frames, or cameras of different
/// sizes.
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

/// The progress at a time from 0 to 1.
fn eased(time: f64) -> f64 {
    time * time * (3.0 - 2.0 * time)
}

fn between(from: &Camera, to: &Camera, way: f64) -> Result<Camera> {
    let [start, end] = [from, to].map(orientation);
    let turned = DMat3::from_quat(start.slerp(end, way));
    let spacing = from.pixel_spacing() * (to.pixel_spacing() / from.pixel_spacing()).powf(way);
    // The remaining fraction of the path to the center of the closer view.
    let is_closer = to.pixel_spacing() <= from.pixel_spacing();
    let (near, far, left) = if is_closer { (to, from, 1.0 - way) } else { (from, to, way) };
    let center = near.center() + (far.center() - near.center()) * (left * spacing / far.pixel_spacing());
    Camera::new(center, turned.z_axis, turned.y_axis, from.size(), spacing)
}

/// The rotation from the world's axes to left, up and direction; right, up and direction would be left-handed.
fn orientation(camera: &Camera) -> DQuat {
    DQuat::from_mat3(&DMat3::from_cols(-camera.right(), camera.up(), camera.direction())).normalize()
}

#[cfg(test)]
#[path = "tests/flight.rs"]
mod tests;
