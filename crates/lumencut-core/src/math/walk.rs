//! The walk through a hierarchy for one tile: nearest nodes first, until none can beat the tile's worst key.

use super::candidates::candidates;
use super::cost::Rule;
use super::hierarchy::{Boxes, Hierarchy};
use super::lanes::{
    COLUMNS, EXCLUDED, FAN, PART_PIXELS, PARTS, PIXELS, ROWS, UNSET, larger, largest, places,
};
use super::nearest::{NearestPoint, lower_distance};
use super::pieces::Envelope;
use super::tile::{Tile, lane};

/// Capacity of the stack: at each of the at most eight heights, at most fifteen siblings wait.
const STACK: usize = 8 * FAN;

/// Waiting nodes as (bound, height, index), with the nearest on top.
pub(crate) struct Stack {
    waiting: [(f32, u32, u32); STACK],
    length: usize,
}

impl Stack {
    #[inline(always)]
    fn new() -> Self {
        Self { waiting: [(0.0, 0, 0); STACK], length: 0 }
    }

    #[inline(always)]
    pub(crate) fn root(hierarchy: &Hierarchy, bound: f32) -> Self {
        let mut stack = Self::new();
        stack.waiting[0] = (bound, hierarchy.heights.len() as u32, 0);
        stack.length = 1;
        stack
    }

    #[inline(always)]
    pub(crate) fn push_nodes(
        &mut self,
        tile: &Tile,
        bounds: &[f32; FAN],
        limit: f32,
        [height, first]: [u32; 2],
    ) {
        let base = self.length;
        for n in places(tile.bits.within(bounds, limit)) {
            let bound = bounds[n];
            let mut at = self.length;
            while at > base && self.waiting[at - 1].0 < bound {
                self.waiting[at] = self.waiting[at - 1];
                at -= 1;
            }
            self.waiting[at] = (bound, height, first + n as u32);
            self.length += 1;
        }
    }

    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<(f32, u32, u32)> {
        self.length = self.length.checked_sub(1)?;
        Some(self.waiting[self.length])
    }
}

/// Bundles with the lowest keys of the previous tile; most of the lowest keys of this tile are in them too.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Seeds {
    bundles: [u32; 4],
    count: usize,
}

impl Seeds {
    #[inline(always)]
    pub(crate) fn collect(envelope: &Envelope, bundle_of_slot: &[u32]) -> Self {
        let mut seeds = Self::default();
        for l in [lane(0, 0), lane(0, COLUMNS - 1), lane(ROWS - 1, 0), lane(ROWS - 1, COLUMNS - 1)] {
            let slot = envelope.piece[l] / 2;
            if let Some(bundle) = bundle_of_slot.get(slot as usize)
                && !seeds.contains(*bundle)
            {
                seeds.bundles[seeds.count] = *bundle;
                seeds.count += 1;
            }
        }
        seeds
    }

    #[inline(always)]
    fn contains(&self, bundle: u32) -> bool {
        self.bundles[..self.count].contains(&bundle)
    }
}

#[inline(always)]
pub(crate) fn lowest_keys<const LUMEN_FIRST: bool>(
    hierarchy: &Hierarchy,
    tile: &Tile,
    rule: &Rule,
    seeds: &Seeds,
    envelope: &mut Envelope,
) {
    let mut stack = Stack::new();
    let mut limit = rule.limit(UNSET);
    let mut limits = [limit; PARTS];
    let root = hierarchy.heights.len() as u32;
    stack.waiting[0] = (EXCLUDED, root, 0);
    for s in 0..seeds.count {
        stack.waiting[s + 1] = (EXCLUDED, 0, seeds.bundles[s]);
    }
    stack.length = seeds.count + 1;
    while let Some((bound, height, node)) = stack.pop() {
        if bound > limit {
            continue;
        }
        if height > 0 {
            let boxes: &Boxes = &hierarchy.heights[height as usize - 1][node as usize];
            let bounds = boxes.key_bounds::<LUMEN_FIRST>(tile, rule);
            stack.push_nodes(tile, &bounds, limit, [height - 1, node * FAN as u32]);
        } else if bound <= EXCLUDED || !seeds.contains(node) {
            let bundle = &hierarchy.bundles[node as usize];
            let found = candidates::<LUMEN_FIRST>(tile, bundle, rule, &limits);
            for pair in places(found.stripes) {
                envelope.part(tile, pair / FAN).offer_stripe::<LUMEN_FIRST>(bundle, pair % FAN, rule);
            }
            for pair in places(found.wedges) {
                envelope.part(tile, pair / FAN).offer_wedge::<LUMEN_FIRST>(bundle, pair % FAN, rule);
            }
            for p in 0..PARTS {
                limits[p] = rule.limit(largest(&envelope.key.as_chunks::<PART_PIXELS>().0[p]));
            }
            limit = larger(limits[0], limits[1]);
        }
    }
}

/// Lowers squared distances to those of the nearest segments. `nearest` starts as any point of the segments,
/// such as the previous tile's nearest, and becomes this tile's.
#[inline(always)]
pub(crate) fn smallest_distances(
    hierarchy: &Hierarchy,
    tile: &Tile,
    nearest: &mut NearestPoint,
    squared: &mut [f32; PIXELS],
) {
    let mut stack = Stack::root(hierarchy, 0.0);
    *nearest = nearest.seen_from(tile);
    let mut limit = nearest.distance + tile.radius;
    while let Some((bound, height, node)) = stack.pop() {
        if bound > limit * limit {
            continue;
        }
        if height > 0 {
            let bounds = hierarchy.heights[height as usize - 1][node as usize].squared_distances(&tile.area);
            stack.push_nodes(tile, &bounds, limit * limit, [height - 1, node * FAN as u32]);
        } else {
            let bundle = &hierarchy.bundles[node as usize];
            if nearest.approach(tile, bundle) {
                limit = nearest.distance + tile.radius;
            }
            for s in places(nearest.rivals(tile, bundle)) {
                lower_distance(tile, squared, bundle, s);
            }
        }
    }
}
