//! Renders views on a GPU; data that do not depend on the view stay there.

use std::sync::Arc;

use lumencut_core::error::Result;
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::math::projection::Level;
use lumencut_core::pipeline::{Request, nothing_to_show};
use lumencut_core::scene::{Scene, SharedVolume, WeakVolumeKey};
use lumencut_core::stages::ImageSet;
use lumencut_core::stop::Stop;

use crate::device::Device;
use crate::images::Images;
use crate::levels::DeviceLevels;
#[cfg(not(target_arch = "wasm32"))]
use crate::on_cpu::OnCpu;
use crate::pass::Pass;
use crate::recording::Recording;
#[cfg(target_arch = "wasm32")]
use crate::screen::Screen;
use crate::stages::Stages;
use crate::view::ViewParameters;
use crate::volume::DeviceVolume;

/// Renders views of scenes as [`lumencut_core::pipeline::CpuRenderer`] does on the CPU. The last volume and
/// the last tree stay on the GPU, also during views that do not show them.
#[derive(Debug)]
pub struct GpuRenderer {
    device: Arc<Device>,
    stages: Stages,
    #[cfg(not(target_arch = "wasm32"))]
    on_cpu: OnCpu,
    tree: Option<DeviceTree>,
    volume: Option<ShownVolume>,
    /// The volume that the context shows, if it is another one.
    around: Option<ShownVolume>,
    images: Option<Images>,
}

#[derive(Debug)]
struct DeviceTree {
    levels: Arc<Vec<Level>>,
    on_device: DeviceLevels,
}

#[derive(Debug)]
struct ShownVolume {
    key: WeakVolumeKey,
    on_device: DeviceVolume,
}

impl ShownVolume {
    fn replace(kept: &mut Option<Self>, device: &Device, shared: &SharedVolume, stop: Stop) -> Result<()> {
        if kept.as_ref().is_none_or(|kept| !kept.key.is(&shared.key)) {
            // The old volume is freed first, as there may not be enough memory for two.
            *kept = None;
            let on_device = DeviceVolume::new(device, &shared.volume, stop)?;
            *kept = Some(Self { key: shared.key.downgrade(), on_device });
        }
        Ok(())
    }
}

impl GpuRenderer {
    /// A renderer on this GPU.
    pub fn new(device: Arc<Device>) -> Self {
        Self {
            stages: Stages::new(&device),
            device,
            #[cfg(not(target_arch = "wasm32"))]
            on_cpu: OnCpu::default(),
            tree: None,
            volume: None,
            around: None,
            images: None,
        }
    }

    /// The GPU that renders.
    pub fn device(&self) -> &Device {
        &self.device
    }

    #[cfg(test)]
    pub(crate) fn voxels(&self) -> Option<wgpu::TextureView> {
        self.volume.as_ref().map(|volume| volume.on_device.voxels.clone())
    }

