//! Renders views on a GPU: what does not depend on the view stays there from view to view.

use std::sync::Arc;

use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::frame::Frame;
use lumencut_core::pipeline;
use lumencut_core::settings::Settings;
use lumencut_core::stages::Stop;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::Volume;

use crate::device::Device;
use crate::images::Images;
use crate::levels::DeviceLevels;
use crate::pass::{Pass, Tree};
use crate::stages::OnCpu;
#[cfg(not(target_arch = "wasm32"))]
use crate::stages::STAGES;
use crate::stages::Stages;
use crate::volume::DeviceVolume;

/// Renders views of one volume and one vessel tree, or of a volume alone, as [`pipeline::Renderer`] does on the CPU.
/// The volume goes to the GPU with its first view: every view is of the same volume.
#[derive(Debug)]
pub struct Renderer {
    device: Arc<Device>,
    stages: Stages,
    on_cpu: OnCpu,
    tree: Option<pipeline::Renderer>,
    levels: Option<DeviceLevels>,
    volume: Option<DeviceVolume>,
    images: Option<Images>,
}

impl Renderer {
    /// A renderer of `tree`, or of a volume alone.
    pub fn new(device: Arc<Device>, tree: Option<VesselTree>) -> Self {
        Self {
            stages: Stages::new(&device),
            device,
            on_cpu: OnCpu::default(),
            tree: tree.map(pipeline::Renderer::new),
            levels: None,
            volume: None,
            images: None,
        }
    }

    /// The GPU.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Lets the CPU do some of [`STAGES`] from now on, each with what the GPU made before it.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for a name that is none of them.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn force_to_cpu(&mut self, stages: Vec<String>) -> Result<()> {
        if let Some(unknown) = stages.iter().find(|name| !STAGES.contains(&name.as_str())) {
            let expected = format!("names of {}", STAGES.join(", "));
            return Err(Error::new(
                ErrorKind::Settings,
                "stages of the CPU",
                format!("'{unknown}'"),
                expected,
            ));
        }
        self.on_cpu = OnCpu(stages);
        Ok(())
    }

    /// The whole picture: cut surface, volume at the surface, silhouettes, context, window; without a tree the context
    /// alone.
    ///
    /// # Errors
    /// As [`pipeline::Renderer::render`], and [`ErrorKind::Device`] where the GPU has no room or fails.
    pub async fn render(
        &mut self,
        volume: &Volume<'_>,
        camera: &Camera,
        settings: &Settings,
        stop: Stop<'_>,
    ) -> Result<Frame> {
        settings.check()?;
        self.prepare_volume(volume, settings, stop)?;
        let is_tree = self.tree.is_some();
        let mut pass = self.pass(camera, settings, stop)?;
        if is_tree {
            pass.cut_surface().await?;
            pass.surface(volume).await?;
            pass.silhouette().await?;
        }
        pass.context(volume).await?;
        pass.composite().await?;
        pass.frame().await
    }

    /// The cut surface alone: depth, vessel and distance; `value` and `image` stay empty.
    ///
    /// # Errors
    /// As [`Renderer::render`], and [`ErrorKind::VesselTree`] without a tree.
    pub async fn cut_surface(
        &mut self,
        camera: &Camera,
        settings: &Settings,
        stop: Stop<'_>,
    ) -> Result<Frame> {
        settings.check()?;
        if self.tree.is_none() {
            return Err(Error::new(
                ErrorKind::VesselTree,
                "tree of the renderer",
                "none",
                "a tree to cut along",
            ));
        }
        let mut pass = self.pass(camera, settings, stop)?;
        pass.cut_surface().await?;
        pass.frame().await
    }

    /// Sends the volume, and its blocks where they are needed, unless that has been done.
    fn prepare_volume(&mut self, volume: &Volume, settings: &Settings, stop: Stop) -> Result<()> {
        if self.volume.is_none() {
            self.volume = Some(DeviceVolume::new(&self.device, volume, stop)?);
        }
        match (&mut self.volume, &settings.context) {
            (Some(on_device), Some(_)) => on_device.prepare_blocks(&self.device, volume, stop),
            _ => Ok(()),
        }
    }

    /// The start of a view.
    fn pass<'a>(
        &'a mut self,
        camera: &'a Camera,
        settings: &'a Settings,
        stop: Stop<'a>,
    ) -> Result<Pass<'a>> {
        let device = &self.device;
        let tree = match &mut self.tree {
            None => None,
            Some(core) => {
                if self.levels.as_ref().is_none_or(|levels| levels.coarsest < settings.levels) {
                    self.levels = Some(DeviceLevels::new(device, core.levels(settings.levels))?);
                }
                self.levels.as_ref().map(|levels| Tree { core, levels })
            }
        };
        let images = match self.images.take() {
            Some(images) if images.size == camera.size() => images,
            _ => Images::new(device, camera.size())?,
        };
        let images = self.images.insert(images);
        let volume = self.volume.as_ref();
        Ok(Pass::new(
            device,
            &mut self.stages,
            &self.on_cpu,
            (tree, volume, images),
            (camera, settings, stop),
        ))
    }
}
