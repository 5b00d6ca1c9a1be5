//! The pieces of a local surface (stripe, wedge, end half-plane, full plane) and their evaluation over a tile.
//!
//! Every piece belongs to a *slot*, one per point of a level: the stripe from this point to the next, and
//! what stands at the point itself. Wedge, half-plane and full plane are one form: with edges f before and e
//! after the point p, a pixel q is covered when (q − p)·f ≥ 0 and (q − p)·e ≤ 0, and an edge that is not
//! there is zero. A stripe reads the same two numbers at its ends that its neighbours read, so that whatever
//! the rounding, no pixel falls between them: (q − p₀)·e₀ ≤ 0 is the first half-plane, else stripe 0
//! takes the pixel unless (q − p₁)·e₀ > 0, else the wedge at p₁ does unless (q − p₁)·e₁ > 0, and so on.

use super::cost::Rule;
use super::lanes::{ABSENT, COLUMNS, FAN, FAR, PIXELS, ROWS, SETTLED, UNSET, gap, larger, smaller};
use crate::camera::Camera;

/// Sixteen slots in projection, field by field.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Bundle {
    /// The slot's point, view x and y (mm).
    pub x: [f32; FAN],
    #[allow(missing_docs)]
    pub y: [f32; FAN],
    /// The next point; the same point in a slot without stripe.
    pub next_x: [f32; FAN],
    #[allow(missing_docs)]
    pub next_y: [f32; FAN],
    /// e: the edge to the next point, zero where it is collinear with the view or not there.
    pub edge_x: [f32; FAN],
    #[allow(missing_docs)]
    pub edge_y: [f32; FAN],
    /// f: the edge before the point, zero where it is not there.
    pub before_x: [f32; FAN],
    #[allow(missing_docs)]
    pub before_y: [f32; FAN],
    /// 1 / |e|, zero with e.
    pub inverse_length: [f32; FAN],
    /// Depth of the stripe at its start (mm), [`ABSENT`] without stripe.
    pub stripe_z: [f32; FAN],
    /// Change of depth along the stripe (mm).
    pub stripe_dz: [f32; FAN],
    /// Depth of what stands at the point (mm), [`ABSENT`] where nothing does.
    pub wedge_z: [f32; FAN],
    /// Radius at the point (mm).
    pub radius: [f32; FAN],
    /// Change of radius along the stripe (mm).
    pub radius_change: [f32; FAN],
    /// The slot's number in its level: rises along each vessel and from vessel to vessel.
    pub slot: [u32; FAN],
}

impl Bundle {
    /// A bundle without pieces.
    pub const EMPTY: Self = Self {
        x: [FAR; FAN],
        y: [FAR; FAN],
        next_x: [FAR; FAN],
        next_y: [FAR; FAN],
        edge_x: [0.0; FAN],
        edge_y: [0.0; FAN],
        before_x: [0.0; FAN],
        before_y: [0.0; FAN],
        inverse_length: [0.0; FAN],
        stripe_z: [ABSENT; FAN],
        stripe_dz: [0.0; FAN],
        wedge_z: [ABSENT; FAN],
        radius: [0.0; FAN],
        radius_change: [0.0; FAN],
        slot: [u32::MAX; FAN],
    };
}

/// The pixel centres of a tile in view space (mm), and the box around them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Tile {
    /// View x of each pixel.
    pub x: [f32; PIXELS],
    /// View y of each pixel.
    pub y: [f32; PIXELS],
    /// Middle of the box.
    pub center: [f32; 2],
    /// Half the sides of the box.
    pub half: [f32; 2],
    /// Half the diagonal of the box.
    pub radius: f32,
}

