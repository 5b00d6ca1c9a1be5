//! The outline of the body on the GPU. The CPU finds its nodes.

use std::sync::OnceLock;

use lumencut_core::stages::body::{BodyParameters, Outline};
use wgpu::Buffer;

use crate::depth_filter::GROUP;
use crate::device::Device;
use crate::images::Images;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

#[derive(Debug)]
pub(crate) struct BodyStage {
    /// Compiled when needed.
    stage: OnceLock<Stage>,
    parameters: Buffer,
}

impl BodyStage {
    pub(crate) fn new(device: &Device) -> Self {
        Self {
            stage: OnceLock::new(),
            parameters: device.image("body parameters", 1, size_of::<BodyParameters>()),
        }
    }

    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        images: &Images,
        outline: &Outline,
    ) {
        let device = recording.device;
        device.write(&self.parameters, &[outline.parameters]);
        let nodes = device.upload("nodes of the body", &outline.nodes);
        let stage = self.stage.get_or_init(|| Stage::new(device, "stages/body", &[]));
        let buffers = [view, &self.parameters, &nodes, &images.start, &images.gathered];
        recording.run(stage, &buffers.map(Buffer::as_entire_binding), groups(images.size, GROUP));
    }
}
