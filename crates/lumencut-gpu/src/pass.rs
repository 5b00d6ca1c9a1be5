//! One view: the stages in the order of the paper's Fig. 4, recorded for the GPU or computed by the CPU.

use lumencut_core::error::Result;
use lumencut_core::frame::{Frame, Timing};
use lumencut_core::geometry::Geometry;
use lumencut_core::math::blocks::HUGE;
use lumencut_core::pipeline::Request;
use lumencut_core::scene::Scene;
use lumencut_core::settings::SilhouetteRule;
use lumencut_core::stages::body::Outline;
use lumencut_core::stages::focus::{FocusParameters, Shares};
use lumencut_core::stages::rim::RimParameters;
use lumencut_core::stages::{Image, ImageSet, Stage};
use wgpu::Buffer;

use crate::composite::Layers;
use crate::context::ContextImages;
use crate::cut_surface::DepthRules;
use crate::depth_filter::ZoneImages;
use crate::device::Device;
use crate::images::Images;
use crate::levels::DeviceLevels;
#[cfg(not(target_arch = "wasm32"))]
use crate::on_cpu::OnCpu;
use crate::recording::{Recording, Results};
#[cfg(target_arch = "wasm32")]
use crate::screen::Screen;
use crate::silhouette::SilhouetteImages;
use crate::stages::Stages;
use crate::surface::SurfaceImages;
use crate::volume::DeviceVolume;

pub(crate) struct Pass<'a> {
    pub device: &'a Device,
    pub stages: &'a mut Stages,
    #[cfg(not(target_arch = "wasm32"))]
    pub on_cpu: &'a mut OnCpu,
    pub images: &'a Images,
    /// The scene that is shown, and its data on the GPU.
    pub scene: &'a Scene<'a>,
    pub levels: Option<&'a DeviceLevels>,
    pub volume: Option<&'a DeviceVolume>,
    /// The volume that the context shows.
    pub around: Option<&'a DeviceVolume>,
    /// The positions of the pixels; if the GPU made the cut surface, its depth is among the images instead.
    pub geometry: Geometry,
    pub request: &'a Request<'a>,
    pub recording: Recording<'a>,
    pub timings: Vec<Timing>,
    /// The images made so far.
    pub made: ImageSet,
}

impl<'a> Pass<'a> {
    pub(crate) async fn cut_surface(&mut self) -> Result<()> {
        self.projection();
        if let Some(before) = self.request.before {
            self.device.write(self.buffer(Image::Before), &before.seen_by(self.request.camera));
            self.made = self.made.and(ImageSet::of(&[Image::Before]));
        }
        for stage in Stage::of_cut_surface(self.request.settings, self.request.images) {
            self.run(stage).await?;
        }
        self.made = self.made.and(ImageSet::of(&[Image::Depth]));
        Ok(())
    }

    pub(crate) async fn look(&mut self) -> Result<()> {
        let Request { settings, images, .. } = *self.request;
        for stage in Stage::of_look(settings, &self.geometry, self.made, images) {
            self.run(stage).await?;
        }
        Ok(())
    }

    /// Sends a cut surface that was made elsewhere: depth, vessels, leaps and focus, each with all pixels.
    pub(crate) fn send_surface(&mut self, vessel: &[i32], leap: &[u32], focus: &[Shares]) {
        let depth = self.geometry.depth();
        for (image, bytes) in [
            (Image::Depth, bytemuck::cast_slice::<_, u8>(depth)),
            (Image::Vessel, bytemuck::cast_slice(vessel)),
            (Image::Leap, bytemuck::cast_slice(leap)),
            (Image::Focus, bytemuck::cast_slice(focus)),
        ] {
            if !bytes.is_empty() {
                let expected = bytes_of(image) * self.images.pixels();
                assert_eq!(bytes.len(), expected, "bytes of the image {image:?}");
                self.device.write(self.buffer(image), bytes);
                self.made = self.made.and(ImageSet::of(&[image]));
            }
        }
    }

    async fn run(&mut self, stage: Stage) -> Result<()> {
        #[cfg(not(target_arch = "wasm32"))]
        if self.on_cpu.has(stage) {
            return self.run_on_cpu(stage).await;
        }
        self.record(stage)?;
        self.made = self.made.and(ImageSet::of(stage.writes()));
        Ok(())
    }

    fn record(&mut self, stage: Stage) -> Result<()> {
        match stage {
            Stage::Distance => self.distance(),
            Stage::Depth => self.depth(),
            Stage::Steady => self.steady(),
            Stage::Leap => self.leap(),
            Stage::DepthFilter => self.depth_filter(),
            Stage::Focus => self.focus(),
            Stage::Occlusion => self.occlusion(),
            Stage::FarRim => self.far_rim(),
            Stage::Rim => self.rim(),
            Stage::Surface => return self.surface(),
            Stage::Silhouette => self.silhouette(),
            Stage::Context => return self.context(),
            Stage::Body => return self.body(),
            Stage::Composite => self.composite(),
            // These stages run on the CPU, before the view, or as part of another stage.
            Stage::Levels | Stage::Projection | Stage::Blocks => {}
        }
        Ok(())
    }

