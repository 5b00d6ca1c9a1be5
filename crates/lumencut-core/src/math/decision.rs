//! What the winning piece decides for its pixel: vessel, arc length, and distance beyond the wall.

use super::cost::Rule;
use super::lanes::{PART_PIXELS, PIXELS};
use super::pieces::{Envelope, Stripe, Wedge};
use super::projection::Projected;
use super::tile::{Area, Tile};

/// The decision for each pixel of a tile; it is made once, on the finest level.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Decision {
    pub vessel: [i32; PIXELS],
    pub arc_length: [f32; PIXELS],
    pub beyond_wall: [f32; PIXELS],
    pub radius: [f32; PIXELS],
    pub is_lumen: [bool; PIXELS],
    pub is_first: [bool; PIXELS],
    /// Change of depth to the right and upwards (mm per mm).
    pub slope: [[f32; PIXELS]; 2],
}

impl Decision {
    #[inline(always)]
    pub(crate) fn of<const LUMEN_FIRST: bool>(
        winners: &Envelope,
        projected: &[Projected],
        tile: &Tile,
        rule: &Rule,
    ) -> Self {
        let zero = [0.0; PIXELS];
        let mut decision = Self {
            vessel: [0; PIXELS],
            arc_length: zero,
            beyond_wall: zero,
            radius: zero,
            is_lumen: [false; PIXELS],
            is_first: [false; PIXELS],
            slope: [zero; 2],
        };
        // First gathers all inputs, then computes: the compiler vectorises only a loop without gathering.
        let (mut starts, mut ends) = (Gathered::new(), Gathered::new());
        for l in 0..PIXELS {
            let (slot, is_stripe) = (winners.piece[l] / 2, winners.piece[l] % 2);
            let here = &projected[slot as usize];
            decision.vessel[l] = here.vessel;
            starts.put(l, here);
            // A wedge has no segment, so its end is its start.
            ends.put(l, &projected[(slot + is_stripe) as usize]);
        }
        for l in 0..PIXELS {
            let is_stripe = winners.piece[l] % 2 == 1;
            let (x, y, edge) = (tile.x[l], tile.y[l], [starts.edge[0][l], starts.edge[1][l]]);
            let [start, end] = [&starts, &ends].map(|g| [g.x[l], g.y[l]]);
            let inverse = starts.inverse_length[l];
            let foot = Stripe::new(start, end, edge, inverse).foot(x, y);
            let (_, from_point) = Wedge { point: start, before: [0.0; 2], edge }.cover(x, y);
            let t = if is_stripe { foot.t } else { 0.0 };
            let distance = if is_stripe { foot.distance } else { from_point };
            let radius = starts.radius[l] + t * (ends.radius[l] - starts.radius[l]);
            let per_mm = inverse * inverse * (ends.z[l] - starts.z[l]);
            decision.radius[l] = radius;
            decision.beyond_wall[l] = rule.beyond_wall::<LUMEN_FIRST>(winners.key[l], distance, radius);
            decision.is_lumen[l] = rule.is_lumen::<LUMEN_FIRST>(winners.key[l], distance, radius);
            decision.is_first[l] = LUMEN_FIRST && rule.is_first(winners.key[l]);
            decision.arc_length[l] = starts.arc_length[l] + t * (ends.arc_length[l] - starts.arc_length[l]);
            decision.slope[0][l] = edge[0] * per_mm;
            decision.slope[1][l] = edge[1] * per_mm;
        }
        decision
    }
}

impl Decision {
    /// Arc length and distance beyond the wall, as the stage `depth` stores them.
    #[inline(always)]
    pub(crate) fn foot(&self, l: usize) -> [f32; 4] {
        [self.arc_length[l], self.beyond_wall[l], 0.0, 0.0]
    }

    /// The radius as a sheet stores it: negative outside the lumen.
    #[inline(always)]
    pub(crate) fn sheet_radius(&self, l: usize) -> f32 {
        if self.is_lumen[l] { self.radius[l] } else { -self.radius[l] }
    }
}

#[repr(C, align(64))]
struct Gathered {
    x: [f32; PIXELS],
    y: [f32; PIXELS],
    z: [f32; PIXELS],
    radius: [f32; PIXELS],
    edge: [[f32; PIXELS]; 2],
    inverse_length: [f32; PIXELS],
    arc_length: [f32; PIXELS],
}

impl Gathered {
    #[inline(always)]
    fn new() -> Self {
        let zero = [0.0; PIXELS];
        Self {
            x: zero,
            y: zero,
            z: zero,
            radius: zero,
            edge: [zero; 2],
            inverse_length: zero,
            arc_length: zero,
        }
    }

    #[inline(always)]
    fn put(&mut self, l: usize, p: &Projected) {
        (self.x[l], self.y[l], self.z[l]) = (p.point[0], p.point[1], p.point[2]);
        (self.radius[l], self.arc_length[l]) = (p.radius, p.arc_length);
        (self.edge[0][l], self.edge[1][l]) = (p.edge[0], p.edge[1]);
        self.inverse_length[l] = p.inverse_length;
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Part<'a> {
    pub area: &'a Area,
    pub x: &'a [f32; PART_PIXELS],
    pub y: &'a [f32; PART_PIXELS],
    pub vessel: &'a [i32; PART_PIXELS],
    pub arc_length: &'a [f32; PART_PIXELS],
}

impl Decision {
    #[inline(always)]
    pub(crate) fn part<'a>(&'a self, tile: &'a Tile, p: usize) -> Part<'a> {
        Part {
            area: &tile.parts[p],
            x: &tile.x.as_chunks().0[p],
            y: &tile.y.as_chunks().0[p],
            vessel: &self.vessel.as_chunks().0[p],
            arc_length: &self.arc_length.as_chunks().0[p],
        }
    }
}
