//! The depth filter on the GPU.

use lumencut_core::stages::depth_filter::DepthFilterParameters;
use wgpu::Buffer;

use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

/// A 7×7 Gaussian.
#[derive(Debug)]
pub(crate) struct DepthFilter {
    stage: Stage,
    parameters: Buffer,
}

impl DepthFilter {
    pub fn new(device: &Device) -> Self {
        let parameters = device.uniform::<DepthFilterParameters>("depth_filter parameters");
        device.write(&parameters, &[DepthFilterParameters::new()]);
        Self { stage: Stage::new(device, "stages/depth_filter", &[]), parameters }
    }

    /// Writes the smoothed image.
    pub fn record(&self, recording: &mut Recording, view: &Buffer, size: [usize; 2], from_to: [&Buffer; 2]) {
        self.record_as(self.stage.name, recording, view, size, from_to);
    }

    /// The same as a part of the stage `name`, whose time it counts to.
    pub fn record_as(
        &self,
        name: &'static str,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        [image, smoothed]: [&Buffer; 2],
    ) {
        let buffers = [view, &self.parameters, image, smoothed].map(Buffer::as_entire_binding);
        recording.run_as(name, &self.stage, &buffers, groups(size, GROUP));
    }
}

/// The threads of a group, one pixel each, as the shaders of images have them.
pub(crate) const GROUP: [usize; 2] = [16, 4];
