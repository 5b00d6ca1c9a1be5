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

#[derive(Debug)]
pub(crate) struct Silhouette {
    raise: Stage,
    strength: Stage,
    lines: Stage,
    parameters: Buffer,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct SilhouetteImages<'a> {
    pub size: [usize; 2],
    pub depth: &'a Buffer,
    pub vessel: &'a Buffer,
    /// The slopes of the depth, raised at borders of zones.
    pub raised: &'a Buffer,
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

    pub(crate) fn write(&self, device: &Device, settings: &Settings, camera: &Camera) {
        device.write(&self.parameters, &[SilhouetteParameters::new(settings, camera)]);
    }

    pub(crate) fn record_leaps(&self, recording: &mut Recording, view: &Buffer, images: &Images) {
        let Images { size, leap, strength, value, .. } = images;
        let buffers = [view, leap, strength, &self.parameters, value].map(Buffer::as_entire_binding);
        recording.run(&self.lines, &buffers, groups(*size, GROUP));
    }

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
