//! The stages of one view, each with the parameters and the images that it reads.

use super::images::Images;
use crate::camera::Camera;
use crate::error::Result;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::math::context_parameters::StartParameters;
use crate::math::ray::{NONE, WHOLE};
use crate::scene::SharedVolume;
use crate::settings::{Settings, SilhouetteRule, SlabMode};
use crate::stages::body::{Outline, body};
use crate::stages::composite::{CompositeParameters, Layers, composite, layer};
use crate::stages::context::{SurfaceImages, Surroundings, context, starts};
use crate::stages::depth::{CutSurface, DepthImages, Sheet, depth};
use crate::stages::depth_filter::{DepthFilterParameters, depth_filter};
use crate::stages::distance::distance;
use crate::stages::far_rim::{FarRimParameters, far_rim};
use crate::stages::focus::{FocusParameters, Shares, focus};
use crate::stages::leap::{LeapParameters, leap};
use crate::stages::occlusion::{OcclusionParameters, occlusion};
use crate::stages::rim::{RimColors, RimParameters, rim};
use crate::stages::silhouette::{FARTHEST_LEAP, SilhouetteParameters, silhouette, silhouette_of_leaps};
use crate::stages::steady::{Before, SteadyParameters, steady};
use crate::stages::surface::{SurfaceScene, surface};
use crate::stages::{Image, ImageSet, Stage, Work};
use crate::stop::{filled, resize};

/// The common input of the stages that find the cut surface.
#[doc(hidden)]
pub struct CutSurfacePass<'a> {
    pub work: Work<'a>,
    pub surface: CutSurface<'a>,
    /// Whether the stage `depth` writes the sheet.
    pub has_sheet: bool,
    pub wanted: ImageSet,
    pub settings: &'a Settings,
    /// Colours along the vessels, for the rim.
    pub colors: Option<&'a RimColors>,
    /// The view before, if this one continues a turn.
    pub before: Option<Before<'a>>,
}

impl CutSurfacePass<'_> {
    /// Runs a stage that finds the cut surface; other stages do nothing here.
    pub fn run(&self, stage: Stage, images: &mut Images) -> Result<()> {
        let (work, pixels) = (&self.work, self.work.pixels());
        match stage {
            Stage::Distance => {
                images.distance = vec![0.0; pixels];
                distance(work, &self.surface, &mut images.distance)
            }
            Stage::Depth => {
                images.unfiltered_depth = vec![0.0; pixels];
                images.vessel = vec![0; pixels];
                // Overwrites the sheet of the previous view.
                resize(&mut images.sheet, if self.has_sheet { pixels } else { 0 }, [0.0; 4], work.stop)?;
                if Stage::has_blend(self.wanted) {
                    images.blend = vec![[0.0; 4]; pixels];
                }
                if Stage::has_foot(self.settings, self.wanted) {
                    images.foot = vec![[0.0; 4]; pixels];
                }
                let Images { unfiltered_depth, vessel, sheet, blend, foot, .. } = images;
                let written = DepthImages { depth: unfiltered_depth, vessel, sheet, blend, foot };
                depth(work, &self.surface, &images.distance, written)
            }
            Stage::Steady => self.steady(images),
            Stage::Leap => {
                images.leap = vec![0; pixels];
                let parameters = LeapParameters::new(self.surface.camera());
                let Images { unfiltered_depth, vessel, sheet, leap: leaps, .. } = images;
                leap(work, &parameters, (unfiltered_depth, vessel), sheet, leaps)
            }
            Stage::DepthFilter => self.depth_filter(images),
            Stage::Focus => self.focus(images),
            Stage::Rim => self.rim(images),
            Stage::Occlusion => {
                let Images { unfiltered_depth, depth, focus, .. } = images;
                let depth = if depth.is_empty() { unfiltered_depth } else { depth };
                occlusion(work, &OcclusionParameters::new(self.surface.camera()), depth, focus)
            }
            Stage::FarRim => {
                let Images { unfiltered_depth, depth, leap, focus, .. } = images;
                let depth = if depth.is_empty() { unfiltered_depth } else { depth };
                far_rim(
                    work,
                    &FarRimParameters::new(self.settings, self.surface.camera()),
                    leap,
                    depth,
                    focus,
                )
            }
            Stage::Levels
            | Stage::Projection
            | Stage::Surface
            | Stage::Silhouette
            | Stage::Blocks
            | Stage::Context
            | Stage::Body
            | Stage::Composite => Ok(()),
        }
    }

    fn steady(&self, images: &mut Images) -> Result<()> {
        let Some(before) = &self.before else { return Ok(()) };
        match SteadyParameters::new(self.settings, self.surface.camera(), before) {
            Some(parameters) => {
                let before = before.seen_by(self.surface.camera());
                let Images { unfiltered_depth, depth, foot, .. } = images;
                // Filtering depths that are held would change lumen and wall.
                let depth = if depth.is_empty() { unfiltered_depth } else { depth };
                steady(&self.work, &parameters, foot, &before, depth)
            }
            None => Ok(()),
        }
    }

    fn focus(&self, images: &mut Images) -> Result<()> {
        let Some(parameters) = FocusParameters::new(self.settings, self.surface.camera()) else {
            return Ok(());
        };
        images.focus = vec![[0.0; 4]; self.work.pixels()];
        // The focus image alone needs exact shares in every pixel; silhouettes need them only near depth jumps.
        let is_alone = self.wanted.has(Image::Focus) && !self.wanted.has(Image::Leap);
        let is_whole = is_alone || self.settings.silhouette_rule != SilhouetteRule::Leap;
        let leap = if is_whole { &[][..] } else { &images.leap };
        let rim = FarRimParameters::new(self.settings, self.surface.camera());
        let reach = if rim.strength > 0.0 { rim.reach() } else { FARTHEST_LEAP };
        focus(&self.work, &self.surface, &parameters, (leap, reach), &mut images.focus)
    }

    fn rim(&self, images: &mut Images) -> Result<()> {
        let Some(colors) = self.colors else { return Ok(()) };
        let parameters = RimParameters::new(self.settings, self.surface.camera());
        let strips = colors.strips(self.surface.level(0));
        images.rim = vec![[0; 4]; self.work.pixels()];
        let along = (&strips[..], colors.colors());
        let places = (&images.foot[..], &images.vessel[..]);
        rim(&self.work, &parameters, along, places, &mut images.rim)?;
        images.foot = Vec::new();
        Ok(())
    }

    fn depth_filter(&self, images: &mut Images) -> Result<()> {
        let parameters = DepthFilterParameters::of(self.settings);
        let zones = self.settings.zone_filter.then_some(&images.vessel[..]);
        images.depth = vec![0.0; self.work.pixels()];
        depth_filter(&self.work, &parameters, &images.unfiltered_depth, zones, &mut images.depth)?;
        images.unfiltered_depth = Vec::new();
        Ok(())
    }
}

