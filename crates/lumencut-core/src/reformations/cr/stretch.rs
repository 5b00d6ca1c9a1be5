//! The search for the nearest piece of one stretch of the tree, for one pixel.

use super::view::{CrView, Seen};
use crate::math::lanes::FAN;
use crate::math::nearest::squared_distances_to_segments;
use crate::math::tile::Area;

/// Nodes that can wait: fifteen brothers on each of eight heights, and one more.
const STACK: usize = 8 * FAN;

/// The search for the piece nearest to a pixel in the image among those within the threshold of a place along the tree: the
/// nodes of the hierarchy from the nearest one on, as far as they are nearer than the best piece so far.
pub(super) struct StretchSearch<'a> {
    view: &'a CrView<'a>,
    pixel: [f32; 2],
    /// The place: a vessel and an arc length (mm).
    middle: (i32, f32),
    best: Seen,
    /// The squared distance (mm²) beyond which nothing is nearer than the best one.
    limit: f32,
    waiting: [(f32, u32, u32); STACK],
    count: usize,
}

impl<'a> StretchSearch<'a> {
    /// The search around `front`, as the pixel at (x, y) sees it: the best piece so far.
    pub fn new(view: &'a CrView<'a>, front: Seen, pixel: [f32; 2]) -> Self {
        let mut search = Self {
            view,
            pixel,
            middle: front.place(),
            best: front,
            limit: 0.0,
            waiting: [(0.0, 0, 0); STACK],
            count: 1,
        };
        search.waiting[0] = (0.0, view.plane.heights.len() as u32, 0);
        search.take(front);
        search
    }

    /// The nearest piece; of those equally near the first one.
    #[inline(never)]
    pub fn nearest(mut self) -> Seen {
        while self.count > 0 {
            self.count -= 1;
            let (squared, height, node) = self.waiting[self.count];
            if squared > self.limit {
                continue;
            }
            if height > 0 { self.open(height - 1, node) } else { self.meet(node) }
        }
        self.best
    }

    fn take(&mut self, seen: Seen) {
        let reach = seen.distance + self.view.plane_rule.distance_slack;
        (self.best, self.limit) = (seen, reach * reach);
    }

    /// Lets the nodes of a set of boxes wait, the nearest on top.
    fn open(&mut self, height: u32, node: u32) {
        let area = Area { center: self.pixel, half: [0.0; 2] };
        let bounds = self.view.plane.heights[height as usize][node as usize].squared_distances(&area);
        let base = self.count;
        for n in (0..FAN).filter(|n| bounds[*n] <= self.limit) {
            let mut at = self.count;
            while at > base && self.waiting[at - 1].0 < bounds[n] {
                self.waiting[at] = self.waiting[at - 1];
                at -= 1;
            }
            self.waiting[at] = (bounds[n], height, node * FAN as u32 + n as u32);
            self.count += 1;
        }
    }

    /// Meets the pieces of a bundle.
    fn meet(&mut self, bundle: u32) {
        let (view, [x, y]) = (self.view, self.pixel);
        let bundle = &view.plane.bundles[bundle as usize];
        let squared = squared_distances_to_segments(bundle, x, y);
        for s in 0..FAN {
            if squared[s] > self.limit {
                continue;
            }
            for piece in [2 * bundle.slot[s], 2 * bundle.slot[s] + 1] {
                let seen = view.seen(piece, x, y);
                let is_nearer = (seen.distance, seen.piece) < (self.best.distance, self.best.piece);
                if seen.is_covered && is_nearer && view.connections.are_near(self.middle, seen.place()) {
                    self.take(seen);
                }
            }
        }
    }
}
