//! The context: rays through the volume behind the cut surface (paper section 3.3.6).

use rayon::prelude::*;

use super::View;
use crate::error::{Error, ErrorKind, Result};
use crate::math::accumulate::{Accumulator, Average, Blend, Brightest, Darkest, Palette};
use crate::math::blocks::Blocks;
use crate::math::lanes::{FAN, Kernel, ROWS, dispatch};
use crate::math::light::Shading;
use crate::math::ray::{MOST_SAMPLES, NONE, PACKET, Packet, Rays, WHOLE};
use crate::math::sampling::{Sampler, TypedSampler};
use crate::math::trace::{Scene, Walker, trace};
use crate::math::transfer::Colors;
use crate::math::window::Ramp;
use crate::settings::{Context, ContextMode, Settings};
use crate::volume::Volume;
use crate::with_voxels;

/// Where the ray of each pixel starts: nowhere behind an opaque cut surface, behind a transparent one, and in front of
/// the volume where the cut surface is outside.
pub fn starts(value: &[f32], depth: &[f32], settings: &Settings) -> Vec<f32> {
    let opacity = Ramp::opacity(settings.opacity);
    let behind = settings.slab.map_or(0.0, |slab| slab.thickness / 2.0) as f32;
    let start = |(value, depth): (&f32, &f32)| match *value {
        value if value.is_nan() => WHOLE,
        value if opacity.at(value) < 1.0 => depth + behind,
        _ => NONE,
    };
    value.par_iter().zip(depth).map(start).collect()
}

/// Writes what the rays gather, colours times opacity and opacity, 0 to 1; nothing where no ray starts.
///
/// # Errors
/// [`ErrorKind::Settings`] for a step so small that rays would have more than 65,536 samples,
/// [`ErrorKind::Interrupted`].
pub fn context(
    view: &View,
    volume: &Volume,
    blocks: Option<&Blocks>,
    settings: &Context,
    start: &[f32],
    pixels: &mut [[f32; 4]],
) -> Result<()> {
    let plan = Plan::new(view, volume, blocks, settings)?;
    if !settings.preview {
        return plan.trace(&Raster::fine(view), start, pixels);
    }
    let raster = Raster::coarse(view);
    let [columns, rows] = raster.size;
    let mut coarse = vec![[0.0; 4]; columns * rows];
    plan.trace(&raster, &coarse_starts(start, view.size()), &mut coarse)?;
    spread(&coarse, start, view.size(), pixels);
    Ok(())
}

/// Where rays run: the pixels of the view, or squares of four of them.
#[derive(Clone, Copy)]
struct Raster {
    size: [usize; 2],
    /// View x and y of the first ray, and from one to the next (mm).
    first: [f64; 2],
    next: [f64; 2],
}

impl Raster {
    fn fine(view: &View) -> Self {
        let (camera, s) = (view.camera, view.camera.pixel_spacing());
        Self { size: view.size(), first: [camera.view_x(0), camera.view_y(0)], next: [s, -s] }
    }

    fn coarse(view: &View) -> Self {
        let fine = Self::fine(view);
        let first = std::array::from_fn(|a| fine.first[a] + fine.next[a] / 2.0);
        Self { size: fine.size.map(|n| n.div_ceil(2)), first, next: fine.next.map(|s| 2.0 * s) }
    }
}

/// The start of each square of four pixels: the nearest behind a cut surface, so that none of them shows what lies before
/// its own; else in front of the volume, where one of them starts there.
fn coarse_starts(start: &[f32], [width, height]: [usize; 2]) -> Vec<f32> {
    // Later than behind every cut surface, sooner than nowhere.
    const IN_FRONT: f32 = NONE / 2.0;
    let (columns, rows) = (width.div_ceil(2), height.div_ceil(2));
    let mut coarse = vec![NONE; columns * rows];
    for (j, row) in start.chunks(width).enumerate() {
        for (i, start) in row.iter().enumerate() {
            let square = &mut coarse[j / 2 * columns + i / 2];
            *square = square.min(if *start <= WHOLE { IN_FRONT } else { *start });
        }
    }
    coarse.into_iter().map(|start| if (IN_FRONT..NONE).contains(&start) { WHOLE } else { start }).collect()
}

