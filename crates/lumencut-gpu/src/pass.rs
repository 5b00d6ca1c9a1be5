//! One view: the stages in the order of the paper's Fig. 4, recorded for the GPU or done by the CPU in its place.

use bytemuck::Pod;
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::frame::{Frame, Timing};
use lumencut_core::math::blocks::HUGE;
use lumencut_core::pipeline;
use lumencut_core::settings::Settings;
use lumencut_core::stages::Stop;
use lumencut_core::volume::Volume;
use wgpu::Buffer;

use crate::composite::Layers;
use crate::context::CutSurfaceImages;
use crate::device::Device;
use crate::images::Images;
use crate::levels::DeviceLevels;
use crate::recording::Recording;
use crate::silhouette;
use crate::stages::{OnCpu, Stages};
use crate::view::View;
use crate::volume::DeviceVolume;

/// A tree on the CPU and on the GPU.
pub(crate) struct Tree<'a> {
    #[cfg_attr(target_arch = "wasm32", allow(dead_code))]
    pub core: &'a mut pipeline::Renderer,
    pub levels: &'a DeviceLevels,
}

/// One view under way.
pub(crate) struct Pass<'a> {
    pub device: &'a Device,
    pub stages: &'a mut Stages,
    #[cfg_attr(target_arch = "wasm32", allow(dead_code))]
    pub on_cpu: &'a OnCpu,
    pub tree: Option<Tree<'a>>,
    pub volume: Option<&'a DeviceVolume>,
    pub images: &'a Images,
    pub camera: &'a Camera,
    pub settings: &'a Settings,
    pub stop: Stop<'a>,
    recording: Recording<'a>,
    timings: Vec<Timing>,
    /// What the frame is to have.
    has_surface: bool,
    has_value: bool,
    has_context: bool,
    has_image: bool,
}

impl<'a> Pass<'a> {
    /// Tells the shaders of the view.
    pub fn new(
        device: &'a Device,
        stages: &'a mut Stages,
        on_cpu: &'a OnCpu,
        (tree, volume, images): (Option<Tree<'a>>, Option<&'a DeviceVolume>, &'a Images),
        (camera, settings, stop): (&'a Camera, &'a Settings, Stop<'a>),
    ) -> Self {
        device.write(&stages.view, &[View::new(camera)]);
        Self {
            device,
            stages,
            on_cpu,
            tree,
            volume,
            images,
            camera,
            settings,
            stop,
            recording: Recording::new(device),
            timings: Vec::new(),
            has_surface: false,
            has_value: false,
            has_context: false,
            has_image: false,
        }
    }

    /// Levels, projection, distance, depth and its filter.
    pub async fn cut_surface(&mut self) -> Result<()> {
        self.has_surface = true;
        self.projection();
        self.distance().await?;
        self.depth().await?;
        if self.settings.depth_filter { self.depth_filter().await } else { Ok(()) }
    }

    fn projection(&mut self) {
        if let Some(Tree { levels, .. }) = &self.tree {
            let stages = &mut self.stages.cut_surface;
            stages.look(self.device, levels, self.camera, self.settings);
            stages.project(&mut self.recording, &self.stages.view, levels, self.settings.levels);
        }
    }

    async fn distance(&mut self) -> Result<()> {
        #[cfg(not(target_arch = "wasm32"))]
        if self.on_cpu.has("distance") {
            return self.distance_on_cpu().await;
        }
        if let Some(Tree { levels, .. }) = &self.tree {
            let (view, Images { size, distance, .. }) = (&self.stages.view, self.images);
            self.stages.cut_surface.distance(&mut self.recording, view, levels, *size, distance);
        }
        Ok(())
    }

    async fn depth(&mut self) -> Result<()> {
        #[cfg(not(target_arch = "wasm32"))]
        if self.on_cpu.has("depth") {
            return self.depth_on_cpu().await;
        }
        let result = self.raw_depth();
        if let Some(Tree { levels, .. }) = &self.tree {
            let (view, Images { size, distance, vessel, .. }) = (&self.stages.view, self.images);
            let (lumen_first, images) = (self.settings.lumen_first, [distance, result, vessel]);
            self.stages.cut_surface.depth(&mut self.recording, view, levels, lumen_first, images, *size);
        }
        Ok(())
    }

    /// Where the depth stage writes: into the depth itself where nothing filters it.
    pub fn raw_depth(&self) -> &'a Buffer {
        if self.settings.depth_filter { &self.images.unfiltered } else { &self.images.depth }
    }

    async fn depth_filter(&mut self) -> Result<()> {
        #[cfg(not(target_arch = "wasm32"))]
        if self.on_cpu.has("depth_filter") {
            return self.depth_filter_on_cpu().await;
        }
        let (view, Images { size, unfiltered, depth, .. }) = (&self.stages.view, self.images);
        self.stages.depth_filter.record(&mut self.recording, view, *size, unfiltered, depth);
        Ok(())
    }

    /// The volume at the cut surface.
    pub async fn surface(&mut self, volume: &Volume<'_>) -> Result<()> {
        self.has_value = true;
        #[cfg(not(target_arch = "wasm32"))]
        if self.on_cpu.has("surface") {
            return self.surface_on_cpu(volume).await;
        }
        let Some(on_device) = self.volume else { return Ok(()) };
        on_device.place(self.device, volume, self.camera);
        let (view, Images { size, depth, value, .. }) = (&self.stages.view, self.images);
        let volumes = (on_device, volume);
        self.stages.surface.record(
            &mut self.recording,
            (view, *size),
            volumes,
            self.settings.slab,
            depth,
            value,
        )
    }

    /// The strength of the silhouettes, where they are wanted.
    pub async fn silhouette(&mut self) -> Result<()> {
        if !self.settings.silhouettes {
            return Ok(());
        }
        #[cfg(not(target_arch = "wasm32"))]
        if self.on_cpu.has("silhouette") {
            return self.silhouette_on_cpu().await;
        }
        let Images { depth, vessel, raised, strength, .. } = self.images;
        let Stages { view, depth_filter, silhouette, .. } = &*self.stages;
        let images = silhouette::Images { depth, vessel, raised, strength };
        let slope = self.settings.silhouette_slope;
        silhouette.record(&mut self.recording, depth_filter, view, self.camera, slope, images);
        Ok(())
    }

    /// The context behind the cut surface, or all of it where there is none, where it is wanted.
    pub async fn context(&mut self, volume: &Volume<'_>) -> Result<()> {
        let Some(settings) = &self.settings.context else { return Ok(()) };
        self.has_context = true;
        #[cfg(not(target_arch = "wasm32"))]
        if self.on_cpu.has("context") {
            return self.context_on_cpu(volume, settings).await;
        }
        let Some((on_device, blocks)) = self.volume.and_then(|v| Some((v, v.blocks()?))) else {
            return Ok(());
        };
        on_device.place(self.device, volume, self.camera);
        let Images { size, depth, value, start, context, .. } = self.images;
        let cut_surface = self.has_value.then_some(CutSurfaceImages { value, depth });
        let Stages { view, context: stage, .. } = &mut *self.stages;
        let volumes = (on_device, blocks, volume);
        let settings = (self.settings, settings);
        let images = [start, context];
        stage.record(&mut self.recording, (view, *size), volumes, settings, cut_surface, images)
    }

    /// The picture of all layers, and the context's own.
    pub async fn composite(&mut self) -> Result<()> {
        self.has_image = true;
        #[cfg(not(target_arch = "wasm32"))]
        if self.on_cpu.has("composite") {
            return self.composite_on_cpu().await;
        }
        let Images { size, value, strength, context, layer, image, .. } = self.images;
        let Stages { view, composite, .. } = &*self.stages;
        let layers = Layers {
            value: self.has_value.then_some(value),
            strength: self.has_strength().then_some(strength),
            context: self.has_context.then_some(context),
        };
        if self.has_context {
            composite.record_layer(&mut self.recording, view, *size, context, layer);
        }
        composite.record(&mut self.recording, view, *size, layers, self.settings, image);
        Ok(())
    }

    /// Whether there are silhouettes.
    pub fn has_strength(&self) -> bool {
        self.has_value && self.settings.silhouettes
    }

    /// Whether there is a cut surface with values.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn has_value(&self) -> bool {
        self.has_value
    }

