//! How drags, the wheel and keys change a camera and a window; the page and the notebook read the same constants.
//! Drags are in pixels of the picture, to the right and down. Pixels are (column, row) from the middle of the first
//! one.

use std::f64::consts::PI;

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};

use crate::fused;
use crate::text::shortest;
use crate::views::{panned, rotation};

/// A constant of the gestures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gesture {
    /// Its name in Rust, Python and the page.
    pub name: &'static str,
    /// Its value, in the unit.
    pub value: f64,
    /// `px` are pixels of the screen; `1` is a number without a unit.
    pub unit: &'static str,
    /// Its meaning, in one sentence.
    pub about: &'static str,
}

const TURN_PER_HEIGHT: f64 = PI;
const FINEST: f64 = 0.005;
const COARSEST: f64 = 20.0;
const WINDOW_PER_PIXEL: f64 = 0.004;
const NARROWEST: f64 = 1e-3;

/// All constants of the gestures.
pub const GESTURES: [Gesture; 19] = [
    row("drag_from", 4.0, "px", "Movement above which a press becomes a drag"),
    row("double_within", 350.0, "ms", "Time below which two clicks are a double click"),
    row("double_near", 6.0, "px", "Largest distance of the two clicks of a double click"),
    row("zoom_per_wheel", 0.0016, "1/px", "Logarithm of the zoom per pixel of the wheel"),
    row("most_wheel", 120.0, "px", "Most pixels of one wheel event that zoom"),
    row("wheel_line", 40.0, "px", "Pixels of a line of the wheel, in browsers that report lines"),
    row(
        "notch_from",
        60.0,
        "px",
        "Wheel movement from which an event is a notch of a mouse; trackpads report less",
    ),
    row("notch", 110.0, "px", "Wheel movement of a notch"),
    row("notch_lines", 3.0, "1", "Lines of a notch, in browsers that report lines"),
    row("scroll_step", 40.0, "px", "Movement of a trackpad that scrolls one step"),
    row("finger_gain", 4.0, "1", "Movement of a trackpad to which the same movement of a finger is equal"),
    row("far_steps", 10.0, "1", "Steps for each one, with Shift or a page key"),
    row("key_step", 24.0, "px", "Drag to which an arrow key is equal"),
    row("key_zoom", 1.2, "1", "Zoom of the keys + and -"),
    row("turn_per_height", TURN_PER_HEIGHT, "rad", "Rotation of a drag as long as the view is high"),
    row("finest_spacing", FINEST, "mm", "Smallest pixel spacing that zooming reaches"),
    row("coarsest_spacing", COARSEST, "mm", "Largest pixel spacing that zooming reaches"),
    row(
        "window_per_pixel",
        WINDOW_PER_PIXEL,
        "1/px",
        "Part of the window's width by which a drag changes it",
    ),
    row("narrowest_window", NARROWEST, "value", "Smallest width of a window, in values of the volume"),
];

const fn row(name: &'static str, value: f64, unit: &'static str, about: &'static str) -> Gesture {
    Gesture { name, value, unit, about }
}

/// The camera rotated about an axis (LPS) through a point (mm, LPS), by an angle (radians). Fails with
/// [`ErrorKind::Camera`] for a non-finite angle or point, an invalid axis, or a center out of range.
pub(crate) fn turned_about(camera: &Camera, pivot: DVec3, axis: DVec3, angle: f64) -> Result<Camera> {
    let turn = rotation(axis, angle)?;
    let vectors = [camera.center() - pivot, camera.direction(), camera.up()];
    let [away, direction, up] = vectors.map(|vector| fused::product(&turn, vector));
    Camera::new(pivot + away, direction, up, camera.size(), camera.pixel_spacing())
}

/// The camera after a drag over a ball that fills the view. Fails as `turned_about` does.
pub fn trackballed(camera: &Camera, pivot: DVec3, [right, down]: [f64; 2]) -> Result<Camera> {
    // Not `hypot`: its last bit differs between platforms.
    let pixels = (right * right + down * down).sqrt();
    if pixels == 0.0 {
        return Ok(*camera);
    }
    let axis = -right * camera.up() - down * camera.right();
    turned_about(camera, pivot, axis, angle_of(camera, pixels))
}

/// The camera after a drag to the right about an axis (LPS). Fails as `turned_about` does.
pub fn spun(camera: &Camera, pivot: DVec3, axis: DVec3, right: f64) -> Result<Camera> {
    turned_about(camera, pivot, axis, -angle_of(camera, right))
}

fn angle_of(camera: &Camera, pixels: f64) -> f64 {
    pixels * (TURN_PER_HEIGHT / camera.size()[1] as f64)
}

/// The camera after a drag that moves the scene with the pointer. Fails with [`ErrorKind::Camera`] for non-finite or
/// too large distances.
pub fn dragged(camera: &Camera, [right, down]: [f64; 2]) -> Result<Camera> {
    let side = camera.pixel_spacing();
    panned(camera, -right * side, down * side)
}

/// The camera magnified by a factor, within the limits of the pixel spacing; the point under the pixel stays there.
/// Fails with [`ErrorKind::Camera`] for a factor that is not positive and finite, or a non-finite pixel.
pub fn zoomed_at(camera: &Camera, factor: f64, [column, row]: [f64; 2]) -> Result<Camera> {
    if !(factor.is_finite() && factor > 0.0) {
        let expected = "a number above 0";
        return Err(Error::new(ErrorKind::Camera, "factor of the zoom", shortest(factor), expected));
    }
    let spacing = (camera.pixel_spacing() / factor).clamp(FINEST, COARSEST);
    let away = camera.pixel_spacing() - spacing;
    let [x, y] = camera.size().map(|count| (count as f64 - 1.0) / 2.0);
    let moved = panned(camera, (column - x) * away, (y - row) * away)?;
    Camera::new(moved.center(), moved.direction(), moved.up(), moved.size(), spacing)
}

/// The same view with fewer pixels: `share` is the fraction along each side; at least one pixel stays. Fails with [`ErrorKind::Camera`] for a
/// size or spacing out of range.
pub fn sampled(camera: &Camera, share: f64) -> Result<Camera> {
    let size = camera.size().map(|count| (count as f64 * share).round().max(1.0) as usize);
    let spacing = camera.pixel_spacing() * camera.size()[1] as f64 / size[1] as f64;
    Camera::new(camera.center(), camera.direction(), camera.up(), size, spacing)
}

/// Level and width of a window after a drag: to the right it is wider, upwards the picture is brighter.
pub fn dragged_window([level, width]: [f64; 2], [right, down]: [f64; 2]) -> [f64; 2] {
    let wider = (width * (right * WINDOW_PER_PIXEL).exp()).max(NARROWEST);
    [level + down * WINDOW_PER_PIXEL * width, wider]
}

#[cfg(test)]
#[path = "tests/drags.rs"]
mod tests;
