//! The method from end to end: the stages in the order of the paper's Fig. 4. `cut_surface` finds the position of
//! every pixel, `look` shows the volume there. A reformation finds the positions in another way and then also uses
//! `look`.

mod images;
mod pass;

use std::borrow::Cow;
use std::sync::Arc;

use rayon::prelude::*;
use web_time::Instant;

pub use self::images::Images;
pub(crate) use self::pass::Lines;
pub use self::pass::{CutSurfacePass, LookPass, SurfaceDetails};
use crate::camera::Camera;
use crate::error::{Error, ErrorKind, Result};
use crate::frame::{Frame, Timing, clear_outside};
use crate::geometry::Geometry;
use crate::math::chosen_slots::chosen_slots;
use crate::math::lanes::Isa;
use crate::math::projection::{Level, ProjectedLevel, Radii};
use crate::progress::Progress;
use crate::scene::{LeveledTree, Scene, SharedVolume};
use crate::settings::Settings;
use crate::stages::composite::{CompositeParameters, Layers, composite};
use crate::stages::depth::{CutSurface, Sheet};
use crate::stages::rim::RimColors;
use crate::stages::steady::{Before, SteadyParameters};
use crate::stages::{Image, ImageSet, Stage, Work};
use crate::stop::Stop;

/// A view of a scene to render.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// The view.
    pub camera: &'a Camera,
    /// The settings that the view is made and shown with.
    pub settings: &'a Settings,
    /// The wanted images; the frame contains those that the view has.
    pub images: ImageSet,
    /// Returns whether to stop.
    pub stop: Stop<'a>,
    /// Receives the progress of the view.
    pub progress: Option<&'a Progress>,
    /// Colours along the vessels, which the setting `rim` needs.
    pub rim: Option<&'a RimColors>,
    /// The view before in a turn, which the setting `turning_limit` holds on to.
    pub before: Option<Before<'a>>,
}

impl<'a> Request<'a> {
    /// A request for all images of a view, without stop or progress.
    pub fn new(camera: &'a Camera, settings: &'a Settings) -> Self {
        Self {
            camera,
            settings,
            images: ImageSet::ALL,
            stop: &|| false,
            progress: None,
            rim: None,
            before: None,
        }
    }

    /// The settings adapted to the vessels of the scene, checked. Fails with [`ErrorKind::Settings`] for a
    /// setting outside its range, or a focus or chosen vessel that the scene lacks.
    pub fn settings_for(&self, scene: &Scene) -> Result<Cow<'a, Settings>> {
        self.settings.check()?;
        if let Some(tree) = &scene.tree {
            let count = tree.tree().vessels().len();
            self.check_rim(scene, count)?;
            return self.settings.for_vessels(count);
        }
        let Some((setting, what)) = self.settings.focused() else {
            return Ok(Cow::Borrowed(self.settings));
        };
        let found = format!("{what} for a scene without centerlines");
        Err(Error::new(ErrorKind::Settings, setting, found, "a scene with centerlines")
            .mend(format!("give centerlines, or leave the {setting} out")))
    }

    /// Rejects a picture with a rim without a colour for each vessel.
    fn check_rim(&self, scene: &Scene, count: usize) -> Result<()> {
        let is_drawn =
            self.settings.rim.is_some() && scene.volume.is_some() && self.images.has(Image::Picture);
        let known = self.rim.map_or(0, RimColors::vessels);
        if !is_drawn || known == count {
            return Ok(());
        }
        let found = format!("values of {known} vessels");
        Err(Error::new(ErrorKind::Settings, "rim", found, format!("values of {count} vessels")))
    }

    /// Leaves out the picture if the scene has no volume to show.
    #[must_use]
    pub fn without_unseen_picture(self, scene: &Scene) -> Self {
        let images = if scene.volume.is_some() { self.images } else { self.images.without(Image::Picture) };
        Self { images, ..self }
    }

    /// Also asks for the depth of the view before, if this one continues its turn.
    #[must_use]
    pub fn continued(self) -> Self {
        let before = self.before.filter(|before| {
            let is_whole = before.depth.len() == before.camera.size().iter().product::<usize>();
            is_whole && SteadyParameters::new(self.settings, self.camera, before).is_some()
        });
        let more = if before.is_some() { &[Image::Before][..] } else { &[] };
        Self { before, images: self.images.and(ImageSet::of(more)), ..self }
    }

    fn begin_view(&self, scene: &Scene) {
        let Some(progress) = self.progress else { return };
        let asked = self.without_unseen_picture(scene).images;
        let mut stages = Vec::new();
        let mut made = ImageSet::of(&[]);
        if scene.tree.is_some() {
            stages = Stage::of_cut_surface(self.settings, asked);
            let written = stages.iter().flat_map(|stage| stage.writes()).copied().collect::<Vec<_>>();
            made = ImageSet::of(&written).and(ImageSet::of(&[Image::Depth]));
        }
        if scene.volume.is_some() {
            stages.extend(Stage::of_look(self.settings, &Geometry::rays(*self.camera), made, asked));
        }
        progress.begin_view(stages.iter().map(|stage| stage.cost()), self.camera.size().iter().product());
    }

    fn begin_stage(&self, stage: Stage) {
        if let Some(progress) = self.progress {
            progress.begin_stage(stage.cost());
        }
    }
}

