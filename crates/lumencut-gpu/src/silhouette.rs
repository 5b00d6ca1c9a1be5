//! Silhouettes on the GPU.

use bytemuck::{Pod, Zeroable};
use lumencut_core::camera::Camera;
use wgpu::Buffer;

use crate::depth_filter::{DepthFilter, GROUP};
use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

/// `Slope` of `stages/silhouette.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Slope {
    /// From the sum of the Sobel weights to mm per mm.
    pub per_slope: f32,
    /// The square of the slope that has half the strength.
    pub half: f32,
}

/// The slope of the depth, filtered, as the strength of a line.
#[derive(Debug)]
pub(crate) struct Silhouette {
    raise: Stage,
    strength: Stage,
    slope: Buffer,
}

/// The images of silhouettes, four bytes per pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Images<'a> {
    /// Depth of the cut surface (mm).
    pub depth: &'a Buffer,
    /// The vessel of each pixel.
    pub vessel: &'a Buffer,
    /// Written on the way.
    pub raised: &'a Buffer,
    /// The result.
    pub strength: &'a Buffer,
}

impl Silhouette {
    pub fn new(device: &Device) -> Self {
        const ROOM: &str = "stages/silhouette";
        Self {
            raise: Stage::new(device, ROOM, &[]),
            strength: Stage::entry(device, ROOM, "strength", &[]),
            slope: device.uniform::<Slope>("slope"),
        }
    }

    /// Writes the strength of the silhouettes, as half of which `half_slope` counts.
    pub fn record(
        &self,
        recording: &mut Recording,
        filter: &DepthFilter,
        view: &Buffer,
        camera: &Camera,
        half_slope: f64,
        images: Images,
    ) {
        let per_slope = (1.0 / (8.0 * camera.pixel_spacing())) as f32;
        recording.device.write(&self.slope, &[Slope { per_slope, half: (half_slope * half_slope) as f32 }]);
        let across = groups(camera.size(), GROUP);
        let Images { depth, vessel, raised, strength } = images;
        let buffers = [view, &self.slope, raised, depth, vessel].map(Buffer::as_entire_binding);
        recording.run(&self.raise, &buffers, across);
        filter.record_as(self.raise.name, recording, view, camera.size(), [raised, strength]);
        let buffers = [view, &self.slope, strength].map(Buffer::as_entire_binding);
        recording.run(&self.strength, &buffers, across);
    }
}