/// Gives each pixel that needs a ray what its square's ray found.
fn spread(coarse: &[[f32; 4]], start: &[f32], [width, _]: [usize; 2], pixels: &mut [[f32; 4]]) {
    let columns = width.div_ceil(2);
    let rows = pixels.chunks_mut(width).zip(start.chunks(width));
    for (j, (pixels, start)) in rows.enumerate() {
        for (i, (pixel, start)) in pixels.iter_mut().zip(start).enumerate() {
            *pixel = if *start >= NONE { [0.0; 4] } else { coarse[j / 2 * columns + i / 2] };
        }
    }
}

/// A number of four digits that is no smaller.
fn rounded_up(number: f64) -> f64 {
    let scale = 10f64.powf(3.0 - number.log10().floor());
    (number * scale).ceil() / scale
}

/// The step where the settings name none. Along an axis of the volume a voxel's side meets every voxel's centre, which
/// maximum, minimum and average want; colours and opacities that rise within a voxel want more.
fn default_step(volume: &Volume, settings: &Context) -> f64 {
    let blended = matches!(settings.mode, ContextMode::Blend { gamma } if gamma < 1.0);
    volume.smallest_side() * if blended && !settings.preview { 0.5 } else { 1.0 }
}

/// The longest distance between samples (mm).
///
/// # Errors
/// [`ErrorKind::Settings`] for one so small that rays would have more than 65,536 samples.
pub fn step(volume: &Volume, settings: &Context) -> Result<f64> {
    let longest = volume.longest_way();
    let step = settings.step.unwrap_or_else(|| default_step(volume, settings).max(longest / MOST_SAMPLES));
    if longest > MOST_SAMPLES * step {
        let found = format!("{step} mm for a volume {longest:.4} mm across");
        let expected = format!("at least {} mm", rounded_up(longest / MOST_SAMPLES));
        return Err(Error::new(ErrorKind::Settings, "context_step", found, expected));
    }
    Ok(step)
}

/// All that the rays of a view need, prepared once.
struct Plan<'a> {
    view: &'a View<'a>,
    volume: &'a Volume<'a>,
    blocks: Option<&'a Blocks>,
    rays: Rays,
    mode: ContextMode,
    palette: Palette,
    shading: Option<Shading>,
}

impl<'a> Plan<'a> {
    fn new(
        view: &'a View,
        volume: &'a Volume,
        blocks: Option<&'a Blocks>,
        settings: &Context,
    ) -> Result<Self> {
        let step = step(volume, settings)?;
        let gamma = match settings.mode {
            ContextMode::Blend { gamma } => gamma as f32,
            _ => 0.0,
        };
        Ok(Self {
            view,
            volume,
            blocks,
            rays: Rays::new(volume, view.camera, step),
            mode: settings.mode,
            palette: Palette {
                colors: Colors::new(&settings.transfer),
                window: Ramp::grey(settings.window),
                gamma,
            },
            shading: settings.shading.then(|| Shading::new(settings.window)),
        })
    }

    /// Traces the rays of a raster.
    fn trace(&self, raster: &Raster, start: &[f32], pixels: &mut [[f32; 4]]) -> Result<()> {
        let (grid, isa) = (self.rays.grid, self.view.isa);
        with_voxels!(self.volume.voxels(), voxels => {
            self.trace_tiles(&TypedSampler { grid, voxels, isa }, raster, start, pixels)
        })
    }