    fn projection(&mut self) {
        let Some(levels) = self.levels else { return };
        let stages = &mut self.stages.cut_surface;
        stages.look(self.device, levels, self.request);
        stages.project(&mut self.recording, &self.stages.view, levels, self.request.settings.levels);
    }

    fn distance(&mut self) {
        let Some(levels) = self.levels else { return };
        let Stages { view, cut_surface, .. } = &*self.stages;
        cut_surface.distance(&mut self.recording, view, levels, self.images);
    }

    fn depth(&mut self) {
        let Some(levels) = self.levels else { return };
        let depth = self.buffer(Image::UnfilteredDepth);
        let Stages { view, cut_surface, .. } = &mut *self.stages;
        for rules in DepthRules::of(self.request) {
            cut_surface.depth(&mut self.recording, view, levels, rules, self.images, depth);
        }
    }

    fn steady(&mut self) {
        let depth = self.buffer(Image::Depth);
        let Stages { view, steady, .. } = &*self.stages;
        steady.record(&mut self.recording, view, (self.images, depth), self.request);
    }

    fn leap(&mut self) {
        let depth = self.buffer(Image::UnfilteredDepth);
        let Stages { view, leap, .. } = &*self.stages;
        leap.write(self.device, self.request.camera);
        leap.record(&mut self.recording, view, self.images, depth);
    }

    fn depth_filter(&mut self) {
        let Images { size, unfiltered_depth: image, vessel, raised: columns, depth: smoothed, .. } =
            self.images;
        let Stages { view, depth_filter, .. } = &*self.stages;
        if self.request.settings.zone_filter {
            depth_filter.write(self.device, self.request.settings);
            let images = ZoneImages { image, vessel, columns, smoothed };
            depth_filter.record_within_zones(&mut self.recording, view, *size, images);
        } else {
            depth_filter.record(&mut self.recording, view, *size, [image, smoothed]);
        }
    }

    fn focus(&mut self) {
        let parameters = FocusParameters::new(self.request.settings, self.request.camera);
        let (Some(levels), Some(parameters)) = (self.levels, parameters) else { return };
        let Stages { view, cut_surface, .. } = &*self.stages;
        cut_surface.focus(&mut self.recording, view, levels, parameters, self.images);
    }

    fn occlusion(&mut self) {
        let Stages { view, occlusion, .. } = &*self.stages;
        let depth = self.buffer(Image::Depth);
        occlusion.record(&mut self.recording, view, (self.images, depth), self.request.camera);
    }

    fn far_rim(&mut self) {
        let Stages { view, far_rim, .. } = &*self.stages;
        let depth = self.buffer(Image::Depth);
        far_rim.record(&mut self.recording, view, (self.images, depth), self.request);
    }

    fn rim(&mut self) {
        let (Some(tree), Some(colors)) = (&self.scene.tree, self.request.rim) else { return };
        let Request { settings, camera, .. } = self.request;
        let levels = tree.levels(settings.levels, settings.centerline_smoothing);
        let along = (&colors.strips(&levels[0])[..], colors.colors());
        let Stages { view, rim, .. } = &*self.stages;
        rim.write(self.device, &RimParameters::new(settings, camera));
        rim.record(&mut self.recording, view, along, self.images);
    }

    fn surface(&mut self) -> Result<()> {
        let (Some(on_device), Some(shared)) = (self.volume, &self.scene.volume) else { return Ok(()) };
        self.stages.place(self.device, on_device, &shared.volume, &self.geometry);
        let Images { size, depth, value, .. } = self.images;
        let images = SurfaceImages { size: *size, geometry: &self.geometry, depth, value };
        let Stages { view, grid, surface, .. } = &mut *self.stages;
        let slab = self.request.settings.slab;
        surface.record(&mut self.recording, [view, grid], (on_device, &shared.volume), slab, images)
    }

    fn silhouette(&mut self) {
        let Geometry::Orthographic { camera, .. } = &self.geometry else { return };
        let Images { depth, vessel, raised, strength, size, .. } = self.images;
        let Stages { view, depth_filter, silhouette, .. } = &*self.stages;
        silhouette.write(self.device, self.request.settings, camera);
        if self.request.settings.silhouette_rule == SilhouetteRule::Leap {
            return silhouette.record_leaps(&mut self.recording, view, self.images);
        }
        let images = SilhouetteImages { size: *size, depth, vessel, raised, strength };
        silhouette.record(&mut self.recording, depth_filter, view, images);
    }

