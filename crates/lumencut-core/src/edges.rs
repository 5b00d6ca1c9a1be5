//! Several samples in the pixels at and next to lines, which one sample per pixel draws like stairs.

use glam::DVec3;

use crate::error::Result;
use crate::frame::{Frame, Timing};
use crate::geometry::{Curved, Geometry};
use crate::math::lanes::{COLUMNS, PIXELS, ROWS};
use crate::math::leaps::{DOWNWARDS, LINE_DOWNWARDS, LINE_TO_THE_RIGHT, TO_THE_RIGHT};
use crate::pipeline::{Clock, CpuRenderer, CutSurfacePass, Images, Lines, Request};
use crate::scene::{LeveledTree, Scene, SharedVolume};
use crate::settings::{LevelChoice, Settings, SilhouetteRule, SlabMode};
use crate::stages::composite::{CompositeParameters, Layers, composite};
use crate::stages::depth::{PLACES_ACROSS, entry_of_place};
use crate::stages::focus::{LINES, SURFACE, Shares};
use crate::stages::leap::Side;
use crate::stages::silhouette::{SilhouetteParameters, silhouette_at};
use crate::stages::steady::SteadyParameters;
use crate::stages::surface::{SurfaceScene, surface};
use crate::stages::{Image, ImageSet, Stage, Work};

const NO_EDGE: u32 = u32::MAX;
/// Edge pixels are listed by squares of this side, so that the pixels of a tile are close together.
const SQUARE: usize = 8;

/// Colours of the pixels at and next to lines, at several positions within each pixel.
#[derive(Debug)]
pub struct EdgeSamples {
    /// The places of these pixels in the view.
    pub pixels: Vec<u32>,
    /// For each position, RGBA of these pixels.
    pub colors: Vec<Vec<[u8; 4]>>,
    /// The time of each stage.
    pub timings: Vec<Timing>,
}

impl EdgeSamples {
    /// The images of a frame that [`CpuRenderer::edge_samples`] reads.
    pub const READS: ImageSet =
        ImageSet::of(&[Image::Leap, Image::Focus, Image::Rim, Image::Value, Image::Context]);

    /// Whether a picture of this scene has lines at depth jumps.
    pub fn has_edges(scene: &Scene, settings: &Settings) -> bool {
        let has_lines = settings.silhouettes || !settings.focus_vessels.is_empty();
        let is_leap = settings.silhouette_rule == SilhouetteRule::Leap;
        has_lines && is_leap && scene.tree.is_some() && scene.volume.is_some()
    }
}

impl CpuRenderer {
    /// Samples the pixels at and next to the lines of a frame, which has the images [`EdgeSamples::READS`], at
    /// `offsets` from their middle (mm to the right and upwards). Context, shares and rim remain those of the middle,
    /// and the depth is not filtered. Fails as [`CpuRenderer::render`].
    pub fn edge_samples(
        &mut self,
        (tree, volume): (&LeveledTree, &SharedVolume),
        request: &Request,
        frame: &Frame,
        offsets: &[[f64; 2]],
    ) -> Result<EdgeSamples> {
        let settings = &*request.settings.for_vessels(tree.tree().vessels().len())?;
        let request = &Request { settings, progress: None, ..*request }.continued();
        let mut clock = Clock::start();
        self.prepare(tree, settings);
        self.project(request.camera, settings);
        clock.lap(Stage::Projection);
        let mut view = EdgeView { renderer: self, request, frame, pixels: Vec::new() };
        view.pixels = view.find_pixels()?;
        clock.lap(Stage::Silhouette);
        if view.pixels.is_empty() {
            return Ok(EdgeSamples { pixels: Vec::new(), colors: Vec::new(), timings: clock.timings });
        }
        let samples = view.samples(offsets)?;
        clock.lap(Stage::Depth);
        let values = view.values(volume, offsets, &samples)?;
        clock.lap(Stage::Surface);
        let mut leaps = EdgeLeaps::of(&view);
        let mut colors = Vec::new();
        for (samples, values) in samples.iter().zip(&values) {
            let strength = leaps.strength(&view, samples, values);
            clock.lap(Stage::Silhouette);
            colors.push(view.colors([values, &strength])?);
            clock.lap(Stage::Composite);
        }
        Ok(EdgeSamples { pixels: view.pixels, colors, timings: clock.timings })
    }
}

struct EdgeView<'a> {
    renderer: &'a CpuRenderer,
    request: &'a Request<'a>,
    frame: &'a Frame,
    /// The pixels at and next to lines.
    pixels: Vec<u32>,
}

