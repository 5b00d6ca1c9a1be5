//! The far rim on the GPU.

use std::sync::OnceLock;

use lumencut_core::pipeline::Request;
use lumencut_core::stages::far_rim::FarRimParameters;
use wgpu::Buffer;

use crate::depth_filter::GROUP;
use crate::device::Device;
use crate::images::Images;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

#[derive(Debug)]
pub(crate) struct FarRim {
    /// Compiled when needed.
    stage: OnceLock<Stage>,
    parameters: Buffer,
}

impl FarRim {
    pub(crate) fn new(device: &Device) -> Self {
        let parameters = device.uniform::<FarRimParameters>("far rim parameters");
        Self { stage: OnceLock::new(), parameters }
    }

    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        (images, depth): (&Images, &Buffer),
        request: &Request,
    ) {
        let device = recording.device;
        device.write(&self.parameters, &[FarRimParameters::new(request.settings, request.camera)]);
        let stage = self.stage.get_or_init(|| Stage::new(device, "stages/far_rim", &[]));
        let buffers = [view, &self.parameters, &images.leap, depth, &images.focus];
        recording.run(stage, &buffers.map(Buffer::as_entire_binding), groups(images.size, GROUP));
    }
}
