//! What was blended at each pixel: the cost (paper Eq. 2), the level, and the kind of piece. Made only if wanted.

use crate::math::lanes::PIXELS;
use crate::math::own_pieces::OwnPieces;
use crate::math::pieces::{Foot, Kind};
use crate::math::projection::Projected;
use crate::math::whole_curve::distance_to;
use crate::settings::DistanceRule;

/// Per pixel: the cost z + λ · max(0, d − r) and the level, both blended like the depth before the filter, and the
/// [`crate::math::pieces::Kind`] of the piece of the level with the larger weight, and this weight.
pub type Blend = [f32; 4];

/// The blends of a tile while its levels are added, the finest first.
pub(super) struct Blended {
    pub blend: [Blend; PIXELS],
    distance_rule: DistanceRule,
}

impl Blended {
    pub(super) fn new(distance_rule: DistanceRule) -> Self {
        Self { blend: [[0.0; 4]; PIXELS], distance_rule }
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
            *cost += weight * pieces.cost(piece, [x, y], self.distance_rule);
            *blended_level += weight * level as f32;
            if weight > *ruling_weight {
                (*kind, *ruling_weight) = (f32::from(pieces.kind(piece) as u8), weight);
            }
        }
    }
}

impl OwnPieces<'_> {
    /// z + λ · max(0, d − r) of a piece at view (`x`, `y`), in mm: Eq. 2, without the tiers of *lumen first*.
    fn cost(&self, piece: u32, [x, y]: [f32; 2], distance_rule: DistanceRule) -> f32 {
        let slot = (piece / 2) as usize;
        let here = &self.projected[slot];
        let (t, local, end) = if piece.is_multiple_of(2) {
            (0.0, here.wedge().cover(x, y).1, here)
        } else {
            let end = &self.projected[slot + 1];
            let Foot { t, distance, .. } = here.stripe(end).foot(x, y);
            (t, distance, end)
        };
        let distance = match distance_rule {
            DistanceRule::Local => local,
            DistanceRule::WholeCurve => distance_to(self.curve(here.vessel), x, y),
        };
        let z = here.point[2] + t * (end.point[2] - here.point[2]);
        self.rule.key::<false>(z, distance, here.radius + t * (end.radius - here.radius), 0.0)
    }

    fn curve(&self, vessel: i32) -> &[Projected] {
        let [first, end] = [vessel, vessel + 1].map(|id| self.level.first_slot[id as usize] as usize);
        &self.projected[first..end]
    }

    fn kind(&self, piece: u32) -> Kind {
        let here = &self.projected[(piece / 2) as usize];
        if piece % 2 == 1 { Kind::Stripe } else { here.wedge().kind() }
    }
}
