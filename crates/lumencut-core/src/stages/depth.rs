//! The depth of the cut surface: per level the piece with the smallest cost, blended between the two levels
//! that the distance selects (paper sections 3.1.3, 3.1.4, 3.2.1 and 3.3.2;
//! Eq. 2).

use rayon::prelude::*;

use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::cost::Rule;
use crate::math::hierarchy::Hierarchy;
use crate::math::lanes::{COLUMNS, Kernel, PIXELS, ROWS, dispatch, places, smaller};
use crate::math::levels::CutSurfaceParameters;
use crate::math::pieces::Envelope;
use crate::math::projection::{Level, ProjectedLevel};
use crate::math::tile::{Tile, gather, scatter};
use crate::math::walk::{Seeds, lowest_keys};
use crate::settings::{MAX_LEVELS, Settings};

/// The levels of a tree in one view, the rule that orders their pieces, and how levels are selected.
pub struct CutSurface<'a> {
    levels: &'a [Level],
    projected: &'a [ProjectedLevel],
    camera: &'a Camera,
    rule: Rule,
    lumen_first: bool,
    /// N / σ (levels² per mm): f² = this · D.
    selection: f32,
}

impl<'a> CutSurface<'a> {
    /// The cut surface of `projected`, which are the `levels` in the view of `camera`, finest first.
    pub fn new(
        levels: &'a [Level],
        projected: &'a [ProjectedLevel],
        camera: &'a Camera,
        settings: &Settings,
    ) -> Self {
        let tree_reach = projected.iter().map(ProjectedLevel::reach).fold(0.0, f32::max);
        let parameters = CutSurfaceParameters::new(settings, camera, tree_reach);
        Self {
            levels,
            projected,
            camera,
            rule: parameters.rule(),
            lumen_first: settings.lumen_first,
            selection: parameters.selection,
        }
    }

    /// The view.
    pub fn camera(&self) -> &'a Camera {
        self.camera
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

/// The two levels that each pixel of a tile blends, and the weights of their depths.
struct LevelBlend {
    /// k0, as a number that compares exactly.
    fine: [f32; PIXELS],
    fine_weight: [f32; PIXELS],
    /// The weight of k0 + 1; 0 where k0 = N.
    coarse_weight: [f32; PIXELS],
}

impl LevelBlend {
    /// Level selection at distance D: f = √(N·D/σ) between ⌊f⌋ and ⌊f⌋ + 1, N beyond.
    #[inline(always)]
    fn select(selection: f32, coarsest: usize, distance: &[f32; PIXELS]) -> Self {
        let zero = [0.0; PIXELS];
        let mut blend = Self { fine: zero, fine_weight: zero, coarse_weight: zero };
        let last = coarsest as f32;
        for l in 0..PIXELS {
            let f = smaller((selection * distance[l]).sqrt(), last);
            let fine = (f as i32) as f32;
            blend.fine[l] = fine;
            blend.fine_weight[l] = fine + 1.0 - f;
            blend.coarse_weight[l] = f - fine;
        }
        blend
    }

    /// Bit k tells whether some pixel needs level k.
    #[inline(always)]
    fn needed(&self) -> u32 {
        let (mut bits, mut all) = ([0u32; PIXELS], 0);
        for l in 0..PIXELS {
            let pair = if self.coarse_weight[l] > 0.0 { 3 } else { 1 };
            bits[l] = pair << (self.fine[l] as i32);
        }
        for l in 0..PIXELS {
            all |= bits[l];
        }
        all
    }

    /// The weight of level `k` at pixel `l`; 0 where it is not needed.
    #[inline(always)]
    fn weight(&self, k: f32, l: usize) -> f32 {
        let coarse = if self.fine[l] + 1.0 == k { self.coarse_weight[l] } else { 0.0 };
        if self.fine[l] == k { self.fine_weight[l] } else { coarse }
    }
}

/// How the winners of one level over a tile are found.
pub(crate) trait Search {
    fn lowest<const LUMEN_FIRST: bool>(
        &mut self,
        level: usize,
        tile: &Tile,
        rule: &Rule,
        envelope: &mut Envelope,
    );
}

/// By the walk through the hierarchy, seeded with the winners of the tile before.
struct LowestKeySearch<'a> {
    surface: &'a CutSurface<'a>,
    seeds: [Seeds; MAX_LEVELS + 1],
}

