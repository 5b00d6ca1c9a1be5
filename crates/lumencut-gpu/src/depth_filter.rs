//! The depth filter on the GPU.

use std::sync::OnceLock;

use lumencut_core::settings::Settings;
use lumencut_core::stages::depth_filter::DepthFilterParameters;
use wgpu::Buffer;

use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

#[derive(Debug)]
pub(crate) struct DepthFilter {
    stage: Stage,
    /// The filters along columns and along rows; compiled when needed.
    within_zones: OnceLock<[Stage; 2]>,
    parameters: Buffer,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct ZoneImages<'a> {
    pub image: &'a Buffer,
    pub vessel: &'a Buffer,
    /// The depth after the filter along columns.
    pub columns: &'a Buffer,
    pub smoothed: &'a Buffer,
}

const ROOM: &str = "stages/depth_filter";

impl DepthFilter {
    pub(crate) fn new(device: &Device) -> Self {
        let parameters = device.uniform::<DepthFilterParameters>("depth_filter parameters");
        device.write(&parameters, &[DepthFilterParameters::new()]);
        Self { stage: Stage::new(device, ROOM, &[]), within_zones: OnceLock::new(), parameters }
    }

    pub(crate) fn write(&self, device: &Device, settings: &Settings) {
        device.write(&self.parameters, &[DepthFilterParameters::of(settings)]);
    }

    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        from_to: [&Buffer; 2],
    ) {
        self.record_as(self.stage.name, recording, view, size, from_to);
    }

    /// Records the filter as a part of the stage `name`; its time is added to that stage.
    pub(crate) fn record_as(
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

    /// Filters columns first, then rows.
    pub(crate) fn record_within_zones(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        images: ZoneImages,
    ) {
        let device = recording.device;
        let [down, across] = self.within_zones.get_or_init(|| {
            [1.0, 0.0].map(|is_down| Stage::entry(device, ROOM, "within_zones", &[("DOWN", is_down)]))
        });
        let ZoneImages { image, vessel, columns, smoothed } = images;
        for (stage, from, to) in [(down, image, columns), (across, columns, smoothed)] {
            let buffers = [view, &self.parameters, from, to, vessel].map(Buffer::as_entire_binding);
            recording.run(stage, &buffers, groups(size, GROUP));
        }
    }
}

/// The size of a workgroup with one pixel per thread, as in the shaders of images.
pub(crate) const GROUP: [usize; 2] = [16, 4];