impl EdgeView<'_> {
    fn work(&self, size: [usize; 2]) -> Work<'_> {
        Work { size, isa: self.renderer.isa, stop: self.request.stop, progress: None }
    }

    /// The pixels that lines cover in part, after reach and focus, and their neighbours.
    fn find_pixels(&self) -> Result<Vec<u32>> {
        let Request { settings, camera, .. } = *self.request;
        let size = camera.size();
        let lines = Lines { value: &self.frame.value, ..Lines::of(self.frame) };
        let strength = lines.strength(&self.work(size), settings, camera)?;
        let share =
            |pixel| self.frame.focus.get(pixel).map_or(1.0, |share: &Shares| share[SURFACE] * share[LINES]);
        let mut is_edge = vec![false; strength.len()];
        for (pixel, strength) in strength.iter().enumerate() {
            if *strength > 0.0 && share(pixel) > 0.0 {
                let [i, j] = [pixel % size[0], pixel / size[0]];
                for j in j.saturating_sub(1)..(j + 2).min(size[1]) {
                    is_edge[j * size[0]..][i.saturating_sub(1)..(i + 2).min(size[0])].fill(true);
                }
            }
        }
        Ok(by_squares(&is_edge, size))
    }

    /// The cut surface at all offsets, for one offset after the other.
    fn samples(&self, offsets: &[[f64; 2]]) -> Result<Vec<Vec<Sample>>> {
        let is_own = self.request.settings.level_choice == LevelChoice::Own;
        let stages = if is_own { &[Stage::Depth][..] } else { &[Stage::Distance, Stage::Depth] };
        let Images { unfiltered_depth: depth, vessel, sheet, foot, .. } =
            self.run(stages, &self.tiles(&self.pixels, offsets))?;
        let Request { settings, camera, before, .. } = *self.request;
        let held = before.and_then(|before| {
            Some((SteadyParameters::new(settings, camera, &before)?, before.seen_by(camera)))
        });
        let sample = |n: usize, k: usize| {
            let at = entry_of_place(k * offsets.len() + n);
            let shown = held.as_ref().map_or(depth[at], |(steady, before)| {
                steady.depth(depth[at], foot[at][1], before[self.pixels[k] as usize])
            });
            Sample { depth: shown, side: Side::new(depth[at], vessel[at], sheet[at]) }
        };
        let of_offset = |n| (0..self.pixels.len()).map(|k| sample(n, k)).collect();
        Ok((0..offsets.len()).map(of_offset).collect())
    }

    /// All offsets of a pixel, then those of the next; the last place repeats up to the end of a row of tiles.
    fn tiles(&self, pixels: &[u32], offsets: &[[f64; 2]]) -> Vec<[[f32; 2]; PIXELS]> {
        let camera = self.request.camera;
        let places = pixels.iter().flat_map(|pixel| {
            let [i, j] = place(*pixel, camera.size()[0]);
            let middle = [camera.view_x(i), camera.view_y(j)];
            offsets.iter().map(move |[x, y]| [(middle[0] + x) as f32, (middle[1] + y) as f32])
        });
        let places: Vec<[f32; 2]> = places.collect();
        let Some(last) = places.last() else { return Vec::new() };
        let count = places.len().div_ceil(PIXELS).next_multiple_of(PLACES_ACROSS);
        let tile = |tile| std::array::from_fn(|n| *places.get(tile * PIXELS + n).unwrap_or(last));
        (0..count).map(tile).collect()
    }

    /// Runs stages of the cut surface at places of the view.
    fn run(&self, stages: &[Stage], tiles: &[[[f32; 2]; PIXELS]]) -> Result<Images> {
        let mut images = Images::default();
        let pass = self.renderer.pass(self.request);
        let pass = CutSurfacePass {
            work: self.work([PLACES_ACROSS * COLUMNS, tiles.len() / PLACES_ACROSS * ROWS]),
            surface: pass.surface.at(tiles),
            has_sheet: true,
            wanted: ImageSet::of(if self.request.before.is_some() { &[Image::Before] } else { &[] }),
            settings: self.request.settings,
            colors: None,
            before: None,
        };
        for stage in stages {
            pass.run(*stage, &mut images)?;
        }
        Ok(images)
    }

    fn values(
        &self,
        volume: &SharedVolume,
        offsets: &[[f64; 2]],
        samples: &[Vec<Sample>],
    ) -> Result<Vec<Vec<f32>>> {
        let (camera, slab) = (self.request.camera, self.request.settings.slab);
        let searches = slab.filter(|slab| slab.mode != SlabMode::Mean);
        let blocks = searches.map(|_| volume.blocks(self.request.stop)).transpose()?;
        let mut values = Vec::new();
        for ([x, y], samples) in offsets.iter().zip(samples) {
            let positions = self.pixels.iter().zip(samples).map(|(pixel, sample)| {
                let [i, j] = place(*pixel, camera.size()[0]);
                let place = DVec3::new(camera.view_x(i) + x, camera.view_y(j) + y, sample.depth.into());
                camera.world_from_view(place)
            });
            let work = self.work([self.pixels.len(), 1]);
            let along = vec![camera.direction().as_vec3(); self.pixels.len()];
            let geometry = Geometry::Curved(Curved::new(work.size, positions.collect(), along)?);
            let scene = SurfaceScene { geometry: &geometry, volume: &volume.volume, blocks, slab };
            let mut value = vec![0.0; self.pixels.len()];
            surface(&work, &scene, &mut value)?;
            values.push(value);
        }
        Ok(values)
    }

    fn colors(&self, [value, strength]: [&[f32]; 2]) -> Result<Vec<[u8; 4]>> {
        let Frame { focus, rim, context, .. } = self.frame;
        let pixels = || self.pixels.iter().map(|pixel| *pixel as usize);
        let rim: Vec<_> = pixels().filter_map(|pixel| rim.get(pixel).copied()).collect();
        let focus: Vec<_> = pixels().filter_map(|pixel| focus.get(pixel).copied()).collect();
        let context: Vec<_> =
            pixels().filter_map(|pixel| context.get(pixel).copied().map(premultiplied)).collect();
        let layers = Layers {
            value,
            strength: Some(strength),
            rim: Some(&rim[..]).filter(|rim| !rim.is_empty()),
            focus: Some(&focus[..]).filter(|focus| !focus.is_empty()),
            context: Some(&context[..]).filter(|context| !context.is_empty()),
        };
        let mut colors = vec![[0; 4]; self.pixels.len()];
        let work = self.work([self.pixels.len(), 1]);
        composite(&work, &CompositeParameters::new(self.request.settings), &layers, &mut colors)?;
        Ok(colors)
    }
}