impl Search for LowestKeySearch<'_> {
    #[inline(always)]
    fn lowest<const LUMEN_FIRST: bool>(
        &mut self,
        level: usize,
        tile: &Tile,
        rule: &Rule,
        envelope: &mut Envelope,
    ) {
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
    work: &Work,
    surface: &CutSurface,
    distance: &[f32],
    depth: &mut [f32],
    vessel: &mut [i32],
) -> Result<()> {
    let seeds = [Seeds::default(); MAX_LEVELS + 1];
    depth_by(work, surface, distance, depth, vessel, || LowestKeySearch { surface, seeds })
}

/// [`depth`] with a search of its own for each row of tiles.
pub(crate) fn depth_by<S: Search>(
    work: &Work,
    surface: &CutSurface,
    distance: &[f32],
    depth: &mut [f32],
    vessel: &mut [i32],
    search: impl Fn() -> S + Sync,
) -> Result<()> {
    work.expect_whole(Image::Distance, distance);
    work.expect_whole(Image::UnfilteredDepth, depth);
    work.expect_whole(Image::Vessel, vessel);
    let chunk = work.tile_row();
    let rows = depth.par_chunks_mut(chunk).zip(vessel.par_chunks_mut(chunk)).zip(distance.par_chunks(chunk));
    rows.enumerate().try_for_each(|(row, ((depth, vessel), distance))| {
        work.go_on()?;
        let (row, search) = (DepthRow { surface, row, distance, depth, vessel }, search());
        if surface.lumen_first {
            dispatch(work.isa, DepthKernel::<S, true> { row, search });
        } else {
            dispatch(work.isa, DepthKernel::<S, false> { row, search });
        }
        Ok(())
    })
}

/// One row of tiles.
struct DepthRow<'a> {
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
        let camera = self.surface.camera;
        let width = camera.size()[0];
        for column in (0..width).step_by(COLUMNS) {
            let tile = Tile::new(camera, column, self.row * ROWS);
            let distance = gather(self.distance, width, column);
            let (depth, vessel) = self.surface.blend::<LUMEN_FIRST>(&tile, &distance, search);
            scatter(&depth, self.depth, width, column);
            scatter(&vessel, self.vessel, width, column);
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
        let blend = LevelBlend::select(self.selection, self.projected.len() - 1, distance);
        let (mut depth, mut vessel) = ([0.0; PIXELS], [0; PIXELS]);
        // The slot that rules each pixel, in the level it belongs to: the one with the larger weight.
        let (mut slot, mut ruling_level, mut ruling_weight) = ([0; PIXELS], [0; PIXELS], [0.0; PIXELS]);
        // Finest first: the coarse term is added to the fine one, and a tie stays with the finer level.
        for level in places(blend.needed()) {
            let mut weight = [0.0; PIXELS];
            for l in 0..PIXELS {
                weight[l] = blend.weight(level as f32, l);
            }
            let mut envelope = Envelope::new(&weight);
            search.lowest::<LUMEN_FIRST>(level, tile, &self.rule, &mut envelope);
            for l in 0..PIXELS {
                depth[l] += weight[l] * envelope.z[l];
                let rules = weight[l] > ruling_weight[l];
                ruling_weight[l] = if rules { weight[l] } else { ruling_weight[l] };
                ruling_level[l] = if rules { level as u32 } else { ruling_level[l] };
                slot[l] = if rules { envelope.piece[l] / 2 } else { slot[l] };
            }
        }
        for l in 0..PIXELS {
            vessel[l] = self.levels[ruling_level[l] as usize].vessel_of_slot[slot[l] as usize];
        }
        (depth, vessel)
    }
}
