//! The pieces of a local surface (stripe, wedge, end half-plane, full plane) and their evaluation over a tile.
//!
//! Every piece belongs to a *slot*. Each point of a level has one slot, with the stripe from this point to the
//! next, and the wedge at the point. Half-planes and full planes are wedges with missing edges. With edges f
//! before and e after the point p, a wedge covers the pixel q if (q − p)·f ≥ 0 and (q − p)·e ≤ 0; a missing
//! edge is zero. Neighbouring pieces compare the same numbers, so no pixel falls between them by rounding.

use super::cost::Rule;
use super::lanes::{ABSENT, EXCLUDED, FAN, FAR, PART_PIXELS, PIXELS, UNSET, smaller};
use super::tile::Tile;

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Bundle {
    /// The slot's point, view x and y (mm).
    pub x: [f32; FAN],
    pub y: [f32; FAN],
    /// The next point; the same point in a slot without stripe.
    pub next_x: [f32; FAN],
    pub next_y: [f32; FAN],
    /// e: the edge to the next point; zero if missing or collinear with the view.
    pub edge_x: [f32; FAN],
    pub edge_y: [f32; FAN],
    /// f: the edge before the point; zero if missing.
    pub before_x: [f32; FAN],
    pub before_y: [f32; FAN],
    /// 1 / |e|; zero if e is zero.
    pub inverse_length: [f32; FAN],
    /// Depth of the stripe at its start (mm), [`ABSENT`] without stripe.
    pub stripe_z: [f32; FAN],
    pub stripe_dz: [f32; FAN],
    /// Depth of the wedge (mm), [`ABSENT`] without one.
    pub wedge_z: [f32; FAN],
    pub radius: [f32; FAN],
    pub radius_change: [f32; FAN],
    /// Number of tiers before lumen and wall of other vessels ([`Rule::key`]): 2 for chosen vessels, else 0.
    pub tiers: [f32; FAN],
    /// The slot's number in its level; rises along each vessel and from vessel to vessel.
    pub slot: [u32; FAN],
}

impl Bundle {
    pub(crate) const EMPTY: Self = Self {
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
        tiers: [0.0; FAN],
        slot: [u32::MAX; FAN],
    };
}

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Envelope {
    pub key: [f32; PIXELS],
    pub z: [f32; PIXELS],
    /// Twice the slot of the piece, plus 1 for a stripe; of equal keys the smaller number wins.
    pub piece: [u32; PIXELS],
}

impl Envelope {
    #[inline(always)]
    pub(crate) fn new(weight: &[f32; PIXELS]) -> Self {
        let mut key = [EXCLUDED; PIXELS];
        for l in 0..PIXELS {
            key[l] = if weight[l] > 0.0 { UNSET } else { EXCLUDED };
        }
        Self { key, z: [0.0; PIXELS], piece: [u32::MAX; PIXELS] }
    }

    #[inline(always)]
    pub(crate) fn part<'a>(&'a mut self, tile: &'a Tile, p: usize) -> Pixels<'a, PART_PIXELS> {
        Pixels {
            x: &tile.x.as_chunks().0[p],
            y: &tile.y.as_chunks().0[p],
            key: &mut self.key.as_chunks_mut().0[p],
            z: &mut self.z.as_chunks_mut().0[p],
            piece: &mut self.piece.as_chunks_mut().0[p],
        }
    }

    #[inline(always)]
    pub(crate) fn whole<'a>(&'a mut self, tile: &'a Tile) -> Pixels<'a, PIXELS> {
        Pixels { x: &tile.x, y: &tile.y, key: &mut self.key, z: &mut self.z, piece: &mut self.piece }
    }
}

/// Some pixels of a tile (view x and y, mm), and the piece with the smallest key so far at each (its winner).
pub(crate) struct Pixels<'a, const N: usize> {
    x: &'a [f32; N],
    y: &'a [f32; N],
    key: &'a mut [f32; N],
    z: &'a mut [f32; N],
    piece: &'a mut [u32; N],
}

