//! The distance of pixels to segments, and which segments can matter to a tile.

use super::lanes::{FAN, FAR, PIXELS, larger, smaller, smallest};
use super::pieces::Bundle;
use super::tile::Tile;

/// Lowers each pixel's squared distance (mm²) to the segment of slot `s` where it is nearer.
#[inline(always)]
pub fn lower_distance(tile: &Tile, squared: &mut [f32; PIXELS], bundle: &Bundle, s: usize) {
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

/// The point of the segments met so far that is nearest to the middle of a tile.
#[derive(Clone, Copy, Debug)]
pub struct NearestPoint {
    /// Its distance from the middle (mm), and a little more than its rounding.
    pub distance: f32,
    x: f32,
    y: f32,
}

impl NearestPoint {
    /// No segment met yet.
    #[inline(always)]
    pub fn unknown() -> Self {
        Self { distance: FAR, x: FAR, y: FAR }
    }

    /// The same point as seen from the middle of another tile.
    #[inline(always)]
    pub fn seen_from(&self, tile: &Tile) -> Self {
        let [cx, cy] = tile.area.center;
        let (dx, dy) = (cx - self.x, cy - self.y);
        Self { distance: (dx * dx + dy * dy).sqrt() * 1.000_01 + 1e-5, ..*self }
    }

    /// Meets the segments of a bundle; tells whether one of them is nearer.
    #[inline(always)]
    pub fn approach(&mut self, tile: &Tile, bundle: &Bundle) -> bool {
        let [cx, cy] = tile.area.center;
        let (mut squared, mut dx, mut dy) = ([0.0; FAN], [0.0; FAN], [0.0; FAN]);
        for s in 0..FAN {
            (dx[s], dy[s]) = to_segment(bundle, s, cx, cy);
            squared[s] = dx[s] * dx[s] + dy[s] * dy[s];
        }
        let least = smallest(&squared);
        let distance = least.sqrt() * 1.000_01 + 1e-5;
        if distance >= self.distance {
            return false;
        }
        let s = tile.bits.within(&squared, least).trailing_zeros() as usize % FAN;
        *self = Self { distance, x: cx - dx[s], y: cy - dy[s] };
        true
    }

    /// The segments of a bundle that may be nearer than this point to some pixel of the tile.
    ///
    /// The places nearer to a point than to a segment form a convex region (an intersection of half-planes):
    /// where it holds all four corners of the tile, it holds the tile.
    #[inline(always)]
    pub fn rivals(&self, tile: &Tile, bundle: &Bundle) -> u32 {
        let ([cx, cy], [hx, hy]) = (tile.area.center, tile.area.half);
        let mut lead = [FAR; FAN];
        for (sx, sy) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            let (x, y) = (cx + sx * hx, cy + sy * hy);
            let (px, py) = (x - self.x, y - self.y);
            let to_point = (px * px + py * py) * 1.000_01 + 1e-6;
            for s in 0..FAN {
                let (dx, dy) = to_segment(bundle, s, x, y);
                lead[s] = smaller(lead[s], dx * dx + dy * dy - to_point);
            }
        }
        tile.bits.within(&lead, 0.0)
    }
}

/// From the nearest point of the segment in slot `s` to (x, y).
#[inline(always)]
fn to_segment(bundle: &Bundle, s: usize, x: f32, y: f32) -> (f32, f32) {
    let (ux, uy) = (x - bundle.x[s], y - bundle.y[s]);
    let (ex, ey) = (bundle.edge_x[s], bundle.edge_y[s]);
    let per_square = bundle.inverse_length[s] * bundle.inverse_length[s];
    let t = smaller(larger((ux * ex + uy * ey) * per_square, 0.0), 1.0);
    (ux - t * ex, uy - t * ey)
}