impl Tile {
    /// The tile whose first pixel is (`i`, `j`); pixels beyond the image repeat its last column and row.
    #[inline(always)]
    pub fn new(camera: &Camera, i: usize, j: usize) -> Self {
        let [width, height] = camera.size();
        let columns: [f32; COLUMNS] = std::array::from_fn(|c| camera.view_x((i + c).min(width - 1)) as f32);
        let rows: [f32; ROWS] = std::array::from_fn(|r| camera.view_y((j + r).min(height - 1)) as f32);
        let middle = |values: &[f32]| (values[0] + values[values.len() - 1]) * 0.5;
        // Half the side, and a little more than the rounding of the middle.
        let half = |values: &[f32]| {
            let (first, last) = (values[0], values[values.len() - 1]);
            (last - first).abs() * 0.500_001 + 4e-7 * first.abs().max(last.abs())
        };
        let half = [half(&columns), half(&rows)];
        let (mut x, mut y) = ([0.0; PIXELS], [0.0; PIXELS]);
        for r in 0..ROWS {
            for c in 0..COLUMNS {
                x[r * COLUMNS + c] = columns[c];
                y[r * COLUMNS + c] = rows[r];
            }
        }
        let radius = (half[0] * half[0] + half[1] * half[1]).sqrt();
        Self { x, y, center: [middle(&columns), middle(&rows)], half, radius }
    }
}

/// The winner of each pixel of a tile so far.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Envelope {
    /// Its key.
    pub key: [f32; PIXELS],
    /// Its depth (mm).
    pub z: [f32; PIXELS],
    /// Twice its slot, plus 1 for the stripe: the order of the pieces on a tie.
    pub piece: [u32; PIXELS],
}

impl Envelope {
    /// No winner yet where the level has weight, settled elsewhere.
    #[inline(always)]
    pub fn new(weight: &[f32; PIXELS]) -> Self {
        let mut key = [SETTLED; PIXELS];
        for l in 0..PIXELS {
            key[l] = if weight[l] > 0.0 { UNSET } else { SETTLED };
        }
        Self { key, z: [0.0; PIXELS], piece: [u32::MAX; PIXELS] }
    }

    /// Takes the piece at pixel `l` where it is covered and wins.
    #[inline(always)]
    fn offer(&mut self, l: usize, covered: bool, key: f32, z: f32, piece: u32) {
        let (old_key, old_z, old_piece) = (self.key[l], self.z[l], self.piece[l]);
        let wins = covered & ((key < old_key) | ((key == old_key) & (piece < old_piece)));
        self.key[l] = if wins { key } else { old_key };
        self.z[l] = if wins { z } else { old_z };
        self.piece[l] = if wins { piece } else { old_piece };
    }

    /// Offers the stripe of slot `s` to every pixel.
    #[inline(always)]
    pub fn offer_stripe<const LUMEN_FIRST: bool>(
        &mut self,
        tile: &Tile,
        bundle: &Bundle,
        s: usize,
        rule: &Rule,
    ) {
        let (x, y) = (bundle.x[s], bundle.y[s]);
        let (next_x, next_y) = (bundle.next_x[s], bundle.next_y[s]);
        let (ex, ey) = (bundle.edge_x[s], bundle.edge_y[s]);
        let inverse = bundle.inverse_length[s];
        let (unit_x, unit_y) = (ex * inverse, ey * inverse);
        let per_square = inverse * inverse;
        let (z0, dz) = (bundle.stripe_z[s], bundle.stripe_dz[s]);
        let (r0, dr) = (bundle.radius[s], bundle.radius_change[s]);
        let piece = bundle.slot[s] * 2 + 1;
        for l in 0..PIXELS {
            let (ux, uy) = (tile.x[l] - x, tile.y[l] - y);
            let after_start = ux * ex + uy * ey;
            let beyond_end = (tile.x[l] - next_x) * ex + (tile.y[l] - next_y) * ey;
            // Rounding must not carry t past the end, where depth and radius were never bounded.
            let t = smaller(after_start * per_square, 1.0);
            let d = (ux * unit_y - uy * unit_x).abs();
            let z = z0 + t * dz;
            let key = rule.key::<LUMEN_FIRST>(z, d, r0 + t * dr);
            let covered = (after_start >= 0.0) & (beyond_end <= 0.0);
            self.offer(l, covered, key, z, piece);
        }
    }

