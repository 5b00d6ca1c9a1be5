//! The focus: the shares of the cut surface and its silhouettes that each pixel shows, and how much the context is
//! darkened. They depend on the distance from the nearest vessel wall. After the VesselGlyph of Straka et al. 2004.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth::CutSurface;
use super::silhouette::FARTHEST_LEAP;
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{COLUMNS, FAR, Kernel, PIXELS, ROWS, dispatch, larger, smaller};
use crate::math::leaps::LEAPS;
use crate::math::thickness::one_minus_power_of_two;
use crate::math::tile::{Tile, scatter};
use crate::math::walls::{WallRange, nearest_walls};
use crate::settings::{Focus, Settings};

/// 1 / fade for a hard edge (per mm), so large that no pixel is partly faded.
const HARD_EDGE_PER_MM: f64 = 1e20;
/// Minimum width of a fade (pixels); a narrower fade would show steps.
const MIN_FADE_PIXELS: f64 = 2.0;
/// The halo is full up to this distance from the wall (mm), and then falls to 1/e over this distance again.
pub const HALO_MM: f32 = 6.0;
/// Beyond this distance (mm) a halo would change the context by less than half a grey value.
const HALO_END_MM: f32 = 42.0;
/// In a preview the halo ends here (mm), so that a moving view searches no wall farther away.
const PREVIEW_HALO_END_MM: f32 = 20.0;
/// Beyond the wall, occlusion fades in over this distance (mm).
pub const SHADE_FADE_MM: f32 = 1.0;

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct FocusParameters {
    /// Distances from the wall up to which cut surface and silhouettes are fully shown (mm).
    pub margin: [f32; 2],
    /// 1 / fade of cut surface and silhouettes (per mm); 0 if they are shown everywhere.
    pub per_fade: [f32; 2],
    /// Distances from the wall below this (mm) count as this.
    pub near: f32,
    /// Distances from the wall above this (mm) count as this.
    pub far: f32,
    /// The share that the other vessels keep if some are chosen, 0 to 1.
    pub others: f32,
    /// How much the halo darkens the context at the edge of the focus, 0 to 1.
    pub halo: f32,
    /// Distance from the wall up to which occlusion does not darken the surface (mm).
    pub wall: f32,
    /// How much occlusion darkens the surface beyond the wall, 0 to 1.
    pub shade: f32,
    /// Distance from the wall at which the halo ends (mm), and its weight there, which is subtracted.
    pub halo_end: f32,
    pub halo_rest: f32,
}

impl FocusParameters {
    /// The parameters of the focus and of the reach of silhouettes for a camera; `None` if neither is set.
    pub fn new(settings: &Settings, camera: &Camera) -> Option<Self> {
        let reach = settings.silhouette_reach.filter(|_| settings.silhouettes);
        let lines = reach.map(|reach| Focus { margin: reach, fade: reach });
        let both = [settings.focus, lines];
        if both == [None, None] && settings.occlusion == 0.0 {
            return None;
        }
        let context = settings.context.as_ref().filter(|_| settings.focus.is_some());
        let is_preview = context.is_some_and(|context| context.preview);
        let halo_end = if is_preview { PREVIEW_HALO_END_MM } else { HALO_END_MM };
        let has_others = settings.focus.is_some() && !settings.focus_vessels.is_empty();
        let others = if has_others { settings.others_strength as f32 } else { 1.0 };
        let mut parameters = Self {
            others,
            halo: context.map_or(0.0, |context| context.halo) as f32,
            halo_end,
            halo_rest: if is_preview { halo_weight(halo_end) } else { 0.0 },
            wall: settings.lumen_margin as f32,
            shade: settings.occlusion as f32,
            ..Self::zeroed()
        };
        for (n, Focus { margin, fade }) in both.into_iter().enumerate().filter_map(|(n, f)| Some((n, f?))) {
            let per_fade = if fade > 0.0 {
                1.0 / fade.max(MIN_FADE_PIXELS * camera.pixel_spacing())
            } else {
                HARD_EDGE_PER_MM
            };
            (parameters.margin[n], parameters.per_fade[n]) = (margin as f32, per_fade as f32);
        }
        [parameters.near, parameters.far] = parameters.between(&[SURFACE, LINES])?;
        Some(parameters)
    }

    /// The distances from the wall (mm) between which shares change; `None` if they are 1 everywhere.
    fn between(&self, which: &[usize]) -> Option<[f32; 2]> {
        let fading = which.iter().filter(|n| self.per_fade[**n] > 0.0);
        // Slightly beyond the distance at which the share becomes 0.
        let ends = fading.map(|n| [self.margin[*n], self.margin[*n] + 1.000_01 / self.per_fade[*n]]);
        let halo = (self.halo > 0.0).then_some([HALO_MM, self.halo_end]);
        let shade = (self.shade > 0.0).then_some([self.wall, self.wall + SHADE_FADE_MM]);
        let ends = ends.chain(halo).chain(shade).map(|[near, far]| [larger(near, 0.0), larger(far, 0.0)]);
        ends.reduce(|[near, far], [nearer, farther]| [smaller(near, nearer), larger(far, farther)])
    }

    /// The distances of `between` as a range; `slack` bounds their rounding error (mm).
    fn range(&self, which: &[usize], slack: f32) -> Option<WallRange> {
        self.between(which).map(|[near, far]| WallRange { near, far: far + slack, slack })
    }

    /// The shares of the cut surface and of its silhouettes at a distance (mm) from the wall, 0 to 1.
    #[inline(always)]
    fn shares(&self, beyond: f32) -> [f32; 2] {
        let beyond = larger(beyond, 0.0);
        let mut shares = [0.0; 2];
        for n in 0..2 {
            shares[n] = 1.0 - smooth_step((beyond - self.margin[n]) * self.per_fade[n]);
        }
        shares
    }

