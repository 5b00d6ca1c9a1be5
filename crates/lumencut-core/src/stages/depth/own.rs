//! One decision: the winner on the finest level decides the vessel; the levels are those of that vessel alone.

use super::blend::LevelBlend;
use super::{CutSurface, Search, TileSurface};
use crate::math::lanes::{PIXELS, places};
use crate::math::own_pieces::{Decision, NearestPieces};
use crate::math::pieces::Envelope;
use crate::math::tile::Tile;

impl CutSurface<'_> {
    /// The surface over one tile.
    #[inline(always)]
    pub(super) fn own<const LUMEN_FIRST: bool>(
        &self,
        tile: &Tile,
        with_sheet: bool,
        search: &mut impl Search,
    ) -> TileSurface {
        let mut winners = Envelope::new(&[1.0; PIXELS]);
        search.lowest::<LUMEN_FIRST>(0, tile, &self.rule, &mut winners);
        let finest = self.own_pieces(0);
        let decision =
            Decision::of::<LUMEN_FIRST>(&winners, finest.level, finest.projected, tile, &self.rule);
        let blend = LevelBlend::select(self.selection, self.projected.len() - 1, &decision.beyond_wall);
        let mut sum = Sum::new();
        for level in places(blend.needed()) {
            let mut weight = [0.0; PIXELS];
            for l in 0..PIXELS {
                weight[l] = blend.weight(level as f32, l);
            }
            if level == 0 {
                sum.add(&weight, &winners.z, &decision.slope, &[0.0; PIXELS]);
            } else {
                let mut nearest = NearestPieces::new(&weight);
                search.own(self.own_pieces(level), tile, &decision, &mut nearest);
                sum.add(&weight, &nearest.z, &nearest.slope, &nearest.along);
            }
        }
        let mut sheet = [[0.0; 4]; PIXELS];
        if with_sheet {
            for l in 0..PIXELS {
                sheet[l] = [sum.slope[0][l], sum.slope[1][l], decision.radius[l], sum.apart(l)];
            }
        }
        TileSurface { depth: sum.depth, vessel: decision.vessel, sheet }
    }
}

/// The blend of two levels so far.
struct Sum {
    depth: [f32; PIXELS],
    slope: [[f32; PIXELS]; 2],
    /// Where along the vessel the levels lie, from the winner on (mm).
    nearest: [f32; PIXELS],
    farthest: [f32; PIXELS],
    has_any: [bool; PIXELS],
}

impl Sum {
    #[inline(always)]
    fn new() -> Self {
        let zero = [0.0; PIXELS];
        Self { depth: zero, slope: [zero; 2], nearest: zero, farthest: zero, has_any: [false; PIXELS] }
    }

    /// Adds a level by its weights, finest first.
    #[inline(always)]
    fn add(
        &mut self,
        weight: &[f32; PIXELS],
        z: &[f32; PIXELS],
        slope: &[[f32; PIXELS]; 2],
        along: &[f32; PIXELS],
    ) {
        for l in 0..PIXELS {
            let w = weight[l];
            self.depth[l] += w * z[l];
            self.slope[0][l] += w * slope[0][l];
            self.slope[1][l] += w * slope[1][l];
            let counts = w > 0.0;
            self.nearest[l] = if counts & !self.has_any[l] { along[l] } else { self.nearest[l] };
            self.farthest[l] = if counts { along[l] } else { self.farthest[l] };
            self.has_any[l] |= counts;
        }
    }

    /// How far apart along the vessel the two levels lie in a pixel (mm).
    #[inline(always)]
    fn apart(&self, l: usize) -> f32 {
        (self.farthest[l] - self.nearest[l]).abs()
    }
}
