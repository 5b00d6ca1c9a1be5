//! The depth filter on the GPU.

use bytemuck::{Pod, Zeroable};
use lumencut_core::stages::depth_filter::weights;
use wgpu::Buffer;

use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

/// `Gaussian` of `stages/depth_filter.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Gaussian {
    /// From the middle outwards.
    pub weights: [f32; 4],
}

/// A 7×7 Gaussian.
#[derive(Debug)]
pub(crate) struct DepthFilter {
    stage: Stage,
    gaussian: Buffer,
}

impl DepthFilter {
    pub fn new(device: &Device) -> Self {
        let gaussian = device.uniform::<Gaussian>("gaussian");
        device.write(&gaussian, &[Gaussian { weights: weights() }]);
        Self { stage: Stage::new(device, "stages/depth_filter", &[]), gaussian }
    }

    /// Writes the smoothed `image`.
    pub fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        image: &Buffer,
        smoothed: &Buffer,
    ) {
        self.record_as(self.stage.name, recording, view, size, [image, smoothed]);
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
        let buffers = [view, &self.gaussian, image, smoothed].map(Buffer::as_entire_binding);
        recording.run_as(name, &self.stage, &buffers, groups(size, GROUP));
    }
}

/// The threads of a group, one pixel each, as the shaders of images have them.
pub(crate) const GROUP: [usize; 2] = [16, 4];
