//! The method from end to end: the stages in the order of the paper's Fig. 4.

use rayon::prelude::*;
use web_time::Instant;

use crate::camera::Camera;
use crate::error::Result;
use crate::frame::{Frame, Timing};
use crate::math::lanes::Isa;
use crate::math::projection::{Level, ProjectedLevel};
use crate::math::ray::{NONE, WHOLE};
use crate::settings::Settings;
use crate::stages::composite::{Layers, composite, layer};
use crate::stages::context::{context, starts};
use crate::stages::depth::{CutSurface, depth};
use crate::stages::depth_filter::depth_filter;
use crate::stages::distance::distance;
use crate::stages::levels::levels;
use crate::stages::silhouette::silhouette;
use crate::stages::surface::surface;
use crate::stages::{Stop, View};
use crate::vessel_tree::VesselTree;
use crate::volume::Volume;

/// Renders views of one vessel tree. What does not depend on the view is made once; the buffers that hold the
/// projected tree are kept from view to view.
#[derive(Debug)]
pub struct Renderer {
    tree: VesselTree,
    levels: Vec<Level>,
    projected: Vec<ProjectedLevel>,
    isa: Isa,
}

impl Renderer {
    /// A renderer of `tree`, with the kernels for the widest instruction set of this processor.
    pub fn new(tree: VesselTree) -> Self {
        Self { tree, levels: Vec::new(), projected: Vec::new(), isa: Isa::widest() }
    }

    /// The same renderer with the kernels for `isa`; the pictures are the same to the bit.
    #[must_use]
    pub fn with_isa(mut self, isa: Isa) -> Self {
        self.isa = isa;
        self
    }

    /// The tree.
    pub fn tree(&self) -> &VesselTree {
        &self.tree
    }

    /// The whole picture: cut surface, volume at the surface, silhouettes, context, window.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Settings`] for a setting outside its range,
    /// [`crate::error::ErrorKind::Interrupted`] once `stop` says so.
    pub fn render(
        &mut self,
        volume: &Volume,
        camera: &Camera,
        settings: &Settings,
        stop: Stop,
    ) -> Result<Frame> {
        let mut frame = self.cut_surface(camera, settings, stop)?;
        let view = View { camera, isa: self.isa, stop };
        let mut clock = Clock::start();
        let pixels = frame.depth.len();
        frame.value = vec![0.0; pixels];
        surface(&view, volume, &frame.depth, settings.slab, &mut frame.value)?;
        clock.lap("surface", &mut frame.timings);
        let mut strength = Vec::new();
        if settings.silhouettes {
            strength.resize(pixels, 0.0);
            silhouette(&view, &frame.depth, &frame.vessel, settings.silhouette_slope, &mut strength)?;
            clock.lap("silhouette", &mut frame.timings);
        }
        let start = settings.context.as_ref().map(|_| starts(&frame.value, &frame.depth, settings));
        let behind = surroundings(&view, volume, settings, start.as_deref(), &mut frame, &mut clock)?;
        let strength = settings.silhouettes.then_some(&strength[..]);
        show(&view, settings, strength, behind.as_deref(), &mut frame)?;
        clock.lap("composite", &mut frame.timings);
        Ok(frame)
    }