    /// Traces the rays of a raster, tile by tile.
    fn trace_tiles(
        &self,
        sampler: &dyn Sampler,
        raster: &Raster,
        start: &[f32],
        pixels: &mut [[f32; 4]],
    ) -> Result<()> {
        let width = raster.size[0];
        let rows = pixels.par_chunks_mut(ROWS * width).zip(start.par_chunks(ROWS * width));
        rows.enumerate().try_for_each(|(row, (pixels, start))| {
            for column in (0..width).step_by(TILE[0]) {
                self.view.go_on()?;
                let place = [column, row * ROWS];
                let tile = Tile { plan: self, sampler, raster, place, start, pixels: &mut *pixels };
                dispatch(self.view.isa, tile);
            }
            Ok(())
        })
    }
}

/// The size of a tile of rays (pixels).
const TILE: [usize; 2] = [32, ROWS];
/// The packets side by side in a tile.
const ACROSS: usize = TILE[0] / PACKET[0];

/// A tile of rays in the rows that it lies in.
struct Tile<'a> {
    plan: &'a Plan<'a>,
    sampler: &'a dyn Sampler,
    raster: &'a Raster,
    /// The column and the row of its first ray.
    place: [usize; 2],
    start: &'a [f32],
    pixels: &'a mut [[f32; 4]],
}

impl Kernel for Tile<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        match self.plan.mode {
            ContextMode::Blend { gamma } if gamma >= 1.0 => self.walk::<Brightest>(),
            ContextMode::Blend { .. } => self.walk::<Blend>(),
            ContextMode::Minimum => self.walk::<Darkest>(),
            ContextMode::Average => self.walk::<Average>(),
        }
    }
}

impl<'a> Tile<'a> {
    /// Traces all rays of the tile.
    #[inline(always)]
    fn walk<A: Accumulator<'a>>(self) {
        let plan = self.plan;
        let mut walkers: Vec<Walker<A>> = Vec::with_capacity(TILE[0] * TILE[1] / FAN);
        for n in 0..TILE[0] * TILE[1] / FAN {
            let packet = self.packet(n);
            let active = packet.count.map(|count| count > 0);
            walkers.push(Walker::new(packet, A::new(&plan.palette, &active)));
        }
        let Plan { rays, blocks, shading, .. } = plan;
        trace(&Scene { rays, sampler: self.sampler, blocks: *blocks, shading: *shading }, &mut walkers);
        for (n, walker) in walkers.iter().enumerate() {
            let gathered = walker.finish();
            for l in 0..FAN {
                if let Some(pixel) = self.pixel(n, l) {
                    self.pixels[pixel] = gathered.map(|channel| channel[l]);
                }
            }
        }
    }

    /// The column of a ray, and its row counted from the first of these rows.
    #[inline(always)]
    fn ray(&self, packet: usize, lane: usize) -> [usize; 2] {
        let column = self.place[0] + packet % ACROSS * PACKET[0] + lane % PACKET[0];
        [column, packet / ACROSS * PACKET[1] + lane / PACKET[0]]
    }

    /// Where a ray's pixel is in these rows; `None` beyond the image.
    #[inline(always)]
    fn pixel(&self, packet: usize, lane: usize) -> Option<usize> {
        let ([i, j], width) = (self.ray(packet, lane), self.raster.size[0]);
        (i < width && j * width < self.pixels.len()).then_some(j * width + i)
    }

    /// The rays of one packet; those beyond the image see nothing.
    #[inline(always)]
    fn packet(&self, n: usize) -> Packet {
        let (mut x, mut y, mut start) = ([0.0; FAN], [0.0; FAN], [NONE; FAN]);
        for l in 0..FAN {
            let [i, j] = self.ray(n, l);
            x[l] = self.raster.first[0] + i as f64 * self.raster.next[0];
            y[l] = self.raster.first[1] + (self.place[1] + j) as f64 * self.raster.next[1];
            if let Some(pixel) = self.pixel(n, l) {
                start[l] = self.start[pixel];
            }
        }
        Packet::new(&self.plan.rays, &x, &y, &start)
    }
}
