//! Colours the rim around the vessels on the GPU.

use std::sync::OnceLock;

use lumencut_core::stages::rim::{RimParameters, RimStrip};
use wgpu::Buffer;

use crate::depth_filter::GROUP;
use crate::device::Device;
use crate::images::Images;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

#[derive(Debug)]
pub(crate) struct Rim {
    /// Compiled when needed.
    stage: OnceLock<Stage>,
    parameters: Buffer,
}

impl Rim {
    pub(crate) fn new(device: &Device) -> Self {
        Self { stage: OnceLock::new(), parameters: device.uniform::<RimParameters>("rim parameters") }
    }

    pub(crate) fn write(&self, device: &Device, parameters: &RimParameters) {
        device.write(&self.parameters, &[*parameters]);
    }

    /// Records the stage for the strips and colours of the vessels.
    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        (strips, colors): (&[RimStrip], &[[u8; 4]]),
        images: &Images,
    ) {
        let device = recording.device;
        let stage = self.stage.get_or_init(|| Stage::new(device, "stages/rim", &[]));
        let (strips, colors) = (device.upload("rim strips", strips), device.upload("rim colours", colors));
        let Images { gathered: foot, vessel, rim, size, .. } = images;
        let buffers = [view, &self.parameters, foot, vessel, &strips, &colors, rim];
        recording.run(stage, &buffers.map(Buffer::as_entire_binding), groups(*size, GROUP));
    }
}
