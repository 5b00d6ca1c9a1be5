//! The method from end to end on the GPU.

use std::sync::Arc;

use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::frame::Frame;
use lumencut_core::pipeline;
use lumencut_core::settings::Settings;
use lumencut_core::stages::Stop;
use lumencut_core::vessel_tree::VesselTree;
use wgpu::Buffer;

use crate::cut_surface::CutSurfaceStages;
use crate::device::Device;
use crate::images::Images;
use crate::levels::DeviceLevels;
use crate::recording::Recording;
use crate::view::View;

/// Renders.
pub struct Renderer {
    device: Arc<Device>,
    core: pipeline::Renderer,
    stages: CutSurfaceStages,
    levels: Option<DeviceLevels>,
    images: Option<Images>,
    view: Buffer,
}

impl Renderer {
    /// New.
    pub fn new(device: Arc<Device>, tree: VesselTree) -> Self {
        Self {
            core: pipeline::Renderer::new(tree),
            stages: CutSurfaceStages::new(&device),
            levels: None,
            images: None,
            view: device.uniform::<View>("view"),
            device,
        }
    }

    /// Cut.
    pub async fn cut_surface(
        &mut self,
        camera: &Camera,
        settings: &Settings,
        stop: Stop<'_>,
    ) -> Result<Frame> {
        settings.check()?;
        let device = &self.device;
        if self.levels.as_ref().is_none_or(|levels| levels.coarsest < settings.levels) {
            self.levels = Some(DeviceLevels::new(device, self.core.levels(settings.levels))?);
        }
        let levels = self.levels.as_ref().unwrap();
        if self.images.as_ref().is_none_or(|images| images.size != camera.size()) {
            self.images = Some(Images::new(device, camera.size()));
        }
        let images = self.images.as_ref().unwrap();
        device.write(&self.view, &[View::new(camera)]);
        self.stages.look(device, levels, camera, settings);
        let mut recording = Recording::new(device);
        self.stages.project(&mut recording, &self.view, levels, settings.levels);
        self.stages.distance(&mut recording, &self.view, levels, images.size, &images.distance);
        self.stages.depth(
            &mut recording,
            &self.view,
            levels,
            settings.lumen_first,
            [&images.distance, &images.unfiltered, &images.vessel],
            images.size,
        );
        let bytes = 4 * images.pixels() as u64;
        for image in [&images.distance, &images.unfiltered, &images.vessel] {
            recording.read(image, bytes);
        }
        let results = recording.finish(stop).await?;
        let mut frame = Frame {
            camera: *camera,
            image: Vec::new(),
            depth: Vec::new(),
            vessel: Vec::new(),
            distance: Vec::new(),
            value: Vec::new(),
            context: Vec::new(),
            timings: results.timings,
        };
        frame.distance = bytemuck::pod_collect_to_vec(&results.bytes[0]);
        frame.depth = bytemuck::pod_collect_to_vec(&results.bytes[1]);
        frame.vessel = bytemuck::pod_collect_to_vec(&results.bytes[2]);
        Ok(frame)
    }
}
