//! Silhouettes on the GPU.

use lumencut_core::camera::Camera;
use lumencut_core::settings::Settings;
use lumencut_core::stages::silhouette::SilhouetteParameters;
use wgpu::Buffer;

use crate::depth_filter::{DepthFilter, GROUP};
use crate::device::Device;
use crate::images::Images;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

/// The lines of leaps; or the slope of the depth, filtered, as the strength of a line.
#[derive(Debug)]
pub(crate) struct Silhouette {
    raise: Stage,
    strength: Stage,
    lines: Stage,
    parameters: Buffer,
}

/// The images of silhouettes, four bytes per pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SilhouetteImages<'a> {
    /// Width and height.
    pub size: [usize; 2],
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
    pub(crate) fn new(device: &Device) -> Self {
        const ROOM: &str = "stages/silhouette";
        Self {
            raise: Stage::new(device, ROOM, &[]),
            strength: Stage::entry(device, ROOM, "strength", &[]),
            lines: Stage::entry(device, ROOM, "lines", &[]),
            parameters: device.uniform::<SilhouetteParameters>("silhouette parameters"),
        }
    }

    /// Tells the shaders of a view.
    pub(crate) fn write(&self, device: &Device, settings: &Settings, camera: &Camera) {
        device.write(&self.parameters, &[SilhouetteParameters::new(settings, camera)]);
    }

    /// Writes how much of each pixel the lines of the leaps cover.
    pub(crate) fn record_leaps(&self, recording: &mut Recording, view: &Buffer, images: &Images) {
        let Images { size, leap, strength, value, .. } = images;
        let buffers = [view, leap, strength, &self.parameters, value].map(Buffer::as_entire_binding);
        recording.run(&self.lines, &buffers, groups(*size, GROUP));
    }

    /// Writes the strength of the silhouettes of a steep depth.
    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        filter: &DepthFilter,
        view: &Buffer,
        images: SilhouetteImages,
    ) {
        let SilhouetteImages { size, depth, vessel, raised, strength } = images;
        let across = groups(size, GROUP);
        let buffers = [view, &self.parameters, raised, depth, vessel].map(Buffer::as_entire_binding);
        recording.run(&self.raise, &buffers, across);
        filter.record_as(self.raise.name, recording, view, size, [raised, strength]);
        let buffers = [view, &self.parameters, strength].map(Buffer::as_entire_binding);
        recording.run(&self.strength, &buffers, across);
    }
}
