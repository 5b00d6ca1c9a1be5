//! Cameras, and the pixels of their frames.

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::math::lanes::Isa;
use lumencut_core::stages::Work;
use lumencut_core::vessel_tree::VesselTree;

/// The view of `center` along `direction`: z is up, or y if the view runs along z.
fn view_of(center: DVec3, direction: DVec3, size: [usize; 2], pixel_spacing: f64) -> Camera {
    let is_along_z = direction.cross(DVec3::Z).length() < 1e-3 * direction.length();
    let up = if is_along_z { DVec3::Y } else { DVec3::Z };
    Camera::new(center, direction, up, size, pixel_spacing).unwrap()
}

pub fn view(direction: [f64; 3], size: [usize; 2], pixel_spacing: f64) -> Camera {
    view_of(DVec3::ZERO, DVec3::from_array(direction), size, pixel_spacing)
}

/// As [`view`], slightly shifted. In a view along a grid axis, no ray then passes through voxel centres, where rounding would
/// choose the neighbouring voxels.
pub fn view_beside_voxels(direction: [f64; 3], size: [usize; 2], pixel_spacing: f64) -> Camera {
    view_of(DVec3::new(0.013, -0.021, 0.017), DVec3::from_array(direction), size, pixel_spacing)
}

/// The view from the front: view x is world x, view y is world z, and depth is world y.
pub fn front(size: [usize; 2], pixel_spacing: f64) -> Camera {
    view([0.0, 1.0, 0.0], size, pixel_spacing)
}

/// The view along `direction` that fits `tree` into a square of `side` pixels.
pub fn fitted(tree: &VesselTree, direction: DVec3, side: usize) -> Camera {
    let (low, high) = tree.bounds();
    let extent = (high - low).length() / 1.2;
    view_of((low + high) * 0.5, direction, [side; 2], extent / side as f64)
}

/// Input of the CPU stages: the widest instruction set, never stopped.
pub fn on_cpu(camera: &Camera) -> Work<'static> {
    Work { size: camera.size(), isa: Isa::widest(), stop: &|| false, progress: None }
}

/// The pixel nearest to view (x, y).
pub fn pixel(frame: &Frame, x: f64, y: f64) -> usize {
    let [width, height] = frame.size();
    let s = frame.geometry.camera().unwrap().pixel_spacing();
    let i = (x / s + width as f64 / 2.0 - 0.5).round() as usize;
    let j = (height as f64 / 2.0 - 0.5 - y / s).round() as usize;
    j * width + i
}

/// The value at the pixel nearest to view (x, y).
pub fn at(frame: &Frame, values: &[f32], x: f64, y: f64) -> f32 {
    values[pixel(frame, x, y)]
}
