//! Leaps: depth jumps between neighbouring pixels that do not belong to one surface, and the side of a leap
//! on which its line is drawn. Silhouettes use both.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth::Sheet;
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{FAN, Kernel, ROWS, dispatch, larger};
use crate::math::leaps::{DOWNWARDS, LINE_DOWNWARDS, LINE_TO_THE_RIGHT, LUMEN, TO_THE_RIGHT};

/// The smallest depth jump that counts as a leap (mm); it matters for vessels with a smaller diameter.
pub const SMALLEST_LEAP: f32 = 2.0;

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct LeapParameters {
    pub pixel_spacing: f32,
}

impl LeapParameters {
    pub fn new(camera: &Camera) -> Self {
        Self { pixel_spacing: camera.pixel_spacing() as f32 }
    }
}

/// Writes the leaps between neighbours. At a leap, the unfiltered depth differs from what the slope of either
/// side predicts by more than both the vessel's diameter and [`SMALLEST_LEAP`]; where a chosen vessel with
/// precedence ends, by more than [`SMALLEST_LEAP`]. Also writes which pixels show lumen, and the side of each
/// line: outside the lumen if only one side is lumen, otherwise on the farther side.
pub fn leap(
    work: &Work,
    parameters: &LeapParameters,
    depth: &[f32],
    sheet: &[Sheet],
    leap: &mut [u32],
) -> Result<()> {
    work.expect_whole(Image::UnfilteredDepth, depth);
    work.expect_whole(Image::Sheet, sheet);
    work.expect_whole(Image::Leap, leap);
    let (side, width) = (parameters.pixel_spacing, work.size[0]);
    leap.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, leap)| {
        work.begin(leap.len())?;
        let surface = Surface { depth, sheet, width };
        dispatch(work.isa, LeapRows { surface, first: row * ROWS, side, leap });
        Ok(())
    })
}

#[derive(Clone, Copy)]
struct Surface<'a> {
    depth: &'a [f32],
    sheet: &'a [Sheet],
    width: usize,
}

struct LeapRows<'a> {
    surface: Surface<'a>,
    first: usize,
    side: f32,
    leap: &'a mut [u32],
}

impl Kernel for LeapRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (surface, side) = (self.surface, self.side);
        let width = surface.width;
        let last_row = surface.depth.len() / width - 1;
        for (j, leap) in (self.first..).zip(self.leap.chunks_mut(width)) {
            for (n, leap) in leap.chunks_mut(FAN).enumerate() {
                let i = n * FAN;
                // Pixels of the last column have no neighbour to the right, those of the last row none below.
                let here = surface.strip(i, j);
                let down = here.leaps_to(&surface.strip(i, (j + 1).min(last_row)), [0.0, -side]);
                let right = here.leaps_to(&surface.strip(i + 1, j), [side, 0.0]);
                for (l, leap) in leap.iter_mut().enumerate() {
                    let lumen = if here.is_lumen[l] { LUMEN } else { 0 };
                    let down = if j < last_row { down[l] } else { 0 };
                    let right = if i + l + 1 < width { right[l] } else { 0 };
                    *leap = lumen
                        | down & (DOWNWARDS | LINE_DOWNWARDS)
                        | right & (TO_THE_RIGHT | LINE_TO_THE_RIGHT);
                }
            }
        }
    }
}

impl Surface<'_> {
    /// Sixteen pixels of row `j` from column `i` on; beyond the row its last pixel repeats.
    #[inline(always)]
    fn strip(&self, i: usize, j: usize) -> Strip {
        let row = j * self.width..(j + 1) * self.width;
        let (depth, sheet) = (&self.depth[row.clone()], &self.sheet[row]);
        let zero = [0.0; FAN];
        let mut strip = Strip {
            z: zero,
            slope: [zero; 2],
            threshold: zero,
            is_lumen: [false; FAN],
            is_first: [false; FAN],
        };
        if let (Some(depth), Some(sheet)) = (whole(depth, i), whole(sheet, i)) {
            strip.put(depth, sheet);
        } else {
            let pixel = |l: usize| (i + l).min(self.width - 1);
            let depth = std::array::from_fn(|l| depth[pixel(l)]);
            let sheet = std::array::from_fn(|l| sheet[pixel(l)]);
            strip.put(&depth, &sheet);
        }
        strip
    }
}

