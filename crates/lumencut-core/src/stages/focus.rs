//! The focus: how much of the cut surface each pixel shows, by its distance from the nearest wall of any vessel. After the
//! VesselGlyph of Straka et al. 2004.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth::CutSurface;
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{COLUMNS, FAR, Kernel, PIXELS, ROWS, dispatch, larger, smaller};
use crate::math::tile::{Tile, scatter};
use crate::math::walls::{WallRange, nearest_walls};
use crate::settings::Focus;

/// What a hard edge takes for 1 / fade (per mm): beyond all distances that rounding tells apart.
const HARD: f64 = 1e20;
/// A fade is at least this wide (pixels): a narrower one would be a row of steps.
const NARROWEST: f64 = 2.0;

/// The parameters of the stage.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct FocusParameters {
    /// How far from the wall all of the cut surface is shown (mm).
    pub margin: f32,
    /// 1 / fade (per mm).
    pub per_fade: f32,
    /// What is nearer to the wall than this (mm) counts as this near.
    pub near: f32,
    /// What is farther than this (mm) counts as this far.
    pub far: f32,
}

impl FocusParameters {
    /// The parameters of a focus in pictures of a camera.
    pub fn new(focus: Focus, camera: &Camera) -> Self {
        let fade = focus.fade.max(NARROWEST * camera.pixel_spacing());
        let per_fade = if focus.fade > 0.0 { 1.0 / fade } else { HARD };
        let (margin, per_fade) = (focus.margin as f32, per_fade as f32);
        // A little more than where the share becomes 0.
        let far = larger(margin + 1.000_01 / per_fade, 0.0);
        Self { margin, per_fade, near: larger(margin, 0.0), far }
    }

    /// How much of the cut surface is shown this far (mm) from the wall, 0 to 1.
    #[inline(always)]
    pub fn share(&self, beyond: f32) -> f32 {
        let away = smaller(larger((larger(beyond, 0.0) - self.margin) * self.per_fade, 0.0), 1.0);
        1.0 - away * away * (3.0 - 2.0 * away)
    }
}

/// Writes how much of the cut surface each pixel shows, 0 to 1.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn focus(
    work: &Work,
    surface: &CutSurface,
    parameters: &FocusParameters,
    shares: &mut [f32],
) -> Result<()> {
    work.expect_whole(Image::Focus, shares);
    let slack = surface.distance_slack();
    let range = WallRange { near: parameters.near, far: parameters.far + slack, slack };
    shares.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, pixels)| {
        work.begin(pixels.len())?;
        dispatch(work.isa, FocusRow { surface, parameters, range, row, pixels });
        Ok(())
    })
}

/// One row of tiles.
struct FocusRow<'a> {
    surface: &'a CutSurface<'a>,
    parameters: &'a FocusParameters,
    range: WallRange,
    row: usize,
    pixels: &'a mut [f32],
}

impl Kernel for FocusRow<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let camera: &Camera = self.surface.camera();
        let width = camera.size()[0];
        for column in (0..width).step_by(COLUMNS) {
            let tile = Tile::new(camera, column, self.row * ROWS);
            // What is not found is farther than whatever matters, and its products are finite.
            let mut beyond = [FAR; PIXELS];
            nearest_walls(self.surface.finest(), &tile, &self.range, &mut beyond);
            for l in 0..PIXELS {
                beyond[l] = self.parameters.share(beyond[l]);
            }
            scatter(&beyond, self.pixels, width, column);
        }
    }
}
