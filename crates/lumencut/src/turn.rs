//! Turntables: the angle of each frame, and a view that fits every frame.

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};

use crate::text::shortest;
use crate::views::{Axis, MARGIN, centered, in_plane, rotated, spacing_for};

/// Number of sampled views. Between them, the extent grows by at most a fraction of the margin.
const VIEWS_OF_A_TURN: usize = 72;

/// The angle of each frame of a turntable (radians). A full turn stops one step before its end. Fails with
/// [`ErrorKind::Camera`] for a non-finite angle.
pub fn frame_angles(frames: usize, degrees: f64) -> Result<Vec<f64>> {
    if !degrees.is_finite() {
        let (found, expected) = (shortest(degrees), "a finite number");
        return Err(Error::new(ErrorKind::Camera, "degrees of the turntable", found, expected));
    }
    let end = degrees.to_radians();
    let is_whole = degrees % 360.0 == 0.0;
    let steps = if is_whole { frames } else { frames.saturating_sub(1) };
    let step = end / steps.max(1) as f64;
    // Adding 0 turns -0 into 0, the first angle of a reverse turn.
    let mut angles: Vec<f64> = (0..frames).map(|frame| 0.0 + frame as f64 * step).collect();
    if !is_whole && frames > 1 {
        angles[frames - 1] = end;
    }
    Ok(angles)
}

/// The camera at the centre of the points that shows all of them in every frame of a turn. Direction, up and size
/// stay. Fails with [`ErrorKind::Camera`] without points, for a non-finite angle or an invalid axis.
pub fn fitted_turn(camera: &Camera, points: &[DVec3], degrees: f64, axis: Axis) -> Result<Camera> {
    let first = centered(camera, points)?;
    let mut reach = [0.0f64; 2];
    for angle in frame_angles(VIEWS_OF_A_TURN, degrees)? {
        let turned = rotated(&first, angle, axis)?;
        for point in points {
            let [right, up] = in_plane(&turned, *point);
            reach = [reach[0].max(right.abs()), reach[1].max(up.abs())];
        }
    }
    let spacing = spacing_for(&first, reach, 0.5 - MARGIN);
    Camera::new(first.center(), first.direction(), first.up(), first.size(), spacing)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn front() -> Camera {
        Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [100, 50], 1.0).unwrap()
    }

    #[test]
    fn a_whole_turn_leaves_out_its_end() {
        assert_eq!(frame_angles(4, 360.0).unwrap(), [0.0, PI / 2.0, PI, 1.5 * PI]);
        assert_eq!(frame_angles(3, 180.0).unwrap(), [0.0, PI / 2.0, PI]);
        assert_eq!(frame_angles(2, 0.0).unwrap(), [0.0, 0.0]);
        assert_eq!(frame_angles(1, 90.0).unwrap(), [0.0]);
        let back = frame_angles(2, -360.0).unwrap();
        assert_eq!((back[0].is_sign_positive(), back[1]), (true, -PI));
    }

    #[test]
    fn a_turn_needs_a_finite_angle() {
        let error = frame_angles(3, f64::NAN).unwrap_err();
        assert_eq!(error.to_string(), "degrees of the turntable: found nan; expected a finite number");
    }

    #[test]
    fn the_widest_of_all_views_fits() {
        // A rod along the line of sight is widest after a quarter turn: then its 80 mm lie across the image.
        let ends = [DVec3::new(1.0, -40.0, 2.0), DVec3::new(1.0, 40.0, 2.0)];
        let fitted = fitted_turn(&front(), &ends, 360.0, Axis::Superior).unwrap();
        assert_eq!(fitted.center(), DVec3::new(1.0, 0.0, 2.0));
        assert!((fitted.pixel_spacing() - 80.0 / (100.0 * 0.88)).abs() < 1e-12);
        assert_eq!(fitted.direction(), DVec3::Y);
        // If it turns about the line of sight, it never lies across.
        let fitted = fitted_turn(&front(), &ends, 360.0, Axis::Direction).unwrap();
        assert_eq!(fitted.pixel_spacing(), 1e-3);
    }
}
