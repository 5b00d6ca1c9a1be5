//! What was blended at each pixel: the cost (paper Eq. 2), the level, and the kind of piece. Made only if wanted.

use super::Blend;
use crate::math::lanes::PIXELS;
use crate::math::own_pieces::OwnPieces;
use crate::math::pieces::{Foot, Kind};

/// The blends of a tile while its levels are added, the finest first.
pub(super) struct Blended {
    pub blend: [Blend; PIXELS],
}

impl Blended {
    pub(super) fn new() -> Self {
        Self { blend: [[0.0; 4]; PIXELS] }
    }

    /// Adds the piece that pixel `l` at view (`x`, `y`) shows of a level; the finer level wins ties of weights.
    pub(super) fn add(
        &mut self,
        l: usize,
        (level, weight): (usize, f32),
        pieces: OwnPieces,
        piece: u32,
        [x, y]: [f32; 2],
    ) {
        if weight > 0.0 {
            let [cost, blended_level, kind, ruling_weight] = &mut self.blend[l];
            *cost += weight * pieces.cost(piece, x, y);
            *blended_level += weight * level as f32;
            if weight > *ruling_weight {
                (*kind, *ruling_weight) = (f32::from(pieces.kind(piece) as u8), weight);
            }
        }
    }
}

impl OwnPieces<'_> {
    /// z + λ · max(0, d − r) of a piece at view (`x`, `y`), in mm: Eq. 2, without the tiers of *lumen first*.
    fn cost(&self, piece: u32, x: f32, y: f32) -> f32 {
        let slot = (piece / 2) as usize;
        let here = &self.projected[slot];
        if piece.is_multiple_of(2) {
            let (_, distance) = here.wedge().cover(x, y);
            return self.rule.key::<false>(here.point[2], distance, here.radius, 0.0);
        }
        let end = &self.projected[slot + 1];
        let Foot { t, distance, .. } = here.stripe(end).foot(x, y);
        let z = here.point[2] + t * (end.point[2] - here.point[2]);
        self.rule.key::<false>(z, distance, here.radius + t * (end.radius - here.radius), 0.0)
    }

    fn kind(&self, piece: u32) -> Kind {
        let here = &self.projected[(piece / 2) as usize];
        if piece % 2 == 1 { Kind::Stripe } else { here.wedge().kind() }
    }
}