    /// From now on, computes these stages on the CPU, from the GPU's results of earlier stages. Fails with
    /// [`lumencut_core::error::ErrorKind::Settings`] for a name that is not in `crate::stages::on_either`.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn force_to_cpu(&mut self, names: &[String]) -> Result<()> {
        self.on_cpu = OnCpu::named(names)?;
        Ok(())
    }

    /// Renders one view of a scene, as [`lumencut_core::pipeline::CpuRenderer::render`] does. Fails in the
    /// same cases, and with [`lumencut_core::error::ErrorKind::Device`] if the GPU lacks memory or fails.
    pub async fn render(&mut self, scene: &Scene<'_>, request: &Request<'_>) -> Result<Frame> {
        let settings = request.settings_for(scene)?;
        let request = &Request { settings: &settings, ..*request }.continued();
        if scene.volume.is_none() && scene.tree.is_none() {
            return Err(nothing_to_show());
        }
        let request = &request.without_unseen_picture(scene);
        self.recorded(scene, request).await?.frame().await
    }

    /// Draws the picture on a canvas without reading it back; returns once the GPU has drawn it. Fails as
    /// [`GpuRenderer::render`].
    #[cfg(target_arch = "wasm32")]
    pub async fn draw(
        &mut self,
        scene: &Scene<'_>,
        request: &Request<'_>,
        screen: &mut Screen,
    ) -> Result<()> {
        let settings = request.settings_for(scene)?;
        let request = &Request { settings: &settings, ..*request }.continued();
        if scene.volume.is_none() {
            return Err(nothing_to_show());
        }
        screen.fit(&self.device, request.camera.size())?;
        self.recorded(scene, request).await?.draw(screen).await
    }

    /// Draws a picture that was made elsewhere on a canvas. Fails as [`GpuRenderer::draw`].
    #[cfg(target_arch = "wasm32")]
    pub async fn show(&self, picture: &[[u8; 4]], size: [usize; 2], screen: &mut Screen) -> Result<()> {
        screen.fit(&self.device, size)?;
        let sent = self.device.upload("picture", picture);
        screen.record(&self.device, Recording::new(&self.device), &sent)?.await
    }

    async fn recorded<'a>(&'a mut self, scene: &'a Scene<'a>, request: &'a Request<'a>) -> Result<Pass<'a>> {
        let mut pass = self.pass(scene, Geometry::rays(*request.camera), request)?;
        if scene.tree.is_some() {
            pass.cut_surface().await?;
        }
        if scene.volume.is_some() {
            pass.look().await?;
        }
        Ok(pass)
    }

    /// Shows the volume at the positions of a frame, as [`lumencut_core::pipeline::CpuRenderer::look`] does.
    /// Fails as [`GpuRenderer::render`].
    pub async fn look(
        &mut self,
        volume: &SharedVolume<'_>,
        frame: Frame,
        request: &Request<'_>,
    ) -> Result<Frame> {
        request.settings.check()?;
        let scene = Scene { volume: Some(volume.clone()), ..Scene::default() };
        let Frame { geometry, vessel, leap, focus, distance, folded, timings, .. } = frame;
        let mut pass = self.pass(&scene, geometry, request)?;
        pass.send_surface(&vessel, &leap, &focus);
        pass.look().await?;
        let mut shown = pass.frame().await?;
        shown.timings.splice(..0, timings);
        Ok(Frame { vessel, distance, folded, ..shown }.keeping(request.images))
    }

    /// Starts a view whose input is on the GPU.
    fn pass<'a>(
        &'a mut self,
        scene: &'a Scene<'a>,
        geometry: Geometry,
        request: &'a Request<'a>,
    ) -> Result<Pass<'a>> {
        self.prepare(scene, request)?;
        let size = geometry.size();
        let images = match self.images.take() {
            Some(images) if images.size == size => images,
            _ => Images::new(&self.device, size)?,
        };
        let levels = self.tree.as_ref().map(|tree| &tree.on_device);
        let volume = self.volume.as_ref().map(|volume| &volume.on_device);
        let around = self.around.as_ref().map_or(volume, |around| Some(&around.on_device));
        self.device.write(&self.stages.view, &[ViewParameters::of(&geometry)]);
        Ok(Pass {
            device: &self.device,
            stages: &mut self.stages,
            #[cfg(not(target_arch = "wasm32"))]
            on_cpu: &mut self.on_cpu,
            images: self.images.insert(images),
            scene,
            levels: levels.filter(|_| scene.tree.is_some()),
            volume: volume.filter(|_| scene.volume.is_some()),
            around: around.filter(|_| scene.volume.is_some()),
            geometry,
            request,
            recording: Recording::new(&self.device),
            timings: Vec::new(),
            made: ImageSet::of(&[]),
        })
    }

    fn prepare(&mut self, scene: &Scene, request: &Request) -> Result<()> {
        if let Some(shared) = &scene.volume {
            ShownVolume::replace(&mut self.volume, &self.device, shared, request.stop)?;
        }
        match &scene.context {
            Some(shared) => ShownVolume::replace(&mut self.around, &self.device, shared, request.stop)?,
            None => self.around = None,
        }
        if let Some(tree) = &scene.tree {
            let settings = request.settings;
            let levels = tree.levels(settings.levels, settings.centerline_smoothing);
            if self.tree.as_ref().is_none_or(|kept| !Arc::ptr_eq(&kept.levels, &levels)) {
                self.tree = None;
                let on_device = DeviceLevels::new(&self.device, &levels)?;
                self.tree = Some(DeviceTree { levels, on_device });
            }
            if let Some(tree) = &mut self.tree {
                tree.on_device.put_first(&self.device, &tree.levels, &settings.focus_vessels);
            }
        }
        Ok(())
    }
}
