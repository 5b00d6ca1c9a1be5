//! The distance of pixels to the nearest wall of any vessel, in the view plane. In projection a vessel is the union
//! of the discs around the points of its centerline. The distance to its outline therefore never jumps and has a
//! slope of at most 1, however the radius changes along the vessel.

use super::hierarchy::{Boxes, Hierarchy};
use super::lanes::{ABSENT, FAN, FAR, PIXELS, larger, largest, places, smaller};
use super::nearest::squared_distances_to_segments;
use super::pieces::Bundle;
use super::tile::Tile;
use super::walk::Stack;

/// The range of distances that must be exact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallRange {
    /// Distances below this (mm) count as this.
    pub near: f32,
    /// Distances above this (mm) count as this.
    pub far: f32,
    /// A bound on the rounding error of a projected distance (mm).
    pub slack: f32,
}

/// The largest `lean`; at a larger one, the same end of the segment is nearest for every pixel.
pub const MAX_LEAN: f32 = 1e6;

/// Lowers the distances of pixels from the wall (mm, negative within) to that from the segment of slot `s`. The
/// nearest outline of a tapering segment belongs to a disc on the segment. Its centre is shifted from the point
/// nearest to the pixel, by the lean times the pixel's distance from the line.
#[inline(always)]
fn lower_beyond(tile: &Tile, beyond: &mut [f32; PIXELS], bundle: &Bundle, s: usize) {
    let (x, y) = (bundle.x[s], bundle.y[s]);
    let (ex, ey) = (bundle.edge_x[s], bundle.edge_y[s]);
    let per_square = bundle.inverse_length[s] * bundle.inverse_length[s];
    let (radius, change) = (bundle.radius[s], bundle.radius_change[s]);
    let lean = lean(change * bundle.inverse_length[s]) * per_square;
    for l in 0..PIXELS {
        let (ux, uy) = (tile.x[l] - x, tile.y[l] - y);
        let aside = (ux * ey - uy * ex).abs();
        let t = smaller(larger((ux * ex + uy * ey) * per_square + aside * lean, 0.0), 1.0);
        let (dx, dy) = (ux - t * ex, uy - t * ey);
        let distance = (dx * dx + dy * dy).sqrt();
        beyond[l] = smaller(distance - (radius + t * change), beyond[l]);
    }
}

/// Shift of the nearest disc along the segment per mm of distance from its line; `taper` is in mm of radius per mm.
#[inline(always)]
fn lean(taper: f32) -> f32 {
    let rest = larger(1.0 - taper * taper, 1.0 / (MAX_LEAN * MAX_LEAN));
    smaller(larger(taper / rest.sqrt(), -MAX_LEAN), MAX_LEAN)
}

/// Lowers the distances (mm, negative within) to the nearest wall, only of chosen vessels if `OF_FIRST`. The
/// search ends beyond `range.far`, and once all pixels are within `range.near`.
#[inline(always)]
pub(crate) fn nearest_walls<const OF_FIRST: bool>(
    hierarchy: &Hierarchy,
    tile: &Tile,
    range: &WallRange,
    beyond: &mut [f32; PIXELS],
) {
    let mut stack = Stack::root(hierarchy, -FAR);
    let mut limit = range.far;
    while let Some((bound, height, node)) = stack.pop() {
        if bound > limit {
            continue;
        }
        if height > 0 {
            let bounds = hierarchy.heights[height as usize - 1][node as usize]
                .wall_bounds::<OF_FIRST>(tile, range.slack);
            stack.push_nodes(tile, &bounds, limit, [height - 1, node * FAN as u32]);
            continue;
        }
        let bundle = &hierarchy.bundles[node as usize];
        let bounds = segment_bounds::<OF_FIRST>(bundle, tile, range.slack);
        for s in places(tile.bits.within(&bounds, limit)) {
            lower_beyond(tile, beyond, bundle, s);
        }
        let farthest = largest(beyond);
        // Once all pixels are near enough, no node can matter.
        limit = if farthest <= range.near { -2.0 * FAR } else { smaller(farthest, range.far) };
    }
}

#[inline(always)]
fn segment_bounds<const OF_FIRST: bool>(bundle: &Bundle, tile: &Tile, slack: f32) -> [f32; FAN] {
    let [cx, cy] = tile.area.center;
    let mut bounds = squared_distances_to_segments(bundle, cx, cy);
    for s in 0..FAN {
        let widest = bundle.radius[s] + larger(bundle.radius_change[s], 0.0);
        let bound = bounds[s].sqrt() - tile.radius - widest - slack;
        bounds[s] = if OF_FIRST & (bundle.tiers[s] <= 0.0) { ABSENT } else { bound };
    }
    bounds
}

impl Boxes {
    #[inline(always)]
    fn wall_bounds<const OF_FIRST: bool>(&self, tile: &Tile, slack: f32) -> [f32; FAN] {
        let mut bounds = self.squared_distances(&tile.area);
        let widest = self.largest_radii();
        for n in 0..FAN {
            let bound = bounds[n].sqrt() - widest[n] - slack;
            bounds[n] = if OF_FIRST & !self.has_first(n) { ABSENT } else { bound };
        }
        bounds
    }
}
