//! The focus: how much of the cut surface and of its silhouettes each pixel shows, by its distance from the nearest wall of any
//! vessel. After the VesselGlyph of Straka et al. 2004.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth::CutSurface;
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{COLUMNS, FAR, Kernel, PIXELS, ROWS, dispatch, larger, smaller};
use crate::math::tile::{Tile, scatter};
use crate::math::walls::{WallRange, nearest_walls};
use crate::settings::{Focus, Settings};

/// What a hard edge takes for 1 / fade (per mm): beyond all distances that rounding tells apart.
const HARD: f64 = 1e20;
/// A fade is at least this wide (pixels): a narrower one would be a row of steps.
const NARROWEST: f64 = 2.0;

/// The parameters of the stage.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct FocusParameters {
    /// How far from the wall all of the cut surface and all of its silhouettes are shown (mm).
    pub margin: [f32; 2],
    /// 1 / fade of both (per mm); 0 where they are shown everywhere.
    pub per_fade: [f32; 2],
    /// What is nearer to the wall than this (mm) counts as this near.
    pub near: f32,
    /// What is farther than this (mm) counts as this far.
    pub far: f32,
}

impl FocusParameters {
    /// The parameters of the focus and of the reach of silhouettes in pictures of a camera; none where neither is asked for.
    pub fn new(settings: &Settings, camera: &Camera) -> Option<Self> {
        let reach = settings.silhouette_reach.filter(|_| settings.silhouettes);
        let lines = reach.map(|reach| Focus { margin: reach, fade: reach });
        let both = [settings.focus, lines];
        if both == [None, None] {
            return None;
        }
        let mut parameters = Self { margin: [0.0; 2], per_fade: [0.0; 2], near: FAR, far: 0.0 };
        for (n, Focus { margin, fade }) in both.into_iter().enumerate().filter_map(|(n, f)| Some((n, f?))) {
            let per_fade = if fade > 0.0 { 1.0 / fade.max(NARROWEST * camera.pixel_spacing()) } else { HARD };
            let (margin, per_fade) = (margin as f32, per_fade as f32);
            (parameters.margin[n], parameters.per_fade[n]) = (margin, per_fade);
            parameters.near = smaller(parameters.near, larger(margin, 0.0));
            // A little more than where the share becomes 0.
            parameters.far = larger(parameters.far, margin + 1.000_01 / per_fade);
        }
        Some(parameters)
    }

    /// How much of the cut surface and of its silhouettes is shown this far (mm) from the wall, 0 to 1.
    #[inline(always)]
    fn shares(&self, beyond: f32) -> Shares {
        let beyond = larger(beyond, 0.0);
        let mut shares = [0.0; 2];
        for n in 0..2 {
            let away = smaller(larger((beyond - self.margin[n]) * self.per_fade[n], 0.0), 1.0);
            shares[n] = 1.0 - away * away * (3.0 - 2.0 * away);
        }
        shares
    }
}

/// How much of the cut surface and how much of its silhouettes a pixel shows, 0 to 1.
pub type Shares = [f32; 2];

/// Writes how much of the cut surface and of its silhouettes each pixel shows.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn focus(
    work: &Work,
    surface: &CutSurface,
    parameters: &FocusParameters,
    shares: &mut [Shares],
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
    pixels: &'a mut [Shares],
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
            let mut shares = [[0.0; 2]; PIXELS];
            for l in 0..PIXELS {
                shares[l] = self.parameters.shares(beyond[l]);
            }
            scatter(&shares, self.pixels, width, column);
        }
    }
}