    /// The factor on the colours of the context, where the surface has this share.
    #[inline(always)]
    fn around(&self, beyond: f32, share: f32) -> f32 {
        let weight = (halo_weight(beyond) - self.halo_rest) / (1.0 - self.halo_rest);
        let halo = 1.0 - self.halo * (1.0 - share) * weight;
        if beyond < self.halo_end { halo } else { 1.0 }
    }

    /// How much occlusion may darken the surface, 0 to 1; 0 in lumen and wall.
    #[inline(always)]
    fn shade(&self, beyond: f32) -> f32 {
        self.shade * smooth_step((beyond - self.wall) / SHADE_FADE_MM)
    }
}

/// 1 up to [`HALO_MM`] from the wall, then falling exponentially.
#[inline(always)]
fn halo_weight(beyond: f32) -> f32 {
    let away = larger(beyond - HALO_MM, 0.0) / HALO_MM;
    1.0 - one_minus_power_of_two(-away * std::f32::consts::LOG2_E)
}

#[inline(always)]
fn smooth_step(x: f32) -> f32 {
    let x = smaller(larger(x, 0.0), 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// What a pixel shows, each 0 to 1: the shares of the cut surface and of its silhouettes, the factor on the colours of
/// the context, and how much occlusion may darken the surface.
pub type Shares = [f32; 4];

/// Everything is shown as it is.
pub const ALL_SHOWN: Shares = [1.0, 1.0, 1.0, 0.0];

/// Indices into [`Shares`].
const SURFACE: usize = 0;
const LINES: usize = 1;
const AROUND: usize = 2;
pub(super) const SHADE: usize = 3;

/// Writes the shares. In tiles that no silhouette reaches according to `leap`,
/// the silhouettes' share is arbitrary; with an empty `leap` it is exact everywhere.
pub fn focus(
    work: &Work,
    surface: &CutSurface,
    parameters: &FocusParameters,
    leap: &[u32],
    shares: &mut [Shares],
) -> Result<()> {
    work.expect_whole(Image::Focus, shares);
    if !leap.is_empty() {
        work.expect_whole(Image::Leap, leap);
    }
    shares.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, pixels)| {
        work.begin(pixels.len())?;
        let has_lines = tiles_with_lines(leap, work.size[0], row);
        dispatch(work.isa, FocusRow { surface, parameters, has_lines: &has_lines, row, pixels });
        Ok(())
    })
}

/// For each tile of a row, whether the line of a depth jump can lie in it; empty if jumps are unknown.
fn tiles_with_lines(leap: &[u32], width: usize, row: usize) -> Vec<bool> {
    let first = (row * ROWS).saturating_sub(FARTHEST_LEAP) * width;
    let end = ((row + 1) * ROWS + FARTHEST_LEAP) * width;
    let mut columns = vec![0; if leap.is_empty() { 0 } else { width }];
    for row in leap[first.min(leap.len())..end.min(leap.len())].chunks_exact(width) {
        columns.iter_mut().zip(row).for_each(|(all, bits)| *all |= bits);
    }
    let tiles = (0..columns.len()).step_by(COLUMNS);
    let around =
        tiles.map(|c| c.saturating_sub(FARTHEST_LEAP)..(c + COLUMNS + FARTHEST_LEAP).min(columns.len()));
    around.map(|around| columns[around].iter().any(|bits| bits & LEAPS != 0)).collect()
}

struct FocusRow<'a> {
    surface: &'a CutSurface<'a>,
    parameters: &'a FocusParameters,
    has_lines: &'a [bool],
    row: usize,
    pixels: &'a mut [Shares],
}

impl Kernel for FocusRow<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let camera: &Camera = self.surface.camera();
        let width = camera.size()[0];
        let slack = self.surface.distance_slack();
        let [of_both, of_surface] =
            [&[SURFACE, LINES][..], &[SURFACE]].map(|which| self.parameters.range(which, slack));
        for column in (0..width).step_by(COLUMNS) {
            let tile = Tile::new(camera, column, self.row * ROWS);
            // A finite distance, larger than all that are compared.
            let mut beyond = [FAR; PIXELS];
            let has_lines = self.has_lines.get(column / COLUMNS).is_none_or(|has_lines| *has_lines);
            let range = if has_lines { of_both } else { of_surface };
            if let Some(range) = range {
                nearest_walls::<false>(self.surface.finest(), &tile, &range, &mut beyond);
            }
            let mut shares = [[0.0; 4]; PIXELS];
            for l in 0..PIXELS {
                [shares[l][SURFACE], shares[l][LINES]] = self.parameters.shares(beyond[l]);
            }
            if let Some(range) = range.filter(|_| self.parameters.others < 1.0) {
                self.keep_first(&tile, &range, &mut shares);
            }
            for l in 0..PIXELS {
                shares[l][AROUND] = self.parameters.around(beyond[l], shares[l][SURFACE]);
                shares[l][SHADE] = self.parameters.shade(beyond[l]);
            }
            scatter(&shares, self.pixels, width, column);
        }
    }
}

impl FocusRow<'_> {
    /// Reduces the shares of all vessels except chosen ones.
    #[inline(always)]
    fn keep_first(&self, tile: &Tile, range: &WallRange, shares: &mut [Shares; PIXELS]) {
        let mut beyond = [FAR; PIXELS];
        nearest_walls::<true>(self.surface.finest(), tile, range, &mut beyond);
        for l in 0..PIXELS {
            let [of_first, _] = self.parameters.shares(beyond[l]);
            shares[l][SURFACE] = larger(of_first, shares[l][SURFACE] * self.parameters.others);
        }
    }
}
