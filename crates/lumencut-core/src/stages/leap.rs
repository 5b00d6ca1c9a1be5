//! Leaps: depth jumps between neighbouring pixels that do not belong to one surface, and the side of a leap
//! on which its line is drawn. Silhouettes use both.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth::{Sheet, WALL_GAP, is_chosen};
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{FAN, Kernel, ROWS, dispatch, larger, smaller};
use crate::math::leaps::{DOWNWARDS, LINE_DOWNWARDS, LINE_TO_THE_RIGHT, LUMEN, TO_THE_RIGHT, WALL};

/// The smallest depth jump that counts as a leap (mm); it matters for vessels with a smaller diameter.
pub const SMALLEST_LEAP: f32 = 2.0;
/// A vessel runs along the view between two points if their distance in depth exceeds this share of that along it.
pub const ALONG_VIEW: f32 = 0.9;
/// A larger depth jump (diameters) is a leap even where the vessel runs along the view.
pub const MOST_DIAMETERS: f32 = 2.0;

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
/// precedence ends, by more than [`SMALLEST_LEAP`]. Folds of one lumen that runs along the view between both sides
/// are no leaps ([`ALONG_VIEW`], [`MOST_DIAMETERS`]). Also writes which pixels show lumen, and the side of each
/// line: outside the lumen if only one side is lumen, otherwise on the farther side.
pub fn leap(
    work: &Work,
    parameters: &LeapParameters,
    (depth, vessel): (&[f32], &[i32]),
    sheet: &[Sheet],
    leap: &mut [u32],
) -> Result<()> {
    work.expect_whole(Image::UnfilteredDepth, depth);
    work.expect_whole(Image::Vessel, vessel);
    work.expect_whole(Image::Sheet, sheet);
    work.expect_whole(Image::Leap, leap);
    let (side, width) = (parameters.pixel_spacing, work.size[0]);
    leap.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, leap)| {
        work.begin(leap.len())?;
        let surface = Surface { depth, vessel, sheet, width };
        dispatch(work.isa, LeapRows { surface, first: row * ROWS, side, leap });
        Ok(())
    })
}

#[derive(Clone, Copy)]
struct Surface<'a> {
    depth: &'a [f32],
    vessel: &'a [i32],
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
                    let down = if j < last_row { down[l] } else { 0 };
                    let right = if i + l + 1 < width { right[l] } else { 0 };
                    *leap = here.side(l).shown()
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
        let (depth, vessel) = (&self.depth[row.clone()], &self.vessel[row.clone()]);
        let sheet = &self.sheet[row];
        let mut strip = Strip::EMPTY;
        if let (Some(depth), Some(vessel), Some(sheet)) = (whole(depth, i), whole(vessel, i), whole(sheet, i))
        {
            strip.put(depth, vessel, sheet);
        } else {
            let pixel = |l: usize| (i + l).min(self.width - 1);
            let depth = std::array::from_fn(|l| depth[pixel(l)]);
            let vessel = std::array::from_fn(|l| vessel[pixel(l)]);
            let sheet = std::array::from_fn(|l| sheet[pixel(l)]);
            strip.put(&depth, &vessel, &sheet);
        }
        strip
    }
}

/// Sixteen entries of a row from column `i` on, unless the row ends before.
#[inline(always)]
fn whole<T>(row: &[T], i: usize) -> Option<&[T; FAN]> {
    row.get(i..).and_then(|rest| rest.first_chunk())
}

/// The fields of [`Side`] for sixteen pixels.
struct Strip {
    z: [f32; FAN],
    slope: [[f32; FAN]; 2],
    diameter: [f32; FAN],
    vessel: [i32; FAN],
    along: [f32; FAN],
    is_lumen: [bool; FAN],
    is_wall: [bool; FAN],
    is_first: [bool; FAN],
}

impl Strip {
    const EMPTY: Self = Self {
        z: [0.0; FAN],
        slope: [[0.0; FAN]; 2],
        diameter: [0.0; FAN],
        vessel: [0; FAN],
        along: [0.0; FAN],
        is_lumen: [false; FAN],
        is_wall: [false; FAN],
        is_first: [false; FAN],
    };

    #[inline(always)]
    fn put(&mut self, depth: &[f32; FAN], vessel: &[i32; FAN], sheet: &[Sheet; FAN]) {
        (self.z, self.vessel) = (*depth, *vessel);
        for l in 0..FAN {
            let side = Side::new(depth[l], vessel[l], sheet[l]);
            [self.slope[0][l], self.slope[1][l]] = side.slope;
            (self.diameter[l], self.along[l]) = (side.diameter, side.along);
            (self.is_lumen[l], self.is_wall[l], self.is_first[l]) =
                (side.is_lumen, side.is_wall, side.is_first);
        }
    }

    #[inline(always)]
    fn side(&self, l: usize) -> Side {
        Side {
            z: self.z[l],
            slope: [self.slope[0][l], self.slope[1][l]],
            diameter: self.diameter[l],
            vessel: self.vessel[l],
            along: self.along[l],
            is_lumen: self.is_lumen[l],
            is_wall: self.is_wall[l],
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

/// The cut surface on one side of a border between pixels.
#[derive(Clone, Copy)]
pub(crate) struct Side {
    /// Depth (mm).
    z: f32,
    /// Change of depth to the right and upwards (mm per mm).
    slope: [f32; 2],
    /// Of the lumen (mm).
    diameter: f32,
    vessel: i32,
    /// Position along the vessel (mm), minus [`WALL_GAP`]; arbitrary outside lumen and wall.
    along: f32,
    is_lumen: bool,
    is_wall: bool,
    is_first: bool,
}

impl Side {
    #[inline(always)]
    pub(crate) fn new(z: f32, vessel: i32, [slope_x, slope_y, radius, gap]: Sheet) -> Self {
        Self {
            z,
            slope: [slope_x, slope_y],
            diameter: 2.0 * radius.abs(),
            vessel,
            along: -gap,
            is_lumen: radius > 0.0,
            is_wall: gap < 0.0,
            is_first: is_chosen(gap),
        }
    }

    /// The bit of what this side shows.
    #[inline(always)]
    pub(crate) fn shown(&self) -> u32 {
        let outside = if self.is_wall { WALL } else { 0 };
        if self.is_lumen { LUMEN } else { outside }
    }

    /// Bits, for both directions, that mark a depth jump to another side, `step` away (view x and y, mm).
    #[inline(always)]
    pub(crate) fn leap_to(&self, other: &Self, step: [f32; 2]) -> u32 {
        let change = other.z - self.z;
        let ends_first = self.is_first != other.is_first;
        let is_leap = self.is_off(change, step, ends_first) & other.is_off(change, step, ends_first);
        let is_leap = is_leap & !self.is_fold(other, change.abs());
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
        let least = if ends_first { SMALLEST_LEAP } else { larger(self.diameter, SMALLEST_LEAP) };
        (change - expected).abs() > least
    }

    /// Whether both sides show one lumen that runs along the view between them, `apart` deep (mm).
    #[inline(always)]
    fn is_fold(&self, other: &Self, apart: f32) -> bool {
        let has_places = (self.along >= -WALL_GAP) & (other.along >= -WALL_GAP);
        let is_one = self.is_lumen & other.is_lumen & (self.vessel == other.vessel) & has_places;
        let most = MOST_DIAMETERS * smaller(self.diameter, other.diameter);
        is_one & (apart <= most) & (apart > ALONG_VIEW * (self.along - other.along).abs())
    }
}
