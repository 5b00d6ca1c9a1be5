//! The view as shaders read it, and the images of its pixels.

use bytemuck::{Pod, Zeroable};
use lumencut_core::camera::Camera;
use wgpu::{Buffer, BufferUsages};

use crate::device::Device;

/// `View` of `math/view.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct View {
    /// Pixels along x and y.
    pub size: [u32; 2],
    /// The side of a pixel (mm): twelve digits, and the rest.
    pub spacing: [f32; 2],
}

impl View {
    /// The view of `camera`.
    pub fn new(camera: &Camera) -> Self {
        Self { size: camera.size().map(|n| n as u32), spacing: split(camera.pixel_spacing(), 12) }
    }
}

/// A number as one of `digits` binary digits and the rest.
pub(crate) fn split(number: f64, digits: i32) -> [f32; 2] {
    let unit = 2f64.powi(number.abs().max(1e-30).log2().floor() as i32 + 1 - digits);
    let coarse = (number / unit).round() * unit;
    [coarse as f32, (number - coarse) as f32]
}

impl Device {
    /// A buffer for one number or vector of `bytes` per pixel.
    pub(crate) fn image(&self, label: &str, pixels: usize, bytes: usize) -> Buffer {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        self.buffer(label, (pixels * bytes) as u64, usage)
    }

    /// A buffer for a `T` that every thread reads.
    pub(crate) fn uniform<T: Pod>(&self, label: &str) -> Buffer {
        self.buffer(label, size_of::<T>() as u64, BufferUsages::UNIFORM | BufferUsages::COPY_DST)
    }

    /// A buffer of `items` that stays.
    pub(crate) fn upload<T: Pod>(&self, label: &str, items: &[T]) -> Buffer {
        let bytes: &[u8] = bytemuck::cast_slice(items);
        // Bindings are never empty.
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

/// Groups of threads that cover the pixels of a view, `across` × `down` pixels each.
pub(crate) fn groups(size: [usize; 2], [across, down]: [usize; 2]) -> [u32; 2] {
    [size[0].div_ceil(across) as u32, size[1].div_ceil(down) as u32]
}