    /// Whether there is a context.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn has_context(&self) -> bool {
        self.has_context
    }

    /// Runs what is recorded, and reads the images of the frame.
    pub async fn frame(mut self) -> Result<Frame> {
        let Images { distance, depth, vessel, value, layer, image, .. } = self.images;
        let (surface, bytes) = (self.has_surface, 4 * self.images.pixels() as u64);
        let wanted = [
            (distance, surface),
            (depth, surface),
            (vessel, surface),
            (value, self.has_value),
            (layer, self.has_context),
            (image, self.has_image),
        ];
        for (image, _) in wanted.iter().filter(|(_, wanted)| *wanted) {
            self.recording.read(image, bytes);
        }
        let results = self.recording.finish(self.stop).await?;
        self.timings.extend(results.timings);
        let mut read = results.bytes.into_iter();
        let [distance, depth, vessel, value, layer, image] =
            wanted.map(|(_, wanted)| if wanted { read.next().unwrap_or_default() } else { Vec::new() });
        Ok(Frame {
            camera: *self.camera,
            image: numbers(&image),
            depth: numbers(&depth),
            vessel: numbers(&vessel),
            distance: numbers(&distance),
            value: with_holes(numbers(&value)),
            context: numbers(&layer),
            timings: self.timings,
        })
    }

    /// Runs what is recorded so far, and reads an image of `T` per pixel.
    #[cfg(not(target_arch = "wasm32"))]
    pub async fn read<T: Pod>(&mut self, image: &Buffer) -> Result<Vec<T>> {
        let mut recording = std::mem::replace(&mut self.recording, Recording::new(self.device));
        recording.read(image, (self.images.pixels() * size_of::<T>()) as u64);
        let results = recording.finish(self.stop).await?;
        self.timings.extend(results.timings);
        Ok(results.bytes.first().map_or_else(Vec::new, |bytes| numbers(bytes)))
    }

    /// Counts the time of a stage that the CPU did.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn count(&mut self, stage: &'static str, start: web_time::Instant) {
        let milliseconds = start.elapsed().as_secs_f64() * 1e3;
        self.timings.push(Timing { stage, milliseconds });
    }
}

/// The numbers in some bytes.
fn numbers<T: Pod>(bytes: &[u8]) -> Vec<T> {
    bytemuck::pod_collect_to_vec(bytes)
}

/// Values with NaN for HUGE, as the frame has them.
pub(crate) fn with_holes(mut values: Vec<f32>) -> Vec<f32> {
    for value in &mut values {
        *value = if *value >= HUGE { f32::NAN } else { *value };
    }
    values
}

/// Values with HUGE for NaN, as shaders have them.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn without_holes(mut values: Vec<f32>) -> Vec<f32> {
    for value in &mut values {
        *value = if value.is_nan() { HUGE } else { *value };
    }
    values
}