impl<const N: usize> Pixels<'_, N> {
    #[inline(always)]
    pub(crate) fn offer(&mut self, l: usize, covered: bool, key: f32, z: f32, piece: u32) {
        let (old_key, old_z, old_piece) = (self.key[l], self.z[l], self.piece[l]);
        let wins = covered & ((key < old_key) | ((key == old_key) & (piece < old_piece)));
        self.key[l] = if wins { key } else { old_key };
        self.z[l] = if wins { z } else { old_z };
        self.piece[l] = if wins { piece } else { old_piece };
    }

    #[inline(always)]
    pub(crate) fn offer_stripe<const LUMEN_FIRST: bool>(&mut self, bundle: &Bundle, s: usize, rule: &Rule) {
        let stripe = Stripe::new(
            [bundle.x[s], bundle.y[s]],
            [bundle.next_x[s], bundle.next_y[s]],
            [bundle.edge_x[s], bundle.edge_y[s]],
            bundle.inverse_length[s],
        );
        let (z0, dz) = (bundle.stripe_z[s], bundle.stripe_dz[s]);
        let (r0, dr, tiers) = (bundle.radius[s], bundle.radius_change[s], bundle.tiers[s]);
        let piece = bundle.slot[s] * 2 + 1;
        for l in 0..N {
            let Foot { covered, t, distance } = stripe.foot(self.x[l], self.y[l]);
            let z = z0 + t * dz;
            let key = rule.key::<LUMEN_FIRST>(z, distance, r0 + t * dr, tiers);
            self.offer(l, covered, key, z, piece);
        }
    }

    #[inline(always)]
    pub(crate) fn offer_wedge<const LUMEN_FIRST: bool>(&mut self, bundle: &Bundle, s: usize, rule: &Rule) {
        let wedge = Wedge {
            point: [bundle.x[s], bundle.y[s]],
            before: [bundle.before_x[s], bundle.before_y[s]],
            edge: [bundle.edge_x[s], bundle.edge_y[s]],
        };
        let (z, r, tiers) = (bundle.wedge_z[s], bundle.radius[s], bundle.tiers[s]);
        let piece = bundle.slot[s] * 2;
        for l in 0..N {
            let (covered, distance) = wedge.cover(self.x[l], self.y[l]);
            let key = rule.key::<LUMEN_FIRST>(z, distance, r, tiers);
            self.offer(l, covered, key, z, piece);
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Stripe {
    start: [f32; 2],
    end: [f32; 2],
    edge: [f32; 2],
    unit: [f32; 2],
    per_square: f32,
}

#[derive(Clone, Copy, Debug)]
pub struct Foot {
    pub covered: bool,
    /// Share of the stripe before the point nearest to the pixel; 0 to 1 if the stripe covers the pixel.
    pub t: f32,
    pub distance: f32,
}

impl Stripe {
    #[inline(always)]
    pub(crate) fn new(start: [f32; 2], end: [f32; 2], edge: [f32; 2], inverse_length: f32) -> Self {
        let unit = [edge[0] * inverse_length, edge[1] * inverse_length];
        Self { start, end, edge, unit, per_square: inverse_length * inverse_length }
    }

    #[inline(always)]
    pub fn foot(&self, x: f32, y: f32) -> Foot {
        let [ex, ey] = self.edge;
        let (ux, uy) = (x - self.start[0], y - self.start[1]);
        let after_start = ux * ex + uy * ey;
        let beyond_end = (x - self.end[0]) * ex + (y - self.end[1]) * ey;
        Foot {
            covered: (after_start >= 0.0) & (beyond_end <= 0.0),
            // Rounding must not move t beyond the end, where no bounds of depth and radius hold.
            t: smaller(after_start * self.per_square, 1.0),
            distance: (ux * self.unit[1] - uy * self.unit[0]).abs(),
        }
    }
}

/// The kinds of pieces, as numbers of `Frame.piece`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Stripe = 0,
    Wedge = 1,
    HalfPlane = 2,
    FullPlane = 3,
}

#[derive(Clone, Copy, Debug)]
pub struct Wedge {
    pub point: [f32; 2],
    /// f: the edge before the point; zero if missing.
    pub before: [f32; 2],
    /// e: the edge after the point; zero if missing.
    pub edge: [f32; 2],
}

impl Wedge {
    /// Whether the wedge covers the pixel at (x, y), and the distance of the pixel from its point (mm).
    #[inline(always)]
    pub fn cover(&self, x: f32, y: f32) -> (bool, f32) {
        let (ux, uy) = (x - self.point[0], y - self.point[1]);
        let beyond_before = ux * self.before[0] + uy * self.before[1];
        let after_start = ux * self.edge[0] + uy * self.edge[1];
        ((beyond_before >= 0.0) & (after_start <= 0.0), (ux * ux + uy * uy).sqrt())
    }

    pub fn kind(&self) -> Kind {
        match [self.before, self.edge].map(|edge| edge == [0.0; 2]) {
            [false, false] => Kind::Wedge,
            [true, true] => Kind::FullPlane,
            _ => Kind::HalfPlane,
        }
    }
}
