//! Finds the nearest piece of one stretch (points of the tree within the arc threshold), for the pixels of a tile.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use super::view::{CrView, Seen};
use crate::math::lanes::FAN;
use crate::math::nearest::squared_distances_to_segments;
use crate::math::tile::{Area, Tile};

const MAX_CACHED_CHAINS: usize = 256;

/// Finds the piece nearest to a pixel within a stretch. Caches the pieces around a chain (sixteen consecutive
/// segments), because they are nearly the same for all points of the chain and for the pixels of a tile.
pub(super) struct StretchSearch<'a> {
    view: &'a CrView<'a>,
    /// For a chain, the ranges of chains within the threshold of a point on it.
    around: HashMap<u32, Vec<[u32; 2]>>,
    /// For a chain, the chains around it, ordered by distance from this tile.
    in_tile: Vec<(u32, NearFirst)>,
}

impl<'a> StretchSearch<'a> {
    pub(super) fn new(view: &'a CrView<'a>) -> Self {
        Self { view, around: HashMap::new(), in_tile: Vec::new() }
    }

    pub(super) fn begin_tile(&mut self) {
        self.in_tile.clear();
    }

    /// The piece in the stretch around `front` that is nearest to (x, y); the first of equally near ones.
    #[inline(never)]
    pub(super) fn nearest_piece(&mut self, tile: &Tile, front: Seen, [x, y]: [f32; 2]) -> Seen {
        let view = self.view;
        let chain = view.chains.chain_of(view.level, front.vessel, front.piece / 2);
        let known = self.in_tile.iter().position(|(known, _)| *known == chain);
        let n = known.unwrap_or_else(|| {
            let near = self.seen_from(tile, chain);
            self.in_tile.push((chain, near));
            self.in_tile.len() - 1
        });
        let mut best = Best::new(view, front);
        let pixel = Area { center: [x, y], half: [0.0; 2] };
        let mut place = 0;
        while let Some(chain) = self.in_tile[n].1.within(place, best.limit) {
            place += 1;
            if view.chains.squared_distance(chain, &pixel) <= best.limit {
                best.meet(chain, [x, y]);
            }
        }
        best.seen
    }

    fn seen_from(&mut self, tile: &Tile, chain: u32) -> NearFirst {
        let view = self.view;
        if self.around.len() > MAX_CACHED_CHAINS {
            self.around.clear();
        }
        let around = self.around.entry(chain).or_insert_with(|| view.around(chain));
        // Bits of non-negative floats sort like the floats.
        let entry = |chain| Reverse((view.chains.squared_distance(chain, &tile.area).to_bits(), chain));
        let rest: Vec<_> = around.iter().flat_map(|[from, to]| *from..*to).map(entry).collect();
        NearFirst { ordered: Vec::new(), rest: rest.into() }
    }
}

/// Chains by their squared distance (mm²) from a tile, sorted as far as needed.
struct NearFirst {
    ordered: Vec<(f32, u32)>,
    rest: BinaryHeap<Reverse<(u32, u32)>>,
}

impl NearFirst {
    /// The n-th chain by distance, unless it is farther than `limit` (mm²); calls must raise n by one.
    #[inline(always)]
    fn within(&mut self, place: usize, limit: f32) -> Option<u32> {
        if place == self.ordered.len() {
            let Reverse((bits, chain)) = self.rest.pop()?;
            self.ordered.push((f32::from_bits(bits), chain));
        }
        let (squared, chain) = self.ordered[place];
        (squared <= limit).then_some(chain)
    }
}

struct Best<'a> {
    view: &'a CrView<'a>,
    /// The middle of the stretch: a vessel and an arc length (mm).
    middle: (i32, f32),
    seen: Seen,
    /// Segments beyond this squared distance (mm²) cannot be nearer.
    limit: f32,
}

impl<'a> Best<'a> {
    fn new(view: &'a CrView<'a>, front: Seen) -> Self {
        let mut best = Self { view, middle: front.place(), seen: front, limit: 0.0 };
        best.take(front);
        best
    }

    #[inline(always)]
    fn take(&mut self, seen: Seen) {
        let reach = seen.distance + self.view.plane_rule.distance_slack;
        (self.seen, self.limit) = (seen, reach * reach);
    }

    #[inline(always)]
    fn meet(&mut self, chain: u32, [x, y]: [f32; 2]) {
        let chain = &self.view.chains.bundles[chain as usize];
        let squared = squared_distances_to_segments(chain, x, y);
        for s in 0..FAN {
            if squared[s] > self.limit {
                continue;
            }
            for piece in [2 * chain.slot[s], 2 * chain.slot[s] + 1] {
                let seen = self.view.seen(piece, x, y);
                let is_nearer = (seen.distance, seen.piece) < (self.seen.distance, self.seen.piece);
                let near = |seen: &Seen| self.view.connections.are_near(self.middle, seen.place());
                if seen.is_covered && is_nearer && near(&seen) {
                    self.take(seen);
                }
            }
        }
    }
}
