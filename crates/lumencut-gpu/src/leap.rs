//! Marks depth jumps (leaps) on the GPU.

use lumencut_core::camera::Camera;
use lumencut_core::stages::leap::LeapParameters;
use wgpu::Buffer;

use crate::depth_filter::GROUP;
use crate::device::Device;
use crate::images::Images;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

#[derive(Debug)]
pub(crate) struct Leap {
    stage: Stage,
    parameters: Buffer,
}

impl Leap {
    pub(crate) fn new(device: &Device) -> Self {
        let parameters = device.uniform::<LeapParameters>("leap parameters");
        Self { stage: Stage::new(device, "stages/leap", &[]), parameters }
    }

    pub(crate) fn write(&self, device: &Device, camera: &Camera) {
        device.write(&self.parameters, &[LeapParameters::new(camera)]);
    }

    /// Records the stage that marks the jumps of an unfiltered depth.
    pub(crate) fn record(&self, recording: &mut Recording, view: &Buffer, images: &Images, depth: &Buffer) {
        let buffers = [view, &self.parameters, depth, &images.sheet, &images.leap, &images.vessel];
        let buffers = buffers.map(Buffer::as_entire_binding);
        recording.run(&self.stage, &buffers, groups(images.size, GROUP));
    }
}