/// Renders views on the CPU. The renderer keeps the buffers of the projected tree and of the sheet for later
/// views; all other data belong to scenes.
#[derive(Debug)]
pub struct CpuRenderer {
    levels: Arc<Vec<Level>>,
    projected: Vec<ProjectedLevel>,
    /// The vessels that take precedence in `projected`.
    first: Vec<usize>,
    /// The sheet of the previous view, kept to reuse its buffer, the largest of those that no frame needs.
    sheet: Vec<Sheet>,
    pub(crate) isa: Isa,
}

impl Default for CpuRenderer {
    fn default() -> Self {
        Self::new(Isa::widest())
    }
}

impl CpuRenderer {
    /// A renderer with the kernels for `isa`; the pictures are bit-identical for all.
    pub fn new(isa: Isa) -> Self {
        Self { levels: Arc::default(), projected: Vec::new(), first: Vec::new(), sheet: Vec::new(), isa }
    }

    /// Renders one view of a scene: without a volume only the cut surface, without a tree only the context.
    /// Ignores `Settings::samples`, since callers average several pictures. Fails as
    /// [`Request::settings_for`], and with [`ErrorKind::Volume`] for a scene without volume and tree.
    pub fn render(&mut self, scene: &Scene, request: &Request) -> Result<Frame> {
        let settings = request.settings_for(scene)?;
        let request = &Request { settings: &settings, ..*request }.continued();
        request.begin_view(scene);
        let frame = match &scene.tree {
            Some(tree) => self.cut_surface(tree, &request.without_unseen_picture(scene))?,
            None => Frame::of(Geometry::rays(*request.camera)),
        };
        match &scene.volume {
            Some(volume) => self.show([volume, scene.context.as_ref().unwrap_or(volume)], frame, request),
            None if scene.tree.is_some() => Ok(frame.keeping(request.images)),
            None => Err(nothing_to_show()),
        }
    }

    /// The details of the cut surface; ignores the images of the request. Fails as [`CpuRenderer::render`].
    pub fn details(&mut self, tree: &LeveledTree, request: &Request) -> Result<SurfaceDetails> {
        request.settings.check()?;
        let settings = request.settings.for_vessels(tree.tree().vessels().len())?.into_owned();
        // The share that darkens a pixel is then that of the far rim alone.
        let settings = &Settings { occlusion: 0.0, ..settings };
        self.prepare(tree, settings);
        self.project(request.camera, settings);
        let request = Request { settings, images: SurfaceDetails::WANTED, ..*request }.continued();
        SurfaceDetails::of(&self.pass(&request))
    }

    /// Strength of the silhouettes, 0 to 1, of a reformation's frame with [`crate::stages::Image::Leap`];
    /// neither reach nor focus reduces it.
    pub fn strength(&self, frame: &Frame, request: &Request) -> Result<Vec<f32>> {
        let &Request { camera, settings, stop, .. } = request;
        let work = Work { size: frame.size(), isa: self.isa, stop, progress: None };
        Lines::of(frame).strength(&work, settings, camera)
    }

    fn cut_surface(&mut self, tree: &LeveledTree, request: &Request) -> Result<Frame> {
        let mut clock = Clock::start();
        let mut images = Images { sheet: std::mem::take(&mut self.sheet), ..Images::default() };
        self.prepare(tree, request.settings);
        clock.lap(Stage::Levels);
        self.project(request.camera, request.settings);
        clock.lap(Stage::Projection);
        let pass = self.pass(request);
        for stage in Stage::of_cut_surface(request.settings, request.images) {
            request.begin_stage(stage);
            pass.run(stage, &mut images)?;
            clock.lap(stage);
        }
        self.sheet = std::mem::take(&mut images.sheet);
        Ok(images.into_cut_surface(*request.camera, clock.timings))
    }