    /// The cut surface alone: depth, vessel and distance; `value` and `image` stay empty.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn cut_surface(&mut self, camera: &Camera, settings: &Settings, stop: Stop) -> Result<Frame> {
        settings.check()?;
        let mut frame = Frame::empty(*camera, camera.size()[0] * camera.size()[1]);
        let mut clock = Clock::start();
        self.prepare(settings.levels);
        clock.lap("levels", &mut frame.timings);
        let view = View { camera, isa: self.isa, stop };
        let cut_surface = self.project(camera, settings);
        clock.lap("projection", &mut frame.timings);
        let pixels = frame.distance.len();
        distance(&view, cut_surface.finest(), &mut frame.distance)?;
        clock.lap("distance", &mut frame.timings);
        depth(&view, &cut_surface, &frame.distance, &mut frame.depth, &mut frame.vessel)?;
        clock.lap("depth", &mut frame.timings);
        if settings.depth_filter {
            let mut smoothed = vec![0.0; pixels];
            depth_filter(&view, &frame.depth, &mut smoothed)?;
            frame.depth = smoothed;
            clock.lap("depth_filter", &mut frame.timings);
        }
        Ok(frame)
    }

    /// Makes the levels of detail that are not there yet.
    fn prepare(&mut self, count: usize) {
        if self.levels.len() <= count {
            self.levels = levels(&self.tree, count).par_iter().map(Level::new).collect();
            self.projected = self.levels.iter().map(ProjectedLevel::new).collect();
        }
    }

    /// The tree and its `count` levels of detail, finest first.
    pub fn levels(&mut self, count: usize) -> &[Level] {
        self.prepare(count);
        &self.levels[..=count]
    }

    /// The first levels in the view of `camera`.
    pub fn project(&mut self, camera: &Camera, settings: &Settings) -> CutSurface<'_> {
        self.prepare(settings.levels);
        let levels = &self.levels[..=settings.levels];
        let projected = &mut self.projected[..=settings.levels];
        projected
            .par_iter_mut()
            .zip(levels)
            .for_each(|(projected, level)| projected.project(level, camera, settings.preserve_lumen));
        CutSurface::new(levels, projected, camera, settings)
    }
}

/// The context of a volume alone: every ray crosses all of it. Depth, vessel, distance and value stay empty; `isa` does
/// not change the picture.
///
/// # Errors
/// As [`Renderer::render`].
pub fn context_alone(
    volume: &Volume,
    camera: &Camera,
    settings: &Settings,
    isa: Isa,
    stop: Stop,
) -> Result<Frame> {
    settings.check()?;
    let view = View { camera, isa, stop };
    let pixels = camera.size()[0] * camera.size()[1];
    let mut frame = Frame { value: vec![f32::NAN; pixels], ..Frame::empty(*camera, 0) };
    let (start, mut clock) = (vec![WHOLE; pixels], Clock::start());
    let behind = surroundings(&view, volume, settings, Some(&start), &mut frame, &mut clock)?;
    show(&view, settings, None, behind.as_deref(), &mut frame)?;
    clock.lap("composite", &mut frame.timings);
    frame.value = Vec::new();
    Ok(frame)
}

/// The context where `start` says that its rays start, and its own picture; nothing where no ray starts.
fn surroundings(
    view: &View,
    volume: &Volume,
    settings: &Settings,
    start: Option<&[f32]>,
    frame: &mut Frame,
    clock: &mut Clock,
) -> Result<Option<Vec<[f32; 4]>>> {
    let (Some(settings), Some(start)) = (&settings.context, start) else { return Ok(None) };
    frame.context = vec![[0; 4]; start.len()];
    // Behind a cut surface that hides everything there is nothing.
    let behind = if start.iter().any(|start| *start < NONE) {
        let blocks = volume.blocks(view.stop)?;
        clock.lap("blocks", &mut frame.timings);
        let mut behind = vec![[0.0; 4]; start.len()];
        context(view, volume, Some(blocks), settings, start, &mut behind)?;
        layer(view, &behind, &mut frame.context)?;
        Some(behind)
    } else {
        None
    };
    clock.lap("context", &mut frame.timings);
    Ok(behind)
}

/// The picture of all layers.
fn show(
    view: &View,
    settings: &Settings,
    strength: Option<&[f32]>,
    context: Option<&[[f32; 4]]>,
    frame: &mut Frame,
) -> Result<()> {
    frame.image = vec![[0; 4]; frame.value.len()];
    composite(view, &Layers { value: &frame.value, strength, context }, settings, &mut frame.image)
}

/// Measures the stages one after the other.
struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Self(Instant::now())
    }

    fn lap(&mut self, stage: &'static str, timings: &mut Vec<Timing>) {
        let now = Instant::now();
        timings.push(Timing { stage, milliseconds: (now - self.0).as_secs_f64() * 1e3 });
        self.0 = now;
    }
}