    /// Offers the wedge, half-plane or plane of slot `s` to every pixel.
    #[inline(always)]
    pub fn offer_wedge<const LUMEN_FIRST: bool>(
        &mut self,
        tile: &Tile,
        bundle: &Bundle,
        s: usize,
        rule: &Rule,
    ) {
        let (x, y) = (bundle.x[s], bundle.y[s]);
        let (fx, fy) = (bundle.before_x[s], bundle.before_y[s]);
        let (ex, ey) = (bundle.edge_x[s], bundle.edge_y[s]);
        let (z, r) = (bundle.wedge_z[s], bundle.radius[s]);
        let piece = bundle.slot[s] * 2;
        for l in 0..PIXELS {
            let (ux, uy) = (tile.x[l] - x, tile.y[l] - y);
            let beyond_before = ux * fx + uy * fy;
            let after_start = ux * ex + uy * ey;
            let d = (ux * ux + uy * uy).sqrt();
            let key = rule.key::<LUMEN_FIRST>(z, d, r);
            let covered = (beyond_before >= 0.0) & (after_start <= 0.0);
            self.offer(l, covered, key, z, piece);
        }
    }
}

/// The smallest keys that the stripes and wedges of a bundle can reach in a tile; [`ABSENT`] where a
/// piece covers none of its pixels.
#[inline(always)]
pub fn piece_bounds<const LUMEN_FIRST: bool>(
    tile: &Tile,
    bundle: &Bundle,
    rule: &Rule,
) -> ([f32; FAN], [f32; FAN]) {
    let (mut stripe, mut wedge) = ([ABSENT; FAN], [ABSENT; FAN]);
    let ([cx, cy], [hx, hy]) = (tile.center, tile.half);
    for s in 0..FAN {
        let (ux, uy) = (cx - bundle.x[s], cy - bundle.y[s]);
        let (wx, wy) = (cx - bundle.next_x[s], cy - bundle.next_y[s]);
        let (ex, ey) = (bundle.edge_x[s], bundle.edge_y[s]);
        let (fx, fy) = (bundle.before_x[s], bundle.before_y[s]);
        // The most that (q − p)·e differs from its value at the middle, and a little more than its rounding.
        let reach = |a: f32, b: f32, u: f32, v: f32| {
            (hx + 1e-5 * u.abs()) * a.abs() + (hy + 1e-5 * v.abs()) * b.abs()
        };
        let start = ux * ex + uy * ey;
        let start_reach = reach(ex, ey, ux, uy);
        let end = wx * ex + wy * ey;
        let before = ux * fx + uy * fy;
        let in_stripe = (start + start_reach >= 0.0) & (end - reach(ex, ey, wx, wy) <= 0.0);
        let in_wedge = (before + reach(fx, fy, ux, uy) >= 0.0) & (start - start_reach <= 0.0);

        let (z0, z1) = (bundle.stripe_z[s], bundle.stripe_z[s] + bundle.stripe_dz[s]);
        let (r0, r1) = (bundle.radius[s], bundle.radius[s] + bundle.radius_change[s]);
        let gx = gap(smaller(ux, wx), larger(ux, wx), 0.0, hx);
        let gy = gap(smaller(uy, wy), larger(uy, wy), 0.0, hy);
        let along = (gx * gx + gy * gy).sqrt();
        let (px, py) = (gap(ux, ux, 0.0, hx), gap(uy, uy, 0.0, hy));
        let at = (px * px + py * py).sqrt();
        let stripe_bound = rule.bound::<LUMEN_FIRST>(smaller(z0, z1), along, larger(r0, r1));
        let wedge_bound = rule.bound::<LUMEN_FIRST>(bundle.wedge_z[s], at, r0);
        stripe[s] = if in_stripe { stripe_bound } else { ABSENT };
        wedge[s] = if in_wedge { wedge_bound } else { ABSENT };
    }
    (stripe, wedge)
}
