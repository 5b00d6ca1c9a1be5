//! The far rim: darkens the farther side of a depth jump where its line has faded out, but no lumen or wall. A dark
//! line on both sides could be read as a flap.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::focus::{LINES, SHADE, Shares};
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::larger;
use crate::math::leaps::{DOWNWARDS, LEAPS, LUMEN, TO_THE_RIGHT, WALL};
use crate::settings::Settings;

/// Width of the rim (mm).
const WIDTH: f64 = 1.5;
/// Smallest width of the rim (pixels); a narrower rim would look like a hair.
const NARROWEST: f64 = 2.5;
/// Largest width of the rim (pixels), also in the closest view.
const WIDEST: f64 = 8.0;

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct FarRimParameters {
    /// Width of the rim (pixels).
    pub width: f32,
    /// How much the rim darkens at the jump, 0 to 1.
    pub strength: f32,
}

impl FarRimParameters {
    pub fn new(settings: &Settings, camera: &Camera) -> Self {
        let width = (WIDTH / camera.pixel_spacing()).clamp(NARROWEST, WIDEST);
        Self { width: width as f32, strength: settings.far_rim as f32 }
    }
}

/// Adds the rim to the shares by which pixels are darkened: at a jump `strength`, falling to 0 over the width of the
/// rim, times the share that its line lacks. Only pixels deeper than the middle of the jump are darkened.
pub fn far_rim(
    work: &Work,
    parameters: &FarRimParameters,
    leap: &[u32],
    depth: &[f32],
    shares: &mut [Shares],
) -> Result<()> {
    work.expect_whole(Image::Leap, leap);
    work.expect_whole(Image::Depth, depth);
    work.expect_whole(Image::Focus, shares);
    let width = work.size[0];
    let jumps = Jumps { leap, depth, width };
    let sources: Vec<Vec<Source>> =
        (0..work.size[1]).into_par_iter().map(|row| jumps.farther_sides(row)).collect();
    shares.par_chunks_mut(width).enumerate().try_for_each(|(row, shares)| {
        work.begin(width)?;
        let mut rim = vec![0f32; width];
        let reach = parameters.reach();
        let from = row.saturating_sub(reach);
        for (above, sources) in (from..).zip(&sources[from..(row + reach + 1).min(work.size[1])]) {
            for source in sources {
                let columns = source.column.saturating_sub(reach)..(source.column + reach + 1).min(width);
                for i in columns.filter(|i| depth[row * width + i] > source.middle) {
                    let apart = [i.abs_diff(source.column), row.abs_diff(above)].map(|n| n as f32);
                    rim[i] = larger(rim[i], parameters.at(apart));
                }
            }
        }
        for (i, share) in shares.iter_mut().enumerate().filter(|(i, _)| rim[*i] > 0.0) {
            if leap[row * width + i] & (LUMEN | WALL) == 0 && share[LINES] < 1.0 {
                let dark = parameters.strength * rim[i] * (1.0 - share[LINES]);
                share[SHADE] = 1.0 - (1.0 - share[SHADE]) * (1.0 - dark);
            }
        }
        Ok(())
    })
}

impl FarRimParameters {
    /// The largest distance (pixels) between a jump and its rim.
    pub fn reach(&self) -> usize {
        self.width.ceil() as usize
    }

    /// The rim at an offset from the jump (pixels): 1 at the jump, 0 from the width on.
    #[inline(always)]
    fn at(&self, [x, y]: [f32; 2]) -> f32 {
        larger(1.0 - (x * x + y * y).sqrt() / self.width, 0.0)
    }
}

/// A pixel on the farther side of a jump.
struct Source {
    column: usize,
    /// The depth in the middle of the jump (mm).
    middle: f32,
}

struct Jumps<'a> {
    leap: &'a [u32],
    depth: &'a [f32],
    width: usize,
}

impl Jumps<'_> {
    /// The farther sides of all jumps that lie in a row, outside lumens and walls.
    fn farther_sides(&self, row: usize) -> Vec<Source> {
        let mut sources = Vec::new();
        for i in 0..self.width {
            let here = row * self.width + i;
            let left = if i > 0 { self.leap[here - 1] & TO_THE_RIGHT } else { 0 };
            let above = if row > 0 { self.leap[here - self.width] & DOWNWARDS } else { 0 };
            if (self.leap[here] & LEAPS) | left | above == 0 {
                continue;
            }
            let next = [(here, TO_THE_RIGHT, 1), (here, DOWNWARDS, self.width)];
            let last = [(i > 0, TO_THE_RIGHT, 1), (row > 0, DOWNWARDS, self.width)];
            let last = last.into_iter().filter(|(is_inside, ..)| *is_inside);
            let before = last.map(|(_, bit, step)| (here - step, bit, here - step));
            let after = next.into_iter().map(|(owner, bit, step)| (owner, bit, here + step));
            for (owner, bit, other) in after.chain(before) {
                if self.leap[owner] & bit != 0
                    && self.leap[here] & (LUMEN | WALL) == 0
                    && self.depth[here] > self.depth[other]
                {
                    let middle = 0.5 * (self.depth[here] + self.depth[other]);
                    sources.push(Source { column: i, middle });
                }
            }
        }
        sources
    }
}