/// Sixteen entries of a row from column `i` on, unless the row ends before.
#[inline(always)]
fn whole<T>(row: &[T], i: usize) -> Option<&[T; FAN]> {
    row.get(i..).and_then(|rest| rest.first_chunk())
}

struct Strip {
    z: [f32; FAN],
    slope: [[f32; FAN]; 2],
    /// The smallest change that counts as a leap (mm).
    threshold: [f32; FAN],
    is_lumen: [bool; FAN],
    is_first: [bool; FAN],
}

impl Strip {
    #[inline(always)]
    fn put(&mut self, depth: &[f32; FAN], sheet: &[Sheet; FAN]) {
        self.z = *depth;
        for l in 0..FAN {
            let side = Side::new(depth[l], sheet[l]);
            [self.slope[0][l], self.slope[1][l]] = side.slope;
            self.threshold[l] = side.threshold;
            self.is_lumen[l] = side.is_lumen;
            self.is_first[l] = side.is_first;
        }
    }

    #[inline(always)]
    fn side(&self, l: usize) -> Side {
        Side {
            z: self.z[l],
            slope: [self.slope[0][l], self.slope[1][l]],
            threshold: self.threshold[l],
            is_lumen: self.is_lumen[l],
            is_first: self.is_first[l],
        }
    }

    /// Bits that mark depth jumps to the pixels of another strip, `step` away (view x and y, mm).
    #[inline(always)]
    fn leaps_to(&self, others: &Self, step: [f32; 2]) -> [u32; FAN] {
        let mut leaps = [0; FAN];
        for l in 0..FAN {
            leaps[l] = self.side(l).leap_to(&others.side(l), step);
        }
        leaps
    }
}

/// The cut surface on one side of a border between pixels; the fields are those of [`Strip`].
#[derive(Clone, Copy)]
pub(crate) struct Side {
    z: f32,
    slope: [f32; 2],
    threshold: f32,
    pub is_lumen: bool,
    is_first: bool,
}

impl Side {
    #[inline(always)]
    pub(crate) fn new(z: f32, [slope_x, slope_y, radius, gap]: Sheet) -> Self {
        Self {
            z,
            slope: [slope_x, slope_y],
            threshold: larger(2.0 * radius.abs(), SMALLEST_LEAP),
            is_lumen: radius > 0.0,
            is_first: gap < 0.0,
        }
    }

    /// Bits, for both directions, that mark a depth jump to another side, `step` away (view x and y, mm).
    #[inline(always)]
    pub(crate) fn leap_to(&self, other: &Self, step: [f32; 2]) -> u32 {
        let change = other.z - self.z;
        let ends_first = self.is_first != other.is_first;
        let is_leap = self.is_off(change, step, ends_first) & other.is_off(change, step, ends_first);
        let is_farther = (self.is_lumen == other.is_lumen) & (change > 0.0);
        let line_beyond = is_farther | (self.is_lumen & !other.is_lumen);
        let line = if line_beyond { LINE_TO_THE_RIGHT | LINE_DOWNWARDS } else { 0 };
        if is_leap { line | TO_THE_RIGHT | DOWNWARDS } else { 0 }
    }

    /// Whether a depth change differs too much from the change that the slope predicts. `ends_first` states
    /// whether a chosen vessel ends there.
    #[inline(always)]
    fn is_off(&self, change: f32, step: [f32; 2], ends_first: bool) -> bool {
        let expected = self.slope[0] * step[0] + self.slope[1] * step[1];
        (change - expected).abs() > if ends_first { SMALLEST_LEAP } else { self.threshold }
    }
}
