//! The depth of the cut surface: per level the piece with the smallest cost, blended between the two levels
//! that the distance selects (paper section 3.2 and 3.3; Eq. 2).

use rayon::prelude::*;

use super::View;
use crate::error::Result;
use crate::math::cost::Rule;
use crate::math::hierarchy::Hierarchy;
use crate::math::lanes::{Kernel, PIXELS, TILE, dispatch};
use crate::math::pieces::{Envelope, Tile};
use crate::math::projection::{Level, ProjectedLevel};
use crate::math::walk::{Seeds, lowest_keys};
use crate::settings::{MAX_LEVELS, Settings};

/// The levels of a tree in one view, the rule that orders their pieces, and how levels are selected.
pub struct CutSurface<'a> {
    levels: &'a [Level],
    projected: &'a [ProjectedLevel],
    rule: Rule,
    lumen_first: bool,
    /// N / σ (levels² per mm): f² = this · D.
    selection: f32,
}

impl<'a> CutSurface<'a> {
    /// The cut surface of `projected`, which are the `levels` in one view, finest first.
    pub fn new(levels: &'a [Level], projected: &'a [ProjectedLevel], settings: &Settings) -> Self {
        let reach = projected.iter().map(ProjectedLevel::reach).fold(0.0, f32::max);
        Self {
            levels,
            projected,
            rule: Rule::new(settings, reach),
            lumen_first: settings.lumen_first,
            selection: ((projected.len() - 1) as f64 / settings.level_distance) as f32,
        }
    }

    /// The finest level in projection.
    pub fn finest(&self) -> &'a Hierarchy {
        self.hierarchy(0)
    }

    /// A level in projection.
    #[inline(always)]
    pub(crate) fn hierarchy(&self, level: usize) -> &'a Hierarchy {
        &self.projected[level].hierarchy
    }
}

/// The two levels that a pixel blends, and the weights of their depths.
#[derive(Clone, Copy, Default)]
struct Blend {
    fine: usize,
    coarse: usize,
    fine_weight: f32,
    coarse_weight: f32,
}

impl Blend {
    /// Level selection at distance D: f = √(N·D/σ) between ⌊f⌋ and ⌊f⌋ + 1, N beyond.
    #[inline(always)]
    fn select(selection: f32, coarsest: usize, distance: f32) -> Self {
        let f = (selection * distance).sqrt();
        let fine = f as usize;
        if fine >= coarsest {
            return Self { fine: coarsest, coarse: coarsest, fine_weight: 1.0, coarse_weight: 0.0 };
        }
        let coarse = fine + 1;
        Self { fine, coarse, fine_weight: coarse as f32 - f, coarse_weight: f - fine as f32 }
    }
}

/// How the winners of one level over a tile are found.
pub(crate) trait Search {
    fn lowest<const LUMEN_FIRST: bool>(&mut self, level: usize, tile: &Tile, rule: &Rule, envelope: &mut Envelope);
}

/// By the walk through the hierarchy, seeded with the winners of the tile before.
struct Walk<'a> {
    surface: &'a CutSurface<'a>,
    seeds: [Seeds; MAX_LEVELS + 1],
}

impl Search for Walk<'_> {
    #[inline(always)]
    fn lowest<const LUMEN_FIRST: bool>(&mut self, level: usize, tile: &Tile, rule: &Rule, envelope: &mut Envelope) {
        let hierarchy = self.surface.hierarchy(level);
        lowest_keys::<LUMEN_FIRST>(hierarchy, tile, rule, &self.seeds[level], envelope);
        self.seeds[level] = Seeds::collect(envelope, &self.surface.levels[level].bundle_of_slot);
    }
}

/// Writes depth (mm) and vessel id of the cut surface at each pixel of the view, given the distances.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn depth(
    view: &View,
    surface: &CutSurface,
    distance: &[f32],
    depth: &mut [f32],
    vessel: &mut [i32],
) -> Result<()> {
    let seeds = [Seeds::default(); MAX_LEVELS + 1];
    depth_by(view, surface, distance, depth, vessel, || Walk { surface, seeds })
}

