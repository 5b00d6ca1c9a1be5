//! Holds the depth near that of the view before, on the GPU.

use std::sync::OnceLock;

use lumencut_core::pipeline::Request;
use lumencut_core::stages::steady::SteadyParameters;
use wgpu::Buffer;

use crate::depth_filter::GROUP;
use crate::device::Device;
use crate::images::Images;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

#[derive(Debug)]
pub(crate) struct Steady {
    /// Compiled when needed.
    stage: OnceLock<Stage>,
    parameters: Buffer,
}

impl Steady {
    pub(crate) fn new(device: &Device) -> Self {
        let parameters = device.uniform::<SteadyParameters>("steady parameters");
        Self { stage: OnceLock::new(), parameters }
    }

    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        (images, depth): (&Images, &Buffer),
        request: &Request,
    ) {
        let Request { settings, camera, before, .. } = request;
        let parameters = before.and_then(|before| SteadyParameters::new(settings, camera, &before));
        let Some(parameters) = parameters else { return };
        let device = recording.device;
        device.write(&self.parameters, &[parameters]);
        let stage = self.stage.get_or_init(|| Stage::new(device, "stages/steady", &[]));
        let buffers = [view, &self.parameters, &images.gathered, &images.before, depth];
        recording.run(stage, &buffers.map(Buffer::as_entire_binding), groups(images.size, GROUP));
    }
}
