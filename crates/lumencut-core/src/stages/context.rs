//! The context: rays through the volume behind the cut surface (paper section 3.3.6). In a preview, one ray serves
//! a square of pixels.

mod plan;
mod reduced;
mod tile;

use rayon::prelude::*;

use self::plan::Plan;
pub use self::plan::{Surroundings, step};
use self::reduced::reduce_raster;
use self::tile::trace_raster;
use super::focus::Shares;
use super::{Image, Work};
use crate::error::Result;
use crate::math::context_parameters::{Gathering, StartParameters};
use crate::math::ray::{NONE, WHOLE};
use crate::math::ray_lines::{PREVIEW_SIDE, RayGrid};
use crate::settings::{Context, Settings};

#[derive(Clone, Copy, Debug)]
pub struct SurfaceImages<'a> {
    /// The value of the volume at the cut surface; NaN if the surface shows nothing.
    pub value: &'a [f32],
    pub depth: &'a [f32],
    /// Shares of the cut surface and its silhouettes that are shown; `None` if both are fully shown.
    pub focus: Option<&'a [Shares]>,
}

/// Writes where each pixel's ray starts: nowhere if the cut surface is opaque, behind it if it is
/// transparent, in front of the volume if it shows nothing. Around a focus, `parameters` decide.
pub fn starts(work: &Work, parameters: &StartParameters, surface: &SurfaceImages, start: &mut [f32]) {
    let &SurfaceImages { value, depth, focus } = surface;
    work.expect_whole(Image::Value, value);
    work.expect_whole(Image::Depth, depth);
    work.expect_whole(Image::Start, start);
    let StartParameters { opacity, behind, from_cut } = parameters;
    let start_of = |value: f32, depth: f32, share: f32| match value {
        value if value.is_nan() => WHOLE,
        _ if share < 1.0 && !from_cut => WHOLE,
        value if opacity.at(value) * share < 1.0 => depth + behind,
        _ => NONE,
    };
    let places = start.par_iter_mut().zip(value.par_iter().zip(depth));
    match focus {
        None => places.for_each(|(start, (value, depth))| *start = start_of(*value, *depth, 1.0)),
        Some(focus) => {
            work.expect_whole(Image::Focus, focus);
            places
                .zip(focus)
                .for_each(|((start, (value, depth)), [share, ..])| *start = start_of(*value, *depth, *share));
        }
    }
}

/// Writes premultiplied colours and opacity, 0 to 1, of the rays of `context`; 0 where no ray starts. Fails
/// with `Settings` for rays of more than 65,536 samples.
pub fn context(
    work: &Work,
    surroundings: &Surroundings,
    settings: &Settings,
    context: &Context,
    start: &[f32],
    pixels: &mut [[f32; 4]],
) -> Result<()> {
    work.expect_whole(Image::Start, start);
    work.expect_whole(Image::Gathered, pixels);
    let reduction = Gathering::of(context.mode).reduction();
    let gather = |rays: &RayGrid, start: &[f32], pixels: &mut [[f32; 4]]| match reduction {
        None => trace_raster(work, &Plan::new(surroundings, settings, context)?, rays, start, pixels),
        Some(reduction) => reduce_raster(work, surroundings, (context, reduction), rays, start, pixels),
    };
    let camera = surroundings.camera;
    if !context.preview {
        return gather(&RayGrid::fine(camera), start, pixels);
    }
    let rays = RayGrid::coarse(camera);
    let starts = coarse_starts(start, work.size);
    let mut colors = vec![[0.0; 4]; starts.len()];
    gather(&rays, &starts, &mut colors)?;
    Squares { size: rays.size, colors: &colors, starts: &starts }.spread(start, work.size[0], pixels);
    Ok(())
}

/// Stands for a start in front of the volume: larger than starts at cut surfaces, smaller than `NONE`.
pub const IN_FRONT: f32 = NONE / 2.0;

/// The start of the ray of each square of a preview: the nearest start behind a cut surface. Only if there
/// is none, it is in front of the volume; else the ray would show what lies before the surface.
fn coarse_starts(start: &[f32], [width, height]: [usize; 2]) -> Vec<f32> {
    let [columns, rows] = RayGrid::squares([width, height]);
    let mut coarse = vec![NONE; columns * rows];
    for (j, row) in start.chunks(width).enumerate() {
        for (i, start) in row.iter().enumerate() {
            let square = &mut coarse[j / PREVIEW_SIDE * columns + i / PREVIEW_SIDE];
            *square = square.min(if *start <= WHOLE { IN_FRONT } else { *start });
        }
    }
    coarse.into_iter().map(|start| if (IN_FRONT..NONE).contains(&start) { WHOLE } else { start }).collect()
}

/// The squares of a preview: the colour of each ray, and where it starts.
struct Squares<'a> {
    size: [usize; 2],
    colors: &'a [[f32; 4]],
    starts: &'a [f32],
}

impl Squares<'_> {
    fn spread(&self, start: &[f32], width: usize, pixels: &mut [[f32; 4]]) {
        let rows = pixels.par_chunks_mut(width).zip(start.par_chunks(width));
        rows.enumerate().for_each(|(j, (pixels, start))| {
            for (i, (pixel, start)) in pixels.iter_mut().zip(start).enumerate() {
                *pixel = if *start >= NONE { [0.0; 4] } else { self.blended([i, j], *start) };
            }
        });
    }

    /// Blends the four squares around a pixel. Those count whose rays start in front of the volume, or behind the cut
    /// surface, as the ray of the pixel does; if there is none, the pixel shows its own square.
    fn blended(&self, pixel: [usize; 2], own: f32) -> [f32; 4] {
        let places = pixel.map(|n| (n as f32 + 0.5) / PREVIEW_SIDE as f32 - 0.5);
        let low = places.map(f32::floor);
        let (mut sum, mut all) = ([0.0; 4], 0.0);
        for corner in 0..4 {
            let steps = [corner % 2, corner / 2];
            let [column, row] = std::array::from_fn(|a| {
                (low[a] as isize + steps[a]).clamp(0, self.size[a] as isize - 1) as usize
            });
            let square = row * self.size[0] + column;
            let start = self.starts[square];
            if start < NONE && (start <= WHOLE) == (own <= WHOLE) {
                let part = |a: usize| places[a] - low[a];
                let [across, down] =
                    std::array::from_fn(|a| if steps[a] == 1 { part(a) } else { 1.0 - part(a) });
                let weight = across * down;
                sum = std::array::from_fn(|c| sum[c] + weight * self.colors[square][c]);
                all += weight;
            }
        }
        if all > 0.0 {
            return sum.map(|sum| sum / all);
        }
        self.colors[pixel[1] / PREVIEW_SIDE * self.size[0] + pixel[0] / PREVIEW_SIDE]
    }
}
