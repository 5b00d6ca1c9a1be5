//! Leaps: neighbours whose depths do not belong to one surface. They are decided once, here; silhouettes follow them.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth::Sheet;
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{Kernel, ROWS, dispatch, larger};
use crate::math::leaps::{DOWNWARDS, TO_THE_RIGHT};

/// The smallest leap (mm), for vessels whose diameter is smaller.
pub const SMALLEST_LEAP: f32 = 2.0;

/// The parameters of the stage.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct LeapParameters {
    /// The side of a pixel (mm).
    pub pixel_spacing: f32,
}

impl LeapParameters {
    /// The parameters of a view.
    pub fn new(camera: &Camera) -> Self {
        Self { pixel_spacing: camera.pixel_spacing() as f32 }
    }
}

/// Writes between which neighbours the depth (mm, before its filter) leaps: where it differs by more than the diameter of
/// the vessel, and by more than [`SMALLEST_LEAP`], from what the slope of either side alone would make it.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
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
        work.go_on()?;
        dispatch(work.isa, LeapRows { depth, sheet, width, first: row * ROWS, side, leap });
        Ok(())
    })
}

struct LeapRows<'a> {
    depth: &'a [f32],
    sheet: &'a [Sheet],
    width: usize,
    first: usize,
    side: f32,
    leap: &'a mut [u32],
}

impl Kernel for LeapRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (width, side) = (self.width, self.side);
        for (j, leap) in (self.first..).zip(self.leap.chunks_mut(width)) {
            let row = |j: usize| {
                let start = j * width;
                (&self.depth[start..start + width], &self.sheet[start..start + width])
            };
            // The last row and the last column have no neighbour, and so no leap.
            let last_row = self.depth.len() / width - 1;
            let ((z, sheet), (z_below, sheet_below)) = (row(j), row((j + 1).min(last_row)));
            let has_below = j < last_row;
            for (i, leap) in leap.iter_mut().enumerate() {
                let down = has_below & leaps(z[i], &sheet[i], z_below[i], &sheet_below[i], [0.0, -side]);
                *leap = if down { DOWNWARDS } else { 0 };
            }
            for (i, leap) in leap.iter_mut().enumerate().take(width - 1) {
                let right = leaps(z[i], &sheet[i], z[i + 1], &sheet[i + 1], [side, 0.0]);
                *leap |= if right { TO_THE_RIGHT } else { 0 };
            }
        }
    }
}

/// Whether the depth leaps from one pixel to another, which lies `step` (view x and y, mm) from it.
#[inline(always)]
fn leaps(from: f32, here: &Sheet, to: f32, there: &Sheet, step: [f32; 2]) -> bool {
    let change = to - from;
    let off = |sheet: &Sheet| {
        let expected = sheet[0] * step[0] + sheet[1] * step[1];
        (change - expected).abs() > larger(2.0 * sheet[2], SMALLEST_LEAP)
    };
    off(here) & off(there)
}