/// [`depth`] with a search of its own for each row of tiles.
pub(crate) fn depth_by<S: Search>(
    view: &View,
    surface: &CutSurface,
    distance: &[f32],
    depth: &mut [f32],
    vessel: &mut [i32],
    search: impl Fn() -> S + Sync,
) -> Result<()> {
    let chunk = view.tile_row();
    let rows = depth.par_chunks_mut(chunk).zip(vessel.par_chunks_mut(chunk)).zip(distance.par_chunks(chunk));
    rows.enumerate().try_for_each(|(row, ((depth, vessel), distance))| {
        view.go_on()?;
        let (row, search) = (DepthRow { view, surface, row, distance, depth, vessel }, search());
        if surface.lumen_first {
            dispatch(view.isa, DepthKernel::<S, true> { row, search });
        } else {
            dispatch(view.isa, DepthKernel::<S, false> { row, search });
        }
        Ok(())
    })
}

/// One row of tiles.
struct DepthRow<'a> {
    view: &'a View<'a>,
    surface: &'a CutSurface<'a>,
    row: usize,
    distance: &'a [f32],
    depth: &'a mut [f32],
    vessel: &'a mut [i32],
}

struct DepthKernel<'a, S: Search, const LUMEN_FIRST: bool> {
    row: DepthRow<'a>,
    search: S,
}

impl<S: Search, const LUMEN_FIRST: bool> Kernel for DepthKernel<'_, S, LUMEN_FIRST> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        self.row.fill::<LUMEN_FIRST>(&mut self.search);
    }
}

impl DepthRow<'_> {
    /// Fills the row, tile by tile.
    #[inline(always)]
    fn fill<const LUMEN_FIRST: bool>(self, search: &mut impl Search) {
        let width = self.view.size()[0];
        let height = self.depth.len() / width;
        for column in (0..width).step_by(TILE) {
            let tile = Tile::new(self.view.camera, column, self.row * TILE);
            // Pixels beyond the image repeat its last column and row.
            let pixel = |l: usize| (l / TILE).min(height - 1) * width + (column + l % TILE).min(width - 1);
            let distance = std::array::from_fn(|l| self.distance[pixel(l)]);
            let (depth, vessel) = self.surface.blend::<LUMEN_FIRST>(&tile, &distance, search);
            for r in 0..height {
                for c in 0..TILE.min(width - column) {
                    self.depth[r * width + column + c] = depth[r * TILE + c];
                    self.vessel[r * width + column + c] = vessel[r * TILE + c];
                }
            }
        }
    }
}

impl CutSurface<'_> {
    /// Depth and vessel id over one tile.
    #[inline(always)]
    fn blend<const LUMEN_FIRST: bool>(
        &self,
        tile: &Tile,
        distance: &[f32; PIXELS],
        search: &mut impl Search,
    ) -> ([f32; PIXELS], [i32; PIXELS]) {
        let coarsest = self.projected.len() - 1;
        let mut blends = [Blend::default(); PIXELS];
        let mut needed = 0u32;
        for l in 0..PIXELS {
            blends[l] = Blend::select(self.selection, coarsest, distance[l]);
            needed |= 1 << blends[l].fine | 1 << blends[l].coarse;
        }
        let (mut depth, mut vessel) = ([0.0; PIXELS], [0; PIXELS]);
        while needed != 0 {
            let level = needed.trailing_zeros() as usize;
            needed &= needed - 1;
            let mut wanted = [false; PIXELS];
            for l in 0..PIXELS {
                wanted[l] = (blends[l].fine == level) | (blends[l].coarse == level);
            }
            let mut envelope = Envelope::new(&wanted);
            search.lowest::<LUMEN_FIRST>(level, tile, &self.rule, &mut envelope);
            let vessel_of_slot = &self.levels[level].vessel_of_slot;
            // Levels come finest first: the coarse term is added to the fine one.
            for l in 0..PIXELS {
                let Blend { fine, fine_weight, coarse_weight, .. } = blends[l];
                if !wanted[l] {
                    continue;
                }
                let (weight, rules) = if fine == level {
                    (fine_weight, fine_weight >= coarse_weight)
                } else {
                    (coarse_weight, fine_weight < coarse_weight)
                };
                depth[l] += weight * envelope.z[l];
                if rules {
                    vessel[l] = vessel_of_slot[(envelope.piece[l] / 2) as usize];
                }
            }
        }
        (depth, vessel)
    }
}