/// The common input of the stages that show the volume.
#[derive(Clone, Copy)]
#[doc(hidden)]
pub struct LookPass<'a> {
    /// Pixels, instruction set, and whether to stop.
    pub work: Work<'a>,
    pub volume: &'a SharedVolume<'a>,
    /// The volume that the context shows.
    pub around: &'a SharedVolume<'a>,
    pub settings: &'a Settings,
    pub geometry: &'a Geometry,
    pub vessel: &'a [i32],
    pub leap: &'a [u32],
    pub focus: &'a [Shares],
    pub rim: &'a [[u8; 4]],
    pub wanted: ImageSet,
}

impl LookPass<'_> {
    /// Runs a stage that shows the volume. Fails with `Settings` for a slab or step that does not fit the volume.
    pub fn run(&self, stage: Stage, images: &mut Images) -> Result<()> {
        match stage {
            Stage::Surface => self.surface(images),
            Stage::Silhouette => self.silhouette(images),
            Stage::Blocks => self.blocks(images),
            Stage::Context => self.context(images),
            Stage::Body => self.body(images),
            Stage::Composite => self.composite(images),
            Stage::Levels
            | Stage::Projection
            | Stage::Distance
            | Stage::Depth
            | Stage::Steady
            | Stage::Leap
            | Stage::DepthFilter
            | Stage::Focus
            | Stage::Rim
            | Stage::Occlusion
            | Stage::FarRim => Ok(()),
        }
    }

    fn surface(&self, images: &mut Images) -> Result<()> {
        let (slab, volume) = (self.settings.slab, &self.volume.volume);
        // A mean reads every voxel, so blocks cannot help.
        let searches = slab.filter(|slab| slab.mode != SlabMode::Mean);
        let blocks = searches.map(|_| self.volume.blocks(self.work.stop)).transpose()?;
        images.value = vec![0.0; self.work.pixels()];
        let scene = SurfaceScene { geometry: self.geometry, volume, blocks, slab };
        surface(&self.work, &scene, &mut images.value)
    }

    fn focus(&self) -> Option<&[Shares]> {
        Some(self.focus).filter(|focus| !focus.is_empty())
    }

    fn silhouette(&self, images: &mut Images) -> Result<()> {
        let Some(camera) = self.geometry.camera() else { return Ok(()) };
        let lines = Lines {
            depth: self.geometry.depth(),
            vessel: self.vessel,
            leap: self.leap,
            value: &images.value,
        };
        images.strength = lines.strength(&self.work, self.settings, camera)?;
        Ok(())
    }

    fn blocks(&self, images: &mut Images) -> Result<()> {
        self.starts(images)?;
        if has_rays(&images.start) { self.around.blocks(self.work.stop).map(drop) } else { Ok(()) }
    }

    /// Writes the starts of rays; without a cut surface every ray crosses the entire volume.
    fn starts(&self, images: &mut Images) -> Result<()> {
        images.start = filled(self.work.pixels(), WHOLE, self.work.stop)?;
        if self.geometry.has_surface() {
            let parameters = StartParameters::new(self.settings);
            let surface =
                SurfaceImages { value: &images.value, depth: self.geometry.depth(), focus: self.focus() };
            starts(&self.work, &parameters, &surface, &mut images.start);
        }
        Ok(())
    }

    /// Renders the context, but not behind an opaque cut surface.
    fn context(&self, images: &mut Images) -> Result<()> {
        let (Some(camera), Some(chosen)) = (self.geometry.camera(), &self.settings.context) else {
            return Ok(());
        };
        if images.start.is_empty() {
            self.starts(images)?;
        }
        if !has_rays(&images.start) {
            return Ok(());
        }
        let (volume, blocks) = (&self.around.volume, Some(self.around.blocks(self.work.stop)?));
        images.gathered = vec![[0.0; 4]; self.work.pixels()];
        let surroundings = Surroundings { camera, volume, blocks };
        context(&self.work, &surroundings, self.settings, chosen, &images.start, &mut images.gathered)
    }

    fn body(&self, images: &mut Images) -> Result<()> {
        let (Some(camera), Some(found)) = (self.geometry.camera(), self.around.body(self.work.stop)?) else {
            return Ok(());
        };
        if images.gathered.is_empty() {
            return Ok(());
        }
        body(&self.work, &Outline::new(found, camera), &images.start, &mut images.gathered)
    }

    fn composite(&self, images: &mut Images) -> Result<()> {
        let pixels = self.work.pixels();
        let has_context = self.settings.context.is_some() && self.geometry.camera().is_some();
        if has_context && self.wanted.has(Image::Context) {
            images.context = vec![[0; 4]; pixels];
            if !images.gathered.is_empty() {
                layer(&self.work, &images.gathered, &mut images.context)?;
            }
        }
        let unknown = if images.value.is_empty() { pixels } else { 0 };
        let nothing = filled(unknown, f32::NAN, self.work.stop)?;
        let layers = Layers {
            value: if images.value.is_empty() { &nothing } else { &images.value },
            strength: Some(&images.strength[..]).filter(|strength| !strength.is_empty()),
            focus: self.focus(),
            rim: Some(self.rim).filter(|rim| !rim.is_empty()),
            context: Some(&images.gathered[..]).filter(|gathered| !gathered.is_empty()),
        };
        images.picture = vec![[0; 4]; pixels];
        composite(&self.work, &CompositeParameters::new(self.settings), &layers, &mut images.picture)
    }
}

