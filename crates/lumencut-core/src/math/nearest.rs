//! The distance of pixels to segments, and the choice of segments that can matter to a tile.

use super::lanes::{FAN, FAR, PIXELS, larger, smaller, smallest};
use super::pieces::Bundle;
use super::tile::Tile;

#[inline(always)]
pub(crate) fn lower_distance(tile: &Tile, squared: &mut [f32; PIXELS], bundle: &Bundle, s: usize) {
    let (x, y) = (bundle.x[s], bundle.y[s]);
    let (ex, ey) = (bundle.edge_x[s], bundle.edge_y[s]);
    let per_square = bundle.inverse_length[s] * bundle.inverse_length[s];
    for l in 0..PIXELS {
        let (ux, uy) = (tile.x[l] - x, tile.y[l] - y);
        let t = smaller(larger((ux * ex + uy * ey) * per_square, 0.0), 1.0);
        let (dx, dy) = (ux - t * ex, uy - t * ey);
        squared[l] = smaller(dx * dx + dy * dy, squared[l]);
    }
}

/// The point nearest to the middle of a tile, among all points on the segments met so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestPoint {
    /// The point's distance from the middle, plus a bound on its rounding (mm).
    pub distance: f32,
    x: f32,
    y: f32,
}

impl NearestPoint {
    #[inline(always)]
    pub(crate) fn unknown() -> Self {
        Self { distance: FAR, x: FAR, y: FAR }
    }

    #[inline(always)]
    pub(crate) fn seen_from(&self, tile: &Tile) -> Self {
        let [cx, cy] = tile.area.center;
        let (dx, dy) = (cx - self.x, cy - self.y);
        let distance = (dx * dx + dy * dy).sqrt() * 1.000_01 + slack(tile, self.x, self.y);
        Self { distance, ..*self }
    }

    /// Compares the segments of a bundle; returns whether one of them is nearer than the point so far.
    #[inline(always)]
    pub(crate) fn approach(&mut self, tile: &Tile, bundle: &Bundle) -> bool {
        let [cx, cy] = tile.area.center;
        let squared = squared_distances_to_segments(bundle, cx, cy);
        let least = smallest(&squared);
        let s = tile.bits.within(&squared, least).trailing_zeros() as usize % FAN;
        // Computed from the segment's start, because rounding at a distant tile would move the point off the segment.
        let t = foot(bundle, s, cx - bundle.x[s], cy - bundle.y[s]);
        let (x, y) = (bundle.x[s] + t * bundle.edge_x[s], bundle.y[s] + t * bundle.edge_y[s]);
        let distance = least.sqrt() * 1.000_01 + slack(tile, x, y);
        if distance >= self.distance {
            return false;
        }
        *self = Self { distance, x, y };
        true
    }

    /// The segments of a bundle that may be nearer than this point to some pixel of the tile.
    ///
    /// The positions nearer to a point than to a segment form a convex region (an intersection of
    /// half-planes): if it holds all four corners of the tile, it holds the tile. With the point known to ε,
    /// a segment must be farther by ε: (d + ε)² ≤ (1 + 10⁻⁵)·d² + (1 + 10⁵)·ε². This margin also holds
    /// between the corners, because the difference of squared distances is concave there.
    #[inline(always)]
    pub(crate) fn rivals(&self, tile: &Tile, bundle: &Bundle) -> u32 {
        let ([cx, cy], [hx, hy]) = (tile.area.center, tile.area.half);
        let epsilon = slack(tile, self.x, self.y);
        let margin = 1.1e5 * epsilon * epsilon;
        let mut lead = [FAR; FAN];
        for (sx, sy) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            let (x, y) = (cx + sx * hx, cy + sy * hy);
            let (px, py) = (x - self.x, y - self.y);
            let to_point = (px * px + py * py) * 1.000_011 + margin;
            for s in 0..FAN {
                let (dx, dy) = to_segment(bundle, s, x, y);
                lead[s] = smaller(lead[s], dx * dx + dy * dy - to_point);
            }
        }
        tile.bits.within(&lead, 0.0)
    }
}

/// A bound on the rounding of distances between a tile and the point (x, y) (mm).
#[inline(always)]
fn slack(tile: &Tile, x: f32, y: f32) -> f32 {
    let ([cx, cy], [hx, hy]) = (tile.area.center, tile.area.half);
    1e-6 * (cx.abs() + cy.abs() + hx + hy + x.abs() + y.abs()) + 1e-6
}

#[inline(always)]
pub(crate) fn squared_distances_to_segments(bundle: &Bundle, x: f32, y: f32) -> [f32; FAN] {
    let mut squared = [0.0; FAN];
    for s in 0..FAN {
        let (dx, dy) = to_segment(bundle, s, x, y);
        squared[s] = dx * dx + dy * dy;
    }
    squared
}

#[inline(always)]
fn to_segment(bundle: &Bundle, s: usize, x: f32, y: f32) -> (f32, f32) {
    let (ux, uy) = (x - bundle.x[s], y - bundle.y[s]);
    let t = foot(bundle, s, ux, uy);
    (ux - t * bundle.edge_x[s], uy - t * bundle.edge_y[s])
}

/// The position (0 to 1) on the segment of slot `s` that is nearest to the point at (ux, uy) from its start.
#[inline(always)]
fn foot(bundle: &Bundle, s: usize, ux: f32, uy: f32) -> f32 {
    let per_square = bundle.inverse_length[s] * bundle.inverse_length[s];
    smaller(larger((ux * bundle.edge_x[s] + uy * bundle.edge_y[s]) * per_square, 0.0), 1.0)
}