    /// Shows the volume at the positions of a frame of any method: values, silhouettes, context, picture. Of
    /// the request only settings, images and stop apply. Fails as [`CpuRenderer::render`].
    pub fn look(&self, volume: &SharedVolume, frame: Frame, request: &Request) -> Result<Frame> {
        request.settings.check()?;
        self.show([volume; 2], frame, request)
    }

    /// Shows the first volume on the surface, and the second one around it.
    fn show(&self, [volume, around]: [&SharedVolume; 2], frame: Frame, request: &Request) -> Result<Frame> {
        let &Request { settings, stop, progress, .. } = request;
        let work = Work { size: frame.size(), isa: self.isa, stop, progress };
        let (mut clock, mut images) = (Clock::start(), Images::default());
        let Frame { geometry, vessel, leap, focus, rim, .. } = &frame;
        let wanted = request.images;
        let pass = LookPass { work, volume, around, settings, geometry, vessel, leap, focus, rim, wanted };
        for stage in Stage::of_look(settings, &frame.geometry, frame.images(), request.images) {
            request.begin_stage(stage);
            pass.run(stage, &mut images)?;
            clock.lap(stage);
        }
        Ok(images.into_frame(frame, clock.timings).keeping(request.images))
    }

    /// Takes over the levels of a tree if the tree, their number, the smoothing or chosen vessels changed.
    pub fn prepare(&mut self, tree: &LeveledTree, settings: &Settings) {
        let levels = tree.levels(settings.levels, settings.centerline_smoothing);
        if !Arc::ptr_eq(&self.levels, &levels) {
            self.projected = levels.iter().map(ProjectedLevel::new).collect();
            self.levels = levels;
            self.first = Vec::new();
        }
        if self.first != settings.focus_vessels {
            self.first.clone_from(&settings.focus_vessels);
            for (projected, level) in self.projected.iter_mut().zip(self.levels.iter()) {
                projected.put_first(level, &chosen_slots(level, &self.first));
            }
        }
    }

    /// Projects the prepared levels into the view of `camera`.
    pub fn project(&mut self, camera: &Camera, settings: &Settings) {
        let (levels, projected) = (&self.levels, &mut self.projected[..=settings.levels]);
        projected
            .par_iter_mut()
            .zip(levels.par_iter())
            .for_each(|(projected, level)| projected.project(level, camera, Radii::new(settings)));
    }

    /// The input of the cut-surface stages, after the levels are projected.
    pub fn pass<'a>(&'a self, request: &Request<'a>) -> CutSurfacePass<'a> {
        let &Request { camera, settings, images, stop, progress, rim, before } = request;
        let (levels, projected) = (&self.levels[..=settings.levels], &self.projected[..=settings.levels]);
        CutSurfacePass {
            work: Work { size: camera.size(), isa: self.isa, stop, progress },
            surface: CutSurface::new(levels, projected, camera, settings),
            has_sheet: Stage::has_sheet(settings, images),
            wanted: images,
            settings,
            colors: rim,
            before,
        }
    }
}

/// The picture of values in the window and opacity of `settings`, over their background; transparent if the
/// value is NaN. Fails with [`ErrorKind::Settings`] for a setting outside its range.
pub fn picture(value: &[f32], size: [usize; 2], (settings, stop): (&Settings, Stop)) -> Result<Vec<[u8; 4]>> {
    settings.check()?;
    let work = Work { size, isa: Isa::widest(), stop, progress: None };
    let mut image = vec![[0; 4]; value.len()];
    let layers = Layers { value, strength: None, focus: None, rim: None, context: None };
    composite(&work, &CompositeParameters::new(settings), &layers, &mut image)?;
    clear_outside(&mut image, value);
    Ok(image)
}

/// The error for an empty scene.
pub fn nothing_to_show() -> Error {
    let found = "neither a volume nor vessels";
    Error::new(ErrorKind::Volume, "scene of the renderer", found, "one of them or both")
}

/// Measures the stages one after the other.
pub(crate) struct Clock {
    last: Instant,
    pub(crate) timings: Vec<Timing>,
}

impl Clock {
    pub(crate) fn start() -> Self {
        Self { last: Instant::now(), timings: Vec::new() }
    }

    pub(crate) fn lap(&mut self, stage: Stage) {
        let now = Instant::now();
        let milliseconds = (now - self.last).as_secs_f64() * 1e3;
        self.timings.push(Timing { stage: stage.name(), milliseconds });
        self.last = now;
    }
}
