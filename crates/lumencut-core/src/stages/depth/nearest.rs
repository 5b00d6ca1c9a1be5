//! The paper's level choice: at each level the piece with the smallest key, of any vessel.

use super::blend::LevelBlend;
use super::blended::Blended;
use super::{CHOSEN_GAP, CutSurface, Foot, Search, Sheet, TileSurface, WALL_GAP, is_chosen};
use crate::math::decision::Decision;
use crate::math::lanes::{FAR, PIXELS, places};
use crate::math::pieces::Envelope;
use crate::math::tile::Tile;

impl CutSurface<'_> {
    #[inline(always)]
    pub(super) fn nearest_surface<const LUMEN_FIRST: bool>(
        &self,
        tile: &Tile,
        distance: &[f32; PIXELS],
        with_sheet: bool,
        search: &mut impl Search,
        (mut blended, mut feet): (Option<&mut Blended>, Option<&mut [Foot; PIXELS]>),
    ) -> TileSurface {
        let blend = LevelBlend::select(self.selection, self.projected.len() - 1, distance);
        let (mut depth, mut vessel) = ([0.0; PIXELS], [0; PIXELS]);
        // For each pixel, the slot of the level with the larger weight, and that level.
        let (mut slot, mut ruling_level, mut ruling_weight) = ([0; PIXELS], [0; PIXELS], [0.0; PIXELS]);
        let mut sheets = BlendedSheets::new();
        // Finest first: the coarse term is added to the fine one, and the finer level wins ties.
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
            if let Some(blended) = &mut blended {
                let own = self.own_pieces(level);
                for l in 0..PIXELS {
                    let at = [tile.x[l], tile.y[l]];
                    blended.add(l, (level, weight[l]), own, envelope.piece[l], at);
                }
            }
            if with_sheet || feet.is_some() {
                // Pixels where no piece was found do not use this level, so any slot will do.
                envelope.piece = envelope.piece.map(|piece| if piece == u32::MAX { 0 } else { piece });
                let own = self.own_pieces(level);
                let found = Decision::of::<LUMEN_FIRST>(&envelope, own.projected, tile, &self.rule);
                sheets.add(&weight, &found);
                if let Some(feet) = &mut feet {
                    for l in 0..PIXELS {
                        let rules = weight[l] > 0.0 && ruling_level[l] == level as u32;
                        feet[l] = if rules { found.foot(l) } else { feet[l] };
                    }
                }
            }
        }
        for l in 0..PIXELS {
            vessel[l] = self.levels[ruling_level[l] as usize].vessel_of_slot[slot[l] as usize];
        }
        TileSurface { depth, vessel, sheet: sheets.sheet }
    }
}

struct BlendedSheets {
    sheet: [Sheet; PIXELS],
    /// Vessel and arc length (mm) of the finer of two levels; vessel −1 before it is known.
    finer: [(i32, f32); PIXELS],
}

impl BlendedSheets {
    #[inline(always)]
    fn new() -> Self {
        Self { sheet: [[0.0; 4]; PIXELS], finer: [(-1, 0.0); PIXELS] }
    }

    #[inline(always)]
    fn add(&mut self, weight: &[f32; PIXELS], found: &Decision) {
        for l in 0..PIXELS {
            if weight[l] > 0.0 {
                let [x, y, radius, gap] = &mut self.sheet[l];
                *x += weight[l] * found.slope[0][l];
                *y += weight[l] * found.slope[1][l];
                // A pixel shows lumen if every level that it blends shows lumen.
                let (is_outside_lumen, part) =
                    ((*radius < 0.0) | !found.is_lumen[l], weight[l] * found.radius[l]);
                *radius = if is_outside_lumen { -(radius.abs() + part) } else { *radius + part };
                let (vessel, s) = self.finer[l];
                let is_first = found.is_first[l] & ((vessel < 0) | is_chosen(*gap));
                let is_wall = (found.beyond_wall[l] <= 0.0) & ((vessel < 0) | (*gap < 0.0));
                if is_first {
                    *gap = CHOSEN_GAP;
                } else if is_wall {
                    *gap = WALL_GAP - found.arc_length[l];
                } else if vessel >= 0 {
                    let same = vessel == found.vessel[l];
                    *gap = if same { (found.arc_length[l] - s).abs() } else { FAR };
                }
                self.finer[l] = (found.vessel[l], found.arc_length[l]);
            }
        }
    }
}
