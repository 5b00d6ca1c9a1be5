//! Computes a stage of a view on the CPU from the images that the GPU made before.

use lumencut_core::error::Result;
use lumencut_core::frame::Timing;
use lumencut_core::geometry::Geometry;
use lumencut_core::math::blocks::HUGE;
use lumencut_core::math::lanes::Isa;
use lumencut_core::pipeline::{Images, LookPass, Request};
use lumencut_core::stages::{Image, ImageSet, Stage, Work};
use web_time::Instant;

use crate::pass::{Pass, with_holes};
use crate::recording::Results;

impl Pass<'_> {
    /// Reads the images of a stage from the GPU, runs it on the CPU and sends its results back.
    pub(crate) async fn run_on_cpu(&mut self, stage: Stage) -> Result<()> {
        let read: Vec<_> = stage.reads().iter().copied().filter(|image| self.made.has(*image)).collect();
        let results = self.finish(&read).await?;
        let mut images = Images::default();
        for (n, image) in read.into_iter().enumerate() {
            put(&mut images, image, &results, n);
        }
        drop(results);
        let start = Instant::now();
        if stage.is_of_cut_surface() {
            self.find(stage, &mut images)?;
        } else {
            self.show(stage, &mut images)?;
        }
        let milliseconds = start.elapsed().as_secs_f64() * 1e3;
        self.timings.push(Timing { stage: stage.name(), milliseconds });
        for image in stage.writes() {
            self.send(*image, &images);
        }
        Ok(())
    }

    fn find(&mut self, stage: Stage, images: &mut Images) -> Result<()> {
        let (Some(tree), settings) = (&self.scene.tree, self.request.settings) else { return Ok(()) };
        let renderer = &mut self.on_cpu.renderer;
        renderer.prepare(tree, settings);
        renderer.project(self.request.camera, settings);
        renderer.pass(self.request).run(stage, images)
    }

    fn show(&self, stage: Stage, images: &mut Images) -> Result<()> {
        let (Some(volume), Some(around)) = (&self.scene.volume, self.scene.shown_around()) else {
            return Ok(());
        };
        let geometry = match &self.geometry {
            Geometry::Orthographic { camera, .. } => {
                Geometry::Orthographic { camera: *camera, depth: std::mem::take(&mut images.depth) }
            }
            Geometry::Curved(curved) => Geometry::Curved(curved.clone()),
        };
        let &Request { settings, images: wanted, stop, .. } = self.request;
        let work = Work { size: self.images.size, isa: Isa::widest(), stop, progress: None };
        let vessel = std::mem::take(&mut images.vessel);
        let leap = std::mem::take(&mut images.leap);
        let focus = std::mem::take(&mut images.focus);
        let rim = std::mem::take(&mut images.rim);
        let (geometry, vessel, leap, focus, rim) = (&geometry, &vessel, &leap, &focus, &rim);
        let pass = LookPass { work, volume, around, settings, geometry, vessel, leap, focus, rim, wanted };
        pass.run(stage, images)?;
        if stage == Stage::Context && images.gathered.is_empty() {
            images.gathered = vec![[0.0; 4]; self.images.pixels()];
        }
        Ok(())
    }

    fn send(&mut self, image: Image, images: &Images) {
        let bytes: &[u8] = match image {
            Image::Distance => bytemuck::cast_slice(&images.distance),
            Image::UnfilteredDepth => bytemuck::cast_slice(&images.unfiltered_depth),
            Image::Depth => bytemuck::cast_slice(&images.depth),
            Image::Vessel => bytemuck::cast_slice(&images.vessel),
            Image::Sheet => bytemuck::cast_slice(&images.sheet),
            Image::Blend => bytemuck::cast_slice(&images.blend),
            Image::Foot => bytemuck::cast_slice(&images.foot),
            // No stage writes it.
            Image::Before => &[],
            Image::Leap => bytemuck::cast_slice(&images.leap),
            Image::Focus => bytemuck::cast_slice(&images.focus),
            Image::Rim => bytemuck::cast_slice(&images.rim),
            Image::Value => &without_holes(&images.value),
            Image::Strength => bytemuck::cast_slice(&images.strength),
            Image::Start => bytemuck::cast_slice(&images.start),
            Image::Gathered => bytemuck::cast_slice(&images.gathered),
            Image::Context => bytemuck::cast_slice(&images.context),
            Image::Picture => bytemuck::cast_slice(&images.picture),
        };
        if !bytes.is_empty() {
            self.device.write(self.buffer(image), bytes);
            self.made = self.made.and(ImageSet::of(&[image]));
        }
    }
}

fn put(images: &mut Images, image: Image, results: &Results, n: usize) {
    match image {
        Image::Distance => images.distance = results.numbers(n),
        Image::UnfilteredDepth => images.unfiltered_depth = results.numbers(n),
        Image::Depth => images.depth = results.numbers(n),
        Image::Vessel => images.vessel = results.numbers(n),
        Image::Sheet => images.sheet = results.numbers(n),
        Image::Blend => images.blend = results.numbers(n),
        Image::Foot => images.foot = results.numbers(n),
        // The request has it.
        Image::Before => {}
        Image::Leap => images.leap = results.numbers(n),
        Image::Focus => images.focus = results.numbers(n),
        Image::Rim => images.rim = results.numbers(n),
        Image::Value => images.value = with_holes(results.numbers(n)),
        Image::Strength => images.strength = results.numbers(n),
        Image::Start => images.start = results.numbers(n),
        Image::Gathered => images.gathered = results.numbers(n),
        Image::Context => images.context = results.numbers(n),
        Image::Picture => images.picture = results.numbers(n),
    }
}

/// Replaces NaN by the marker HUGE, which shaders use.
fn without_holes(values: &[f32]) -> Vec<u8> {
    let huge = values.iter().map(|value| if value.is_nan() { HUGE } else { *value });
    huge.flat_map(f32::to_ne_bytes).collect()
}
