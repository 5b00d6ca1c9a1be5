//! The level choice `own`: the piece shown on the finest level decides the vessel; only its levels are blended.

use super::blend::LevelBlend;
use super::blended::Blended;
use super::{CHOSEN_GAP, CutSurface, Foot, Search, TileSurface, WALL_GAP};
use crate::math::decision::Decision;
use crate::math::lanes::{PART_PIXELS, PIXELS, places};
use crate::math::own_pieces::NearestPieces;
use crate::math::pieces::Envelope;
use crate::math::tile::Tile;

impl CutSurface<'_> {
    #[inline(always)]
    pub(super) fn own<const LUMEN_FIRST: bool, const SHEET: bool>(
        &self,
        tile: &Tile,
        search: &mut impl Search,
        (mut blended, feet): (Option<&mut Blended>, Option<&mut [Foot; PIXELS]>),
    ) -> TileSurface {
        let mut winners = Envelope::new(&[1.0; PIXELS]);
        search.lowest::<LUMEN_FIRST>(0, tile, &self.rule, &mut winners);
        let finest = self.own_pieces(0);
        let decision = Decision::of::<LUMEN_FIRST>(&winners, finest.projected, tile, &self.rule);
        let blend = LevelBlend::select(self.selection, self.projected.len() - 1, &decision.beyond_wall);
        let mut sum = Sum::of_winners(&blend, &winners, &decision);
        if let Some(blended) = &mut blended {
            for l in 0..PIXELS {
                let (weight, at) = (blend.weight(0.0, l), [tile.x[l], tile.y[l]]);
                blended.add(l, (0, weight), finest, winners.piece[l], at);
            }
        }
        // The finest level comes first: the coarse term is added to the fine one.
        for level in places(blend.needed() & !1) {
            let mut weight = [0.0; PIXELS];
            for l in 0..PIXELS {
                weight[l] = blend.weight(level as f32, l);
            }
            for (p, weight) in weight.as_chunks::<PART_PIXELS>().0.iter().enumerate() {
                if weight.iter().any(|weight| *weight > 0.0) {
                    let (mut nearest, part) = (NearestPieces::new(weight), decision.part(tile, p));
                    search.own::<SHEET>(self.own_pieces(level), &part, &mut nearest);
                    sum.add::<SHEET>(p, weight, &nearest);
                    if let Some(blended) = &mut blended {
                        for l in 0..PART_PIXELS {
                            let (l_of_tile, at) = (p * PART_PIXELS + l, [part.x[l], part.y[l]]);
                            let own = self.own_pieces(level);
                            blended.add(l_of_tile, (level, weight[l]), own, nearest.piece[l], at);
                        }
                    }
                }
            }
        }
        if let Some(feet) = feet {
            for l in 0..PIXELS {
                feet[l] = decision.foot(l);
            }
        }
        let mut sheet = [[0.0; 4]; PIXELS];
        if SHEET {
            for l in 0..PIXELS {
                let outside = if decision.beyond_wall[l] > 0.0 {
                    sum.gap(l)
                } else {
                    WALL_GAP - decision.arc_length[l]
                };
                let gap = if decision.is_first[l] { CHOSEN_GAP } else { outside };
                sheet[l] = [sum.slope[0][l], sum.slope[1][l], decision.sheet_radius(l), gap];
            }
        }
        TileSurface { depth: sum.depth, vessel: decision.vessel, sheet }
    }
}

struct Sum {
    depth: [f32; PIXELS],
    slope: [[f32; PIXELS]; 2],
    /// Arc length of the blended point at the finer and at the coarser level, minus that of the piece shown (mm).
    finer: [f32; PIXELS],
    coarser: [f32; PIXELS],
    has_any: [bool; PIXELS],
}

impl Sum {
    #[inline(always)]
    fn of_winners(blend: &LevelBlend, winners: &Envelope, decision: &Decision) -> Self {
        let zero = [0.0; PIXELS];
        let mut sum =
            Self { depth: zero, slope: [zero; 2], finer: zero, coarser: zero, has_any: [false; PIXELS] };
        for l in 0..PIXELS {
            let weight = blend.weight(0.0, l);
            sum.depth[l] = weight * winners.z[l];
            sum.slope[0][l] = weight * decision.slope[0][l];
            sum.slope[1][l] = weight * decision.slope[1][l];
            sum.has_any[l] = weight > 0.0;
        }
        sum
    }

    #[inline(always)]
    fn add<const SHEET: bool>(&mut self, p: usize, weight: &[f32; PART_PIXELS], nearest: &NearestPieces) {
        let depth = &mut self.depth.as_chunks_mut::<PART_PIXELS>().0[p];
        for l in 0..PART_PIXELS {
            depth[l] += weight[l] * nearest.z[l];
        }
        if !SHEET {
            return;
        }
        for l in 0..PART_PIXELS {
            let (w, at) = (weight[l], p * PART_PIXELS + l);
            self.slope[0][at] += w * nearest.slope[0][l];
            self.slope[1][at] += w * nearest.slope[1][l];
            let counts = w > 0.0;
            self.finer[at] = if counts & !self.has_any[at] { nearest.along[l] } else { self.finer[at] };
            self.coarser[at] = if counts { nearest.along[l] } else { self.coarser[at] };
            self.has_any[at] |= counts;
        }
    }

    #[inline(always)]
    fn gap(&self, l: usize) -> f32 {
        (self.coarser[l] - self.finer[l]).abs()
    }
}