    fn context(&mut self) -> Result<()> {
        let settings = self.request.settings;
        let (Some(on_device), Some(shared), Some(context)) =
            (self.around, self.scene.shown_around(), &settings.context)
        else {
            return Ok(());
        };
        self.stages.place(self.device, on_device, &shared.volume, &self.geometry);
        let blocks = on_device.blocks(self.device, shared, self.request.stop)?;
        let Images { size, depth, value, start, gathered, squares, .. } = self.images;
        let has_surface = self.made.has(Image::Value);
        let focus = self.made.has(Image::Focus).then(|| self.buffer(Image::Focus));
        let images =
            ContextImages { size: *size, has_surface, focus, depth, value, start, gathered, squares };
        let Stages { view, grid, context: stage, .. } = &mut *self.stages;
        stage.write(self.device, settings, context, (&shared.volume, self.request.camera), blocks)?;
        stage.record(&mut self.recording, [view, grid], (on_device, blocks), context, images);
        Ok(())
    }

    fn body(&mut self) -> Result<()> {
        let (Some(around), Some(camera)) = (self.scene.shown_around(), self.geometry.camera()) else {
            return Ok(());
        };
        if let Some(body) = around.body(self.request.stop)? {
            let Stages { view, body: stage, .. } = &*self.stages;
            stage.record(&mut self.recording, view, self.images, &Outline::new(body, camera));
        }
        Ok(())
    }

    fn composite(&mut self) {
        let layer = |image| self.made.has(image).then(|| self.buffer(image));
        let layers = Layers {
            value: layer(Image::Value),
            strength: layer(Image::Strength),
            focus: layer(Image::Focus),
            rim: layer(Image::Rim),
            context: layer(Image::Gathered),
        };
        let Images { size, context, picture, .. } = self.images;
        let Stages { view, composite, .. } = &*self.stages;
        composite.write(self.device, self.request.settings);
        if let Some(gathered) = layers.context {
            composite.record_layer(&mut self.recording, view, *size, [gathered, context]);
        }
        composite.record(&mut self.recording, view, *size, layers, picture);
    }

    pub(crate) fn buffer(&self, image: Image) -> &'a Buffer {
        self.images.buffer(image, self.request.settings.depth_filter)
    }

    /// Runs the recorded stages, and reads the requested images.
    pub(crate) async fn frame(mut self) -> Result<Frame> {
        if !self.made.has(Image::Gathered) {
            self.made = self.made.without(Image::Context);
        }
        if !Stage::has_blend(self.request.images) {
            self.made = self.made.without(Image::Blend);
        }
        let asked = |image: &Image| self.request.images.has(*image) && self.made.has(*image);
        let wanted: Vec<_> = Image::ALL.into_iter().filter(asked).collect();
        let results = self.finish(&wanted).await?;
        let mut frame = Frame { timings: self.timings, ..Frame::of(self.geometry) };
        for (n, image) in wanted.into_iter().enumerate() {
            match (image, &mut frame.geometry) {
                (Image::Distance, _) => frame.distance = results.numbers(n),
                (Image::Depth, Geometry::Orthographic { depth, .. }) => *depth = results.numbers(n),
                (Image::Vessel, _) => frame.vessel = results.numbers(n),
                (Image::Blend, _) => frame.blend = results.numbers(n),
                (Image::Leap, _) => frame.leap = results.numbers(n),
                (Image::Focus, _) => frame.focus = results.numbers(n),
                (Image::Rim, _) => frame.rim = results.numbers(n),
                (Image::Value, _) => frame.value = with_holes(results.numbers(n)),
                (Image::Context, _) => frame.context = results.numbers(n),
                (Image::Picture, _) => frame.image = results.numbers(n),
                _ => {}
            }
        }
        Ok(frame)
    }

    /// Runs the recorded stages, draws the picture on a canvas, and waits for it.
    #[cfg(target_arch = "wasm32")]
    pub async fn draw(self, screen: &mut Screen) -> Result<()> {
        screen.record(self.device, self.recording, &self.images.picture)?.await
    }

    /// Runs the stages recorded so far, and requests images.
    pub(crate) async fn finish(&mut self, wanted: &[Image]) -> Result<Results> {
        let mut recording = std::mem::replace(&mut self.recording, Recording::new(self.device));
        for image in wanted {
            recording.read(self.buffer(*image), (bytes_of(*image) * self.images.pixels()) as u64);
        }
        let mut results = recording.finish(self.request.stop).await?;
        self.timings.append(&mut results.timings);
        Ok(results)
    }
}

fn bytes_of(image: Image) -> usize {
    match image {
        Image::Gathered | Image::Sheet | Image::Blend | Image::Foot | Image::Focus => 16,
        _ => 4,
    }
}

/// Replaces the marker HUGE by NaN, which frames contain.
pub(crate) fn with_holes(mut values: Vec<f32>) -> Vec<f32> {
    for value in &mut values {
        *value = if *value >= HUGE { f32::NAN } else { *value };
    }
    values
}