struct Sample {
    depth: f32,
    side: Side,
}

/// The depth jumps of the frame, with those of one sample in each edge pixel.
struct EdgeLeaps {
    leap: Vec<u32>,
    value: Vec<f32>,
    /// The place of each pixel in the list of edge pixels, or [`NO_EDGE`].
    edge: Vec<u32>,
}

impl EdgeLeaps {
    fn of(view: &EdgeView) -> Self {
        let Frame { leap, value, .. } = view.frame;
        let mut edge = vec![NO_EDGE; leap.len()];
        for (n, pixel) in (0..).zip(&view.pixels) {
            edge[*pixel as usize] = n;
        }
        Self { leap: leap.clone(), value: value.clone(), edge }
    }

    /// The strength of the lines at one sample of each edge pixel.
    fn strength(&mut self, view: &EdgeView, samples: &[Sample], values: &[f32]) -> Vec<f32> {
        let Request { settings, camera, .. } = *view.request;
        let (size, side) = (camera.size(), camera.pixel_spacing() as f32);
        for ((pixel, sample), value) in view.pixels.iter().zip(samples).zip(values) {
            let ([i, j], at) = (place(*pixel, size[0]), *pixel as usize);
            let mut bits = sample.side.shown();
            if i + 1 < size[0] {
                bits |= self.leap_to(samples, [at, at + 1], [side, 0.0]) & (TO_THE_RIGHT | LINE_TO_THE_RIGHT);
            }
            if j + 1 < size[1] {
                bits |=
                    self.leap_to(samples, [at, at + size[0]], [0.0, -side]) & (DOWNWARDS | LINE_DOWNWARDS);
            }
            (self.leap[at], self.value[at]) = (bits, *value);
        }
        let mut strength = vec![0.0; view.pixels.len()];
        let parameters = SilhouetteParameters::new(settings, camera);
        silhouette_at(size[0], &parameters, [&self.leap, &view.pixels], &self.value, &mut strength);
        strength
    }

    /// The bits of the jump to the next pixel; those of the frame if that is no edge pixel.
    fn leap_to(&self, samples: &[Sample], [here, next]: [usize; 2], step: [f32; 2]) -> u32 {
        match [here, next].map(|pixel| self.edge[pixel]) {
            [_, NO_EDGE] => self.leap[here],
            pair => {
                let [here, next] = pair.map(|n| &samples[n as usize].side);
                here.leap_to(next, step)
            }
        }
    }
}

fn place(pixel: u32, width: usize) -> [usize; 2] {
    [pixel as usize % width, pixel as usize / width]
}

/// The marked pixels, one square of the view after the other.
fn by_squares(is_marked: &[bool], [width, height]: [usize; 2]) -> Vec<u32> {
    let mut pixels = Vec::new();
    for top in (0..height).step_by(SQUARE) {
        for left in (0..width).step_by(SQUARE) {
            for j in top..(top + SQUARE).min(height) {
                let row = j * width + left..j * width + (left + SQUARE).min(width);
                pixels.extend(row.filter(|pixel| is_marked[*pixel]).map(|pixel| pixel as u32));
            }
        }
    }
    pixels
}

fn premultiplied([red, green, blue, alpha]: [u8; 4]) -> [f32; 4] {
    let alpha = f32::from(alpha) / 255.0;
    let [red, green, blue] = [red, green, blue].map(|color| f32::from(color) / 255.0 * alpha);
    [red, green, blue, alpha]
}