pub(crate) struct Lines<'a> {
    pub depth: &'a [f32],
    pub vessel: &'a [i32],
    pub leap: &'a [u32],
    /// The values at the cut surface; empty without a volume.
    pub value: &'a [f32],
}

impl<'a> Lines<'a> {
    pub(crate) fn of(frame: &'a Frame) -> Self {
        Self { depth: frame.depth(), vessel: &frame.vessel, leap: &frame.leap, value: &[] }
    }

    pub(crate) fn strength(&self, work: &Work, settings: &Settings, camera: &Camera) -> Result<Vec<f32>> {
        let (mut strength, parameters) =
            (vec![0.0; work.pixels()], SilhouetteParameters::new(settings, camera));
        match settings.silhouette_rule {
            SilhouetteRule::Leap => {
                silhouette_of_leaps(work, &parameters, self.leap, self.value, &mut strength)?;
            }
            SilhouetteRule::Gradient => {
                silhouette(work, &parameters, self.depth, self.vessel, &mut strength)?;
            }
        }
        Ok(strength)
    }
}

fn has_rays(start: &[f32]) -> bool {
    start.iter().any(|start| *start < NONE)
}

/// Images of a cut surface that no frame has.
#[derive(Clone, Debug)]
pub struct SurfaceDetails {
    /// Slopes, radius and blend in each pixel.
    pub sheet: Vec<Sheet>,
    /// Bits that mark depth jumps ([`crate::stages::leap`]).
    pub leap: Vec<u32>,
    /// The strength of the silhouettes as drawn, 0 to 1: reach and focus reduce it.
    pub strength: Vec<f32>,
    /// How much the far rim darkens each pixel, 0 to 1.
    pub rim: Vec<f32>,
}

impl SurfaceDetails {
    pub(super) const WANTED: ImageSet = ImageSet::of(&[Image::Sheet, Image::Leap, Image::Focus]);

    pub(super) fn of(pass: &CutSurfacePass) -> Result<Self> {
        let (settings, mut images) = (pass.settings, Images::default());
        for stage in Stage::of_cut_surface(settings, pass.wanted) {
            pass.run(stage, &mut images)?;
        }
        let Images { unfiltered_depth, depth, vessel, leap, sheet, focus, .. } = images;
        let depth = if depth.is_empty() { unfiltered_depth } else { depth };
        let lines = Lines { depth: &depth, vessel: &vessel, leap: &leap, value: &[] };
        let mut strength = lines.strength(&pass.work, settings, pass.surface.camera())?;
        for (strength, [surface, line, ..]) in strength.iter_mut().zip(&focus) {
            *strength *= surface * line;
        }
        let rim = focus.iter().map(|[_, _, _, rim]| *rim).collect();
        Ok(Self { sheet, leap, strength, rim })
    }
}
