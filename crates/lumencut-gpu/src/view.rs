//! The view as shaders read it, and buffers for images of its pixels.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::geometry::Geometry;
use wgpu::{Buffer, BufferUsages};

use crate::device::Device;

/// Has the layout of `ViewParameters` in `math/view.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct ViewParameters {
    pub size: [u32; 2],
    /// The side of a pixel (mm), split into a part of twelve binary digits and the rest.
    pub spacing: [f32; 2],
    /// The axes of view space, in world coordinates.
    pub axes: [Axis; 3],
}

/// Has the layout of `Axis` in `math/view.wgsl`: a unit vector, split into a part of few digits and the rest.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Axis {
    /// The part of few digits: multiples of 2⁻¹⁰.
    pub coarse: [f32; 4],
    pub fine: [f32; 4],
}

pub(crate) const AXIS_UNIT: f64 = 1.0 / 1024.0;

impl Axis {
    fn new(axis: DVec3) -> Self {
        let [x, y, z] = axis.to_array().map(|c| split_at(c, AXIS_UNIT));
        Self { coarse: [x[0], y[0], z[0], 0.0], fine: [x[1], y[1], z[1], 0.0] }
    }
}

impl ViewParameters {
    pub(crate) fn new(camera: &Camera) -> Self {
        let axes = [camera.right(), camera.up(), camera.direction()].map(Axis::new);
        Self { size: camera.size().map(|n| n as u32), spacing: split(camera.pixel_spacing(), 12), axes }
    }

    /// The view of a geometry; of a curved geometry, only the size is used.
    pub(crate) fn of(geometry: &Geometry) -> Self {
        match geometry.camera() {
            Some(camera) => Self::new(camera),
            None => Self { size: geometry.size().map(|n| n as u32), ..Self::zeroed() },
        }
    }
}

/// A number split into a part of `digits` binary digits and the rest.
pub(crate) fn split(number: f64, digits: i32) -> [f32; 2] {
    split_at(number, power_above(number) * 2f64.powi(-digits))
}

/// A number split into a multiple of `unit` and the rest.
pub(crate) fn split_at(number: f64, unit: f64) -> [f32; 2] {
    let coarse = (number / unit).round() * unit;
    [coarse as f32, (number - coarse) as f32]
}

/// The smallest power of two above the number's absolute value.
pub(crate) fn power_above(number: f64) -> f64 {
    2f64.powi(number.abs().max(1e-30).log2().floor() as i32 + 1)
}

impl Device {
    /// A buffer for one number or vector of `bytes` per pixel.
    pub(crate) fn image(&self, label: &str, pixels: usize, bytes: usize) -> Buffer {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        self.buffer(label, (pixels * bytes) as u64, usage)
    }

    pub(crate) fn uniform<T: Pod>(&self, label: &str) -> Buffer {
        self.buffer(label, size_of::<T>() as u64, BufferUsages::UNIFORM | BufferUsages::COPY_DST)
    }

    pub(crate) fn upload<T: Pod>(&self, label: &str, items: &[T]) -> Buffer {
        let bytes: &[u8] = bytemuck::cast_slice(items);
        // Empty bindings are not allowed.
        let buffer =
            self.buffer(label, bytes.len().max(16) as u64, BufferUsages::STORAGE | BufferUsages::COPY_DST);
        self.write(&buffer, items);
        buffer
    }

    /// Writes `items` to the front of a buffer before the next stages run.
    pub(crate) fn write<T: Pod>(&self, buffer: &Buffer, items: &[T]) {
        self.queue.write_buffer(buffer, 0, bytemuck::cast_slice(items));
    }
}

/// The number of workgroups that cover a view, with `across` × `down` pixels each.
pub(crate) fn groups(size: [usize; 2], [across, down]: [usize; 2]) -> [u32; 2] {
    [size[0].div_ceil(across) as u32, size[1].div_ceil(down) as u32]
}
