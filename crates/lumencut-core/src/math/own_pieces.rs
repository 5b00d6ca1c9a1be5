//! What the winner of a pixel decides, and the pieces of its own vessel at coarser levels: the one whose arc length is
//! nearest to the winner's.

use super::candidates::Cover;
use super::cost::Rule;
use super::lanes::{PIXELS, SETTLED, UNSET, larger, largest};
use super::pieces::{Envelope, Foot};
use super::projection::{Level, Projected};
use super::tile::Tile;

/// How many slots to each side of the first one are searched for a whole group of pixels.
const GROUP_SLOTS: usize = 8;

/// What was decided for each pixel of a tile, once, on the finest level.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Decision {
    /// The vessel.
    pub vessel: [i32; PIXELS],
    /// Where along it the pixel looks (mm).
    pub arc_length: [f32; PIXELS],
    /// How far the pixel lies beyond the vessel's wall (mm); 0 within.
    pub beyond_wall: [f32; PIXELS],
    /// The radius of the vessel there (mm).
    pub radius: [f32; PIXELS],
    /// How the depth changes to the right and upwards (mm per mm).
    pub slope: [[f32; PIXELS]; 2],
}

impl Decision {
    /// What the winners of the finest level decide.
    #[inline(always)]
    pub fn of<const LUMEN_FIRST: bool>(
        winners: &Envelope,
        level: &Level,
        projected: &[Projected],
        tile: &Tile,
        rule: &Rule,
    ) -> Self {
        let zero = [0.0; PIXELS];
        let mut decision =
            Self { vessel: [0; PIXELS], arc_length: zero, beyond_wall: zero, radius: zero, slope: [zero; 2] };
        for l in 0..PIXELS {
            let (slot, is_stripe) = ((winners.piece[l] / 2) as usize, winners.piece[l] % 2 == 1);
            let (x, y, here) = (tile.x[l], tile.y[l], &projected[slot]);
            decision.vessel[l] = level.vessel_of_slot[slot];
            let (distance, t, next) = if is_stripe {
                let Foot { t, distance, .. } = here.stripe(&projected[slot + 1]).foot(x, y);
                (distance, t, slot + 1)
            } else {
                (here.wedge().cover(x, y).1, 0.0, slot)
            };
            let end = &projected[next];
            let slope = here.slope(end);
            let radius = here.radius + t * (end.radius - here.radius);
            decision.radius[l] = radius;
            decision.beyond_wall[l] = rule.beyond_wall::<LUMEN_FIRST>(winners.key[l], distance, radius);
            decision.arc_length[l] =
                level.arc_length[slot] + t * (level.arc_length[next] - level.arc_length[slot]);
            (decision.slope[0][l], decision.slope[1][l]) = (slope[0], slope[1]);
        }
        decision
    }
}

/// For each pixel of a tile, the piece of its own vessel at a level so far whose arc length is nearest.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct NearestPieces {
    /// How far the piece is from the winner along the vessel (mm).
    apart: [f32; PIXELS],
    /// From the winner to the piece along the vessel (mm).
    pub along: [f32; PIXELS],
    /// What the piece costs, for pieces equally far.
    cost: [f32; PIXELS],
    /// Twice its slot, plus 1 for the stripe: the order of the pieces that cost the same.
    piece: [u32; PIXELS],
    /// Its depth (mm).
    pub z: [f32; PIXELS],
    /// How the depth changes to the right and upwards (mm per mm).
    pub slope: [[f32; PIXELS]; 2],
}

impl NearestPieces {
    /// None yet where the level has weight; nothing is looked for elsewhere.
    #[inline(always)]
    pub fn new(weight: &[f32; PIXELS]) -> Self {
        let zero = [0.0; PIXELS];
        let mut apart = zero;
        for l in 0..PIXELS {
            apart[l] = if weight[l] > 0.0 { UNSET } else { SETTLED };
        }
        Self { apart, along: zero, cost: zero, piece: [u32::MAX; PIXELS], z: zero, slope: [zero; 2] }
    }

    /// Takes a piece at pixel `l` where it is covered and nearer than the one so far.
    #[inline(always)]
    fn offer(&mut self, l: usize, covered: bool, offered: Offered) {
        let Offered { along, cost, piece, z, slope } = offered;
        let apart = along.abs();
        let first = (cost < self.cost[l]) | ((cost == self.cost[l]) & (piece < self.piece[l]));
        let wins = covered & ((apart < self.apart[l]) | ((apart == self.apart[l]) & first));
        self.apart[l] = if wins { apart } else { self.apart[l] };
        self.along[l] = if wins { along } else { self.along[l] };
        self.cost[l] = if wins { cost } else { self.cost[l] };
        self.piece[l] = if wins { piece } else { self.piece[l] };
        self.z[l] = if wins { z } else { self.z[l] };
        self.slope[0][l] = if wins { slope[0] } else { self.slope[0][l] };
        self.slope[1][l] = if wins { slope[1] } else { self.slope[1][l] };
    }
}

/// A piece that is offered to a pixel.
struct Offered {
    along: f32,
    cost: f32,
    piece: u32,
    z: f32,
    slope: [f32; 2],
}

/// The pieces of all vessels at one level, in their order.
#[derive(Clone, Copy)]
pub struct OwnPieces<'a> {
    /// The level.
    pub level: &'a Level,
    /// Its slots in projection.
    pub projected: &'a [Projected],
    /// The rule that says what pieces cost.
    pub rule: &'a Rule,
}

impl OwnPieces<'_> {
    /// Finds for every wanted pixel the piece of its own vessel whose arc length is nearest.
    #[inline(always)]
    pub fn find(&self, tile: &Tile, decision: &Decision, nearest: &mut NearestPieces) {
        let mut is_open = [false; PIXELS];
        for l in 0..PIXELS {
            is_open[l] = nearest.apart[l] > 0.0;
        }
        while let Some(seed) = is_open.iter().position(|is_open| *is_open) {
            let group = self.group(decision, seed);
            let mut is_member = [false; PIXELS];
            for l in 0..PIXELS {
                let (vessel, s) = (decision.vessel[l], decision.arc_length[l]);
                is_member[l] = is_open[l] & (vessel == group.vessel) & (s >= group.low) & (s <= group.high);
                is_open[l] &= !is_member[l];
            }
            // Whatever the rounding at the ends of the group.
            is_member[seed] = true;
            is_open[seed] = false;
            self.search(tile, decision, &group, &is_member, nearest);
        }
    }

    /// The slots around the place of one pixel on its vessel.
    #[inline(always)]
    fn group(&self, decision: &Decision, seed: usize) -> Group {
        let (vessel, s) = (decision.vessel[seed], decision.arc_length[seed]);
        let [first, end] = [vessel, vessel + 1].map(|id| self.level.first_slot[id as usize] as usize);
        let arc_length = &self.level.arc_length[first..end];
        let middle = first + arc_length.partition_point(|at| *at <= s).saturating_sub(1);
        let (lowest, highest) = (middle.saturating_sub(GROUP_SLOTS).max(first), middle + GROUP_SLOTS);
        let low = if lowest == first { -UNSET } else { self.level.arc_length[lowest] };
        let high = if highest >= end - 1 { UNSET } else { self.level.arc_length[highest] };
        Group { vessel, first, end, middle, low, high }
    }

    /// Offers slots from the middle of a group outwards, until no slot farther out can be nearer to any member.
    #[inline(always)]
    fn search(
        &self,
        tile: &Tile,
        decision: &Decision,
        group: &Group,
        is_member: &[bool; PIXELS],
        nearest: &mut NearestPieces,
    ) {
        let arc_length = &self.level.arc_length;
        let mut reach = nearest.reach(decision, is_member);
        // What is left: the slots before `left`, and those from `right` on.
        let (mut left, mut right) = (group.middle, group.middle);
        loop {
            let is_left = left > group.first && arc_length[left] >= reach[0];
            let is_right = right < group.end && arc_length[right] <= reach[1];
            if !(is_left | is_right) {
                return;
            }
            let mut was_offered = false;
            if is_right {
                was_offered |= self.offer_within(tile, decision, right, nearest);
                right += 1;
            }
            if is_left {
                left -= 1;
                was_offered |= self.offer_within(tile, decision, left, nearest);
            }
            if was_offered {
                reach = nearest.reach(decision, is_member);
            }
        }
    }

    /// Offers those pieces of a slot that may cover a pixel of the tile; tells whether there was one.
    #[inline(always)]
    fn offer_within(
        &self,
        tile: &Tile,
        decision: &Decision,
        slot: usize,
        nearest: &mut NearestPieces,
    ) -> bool {
        let here = &self.projected[slot];
        let end = &self.projected[slot + usize::from(here.has_stripe())];
        let ends = [here, end].map(|p| [p.point[0], p.point[1]]);
        let cover = Cover::new(&tile.area, ends, here.edge, here.before);
        let (stripe, wedge) = (here.has_stripe() & cover.in_stripe, here.stands & cover.in_wedge);
        if stripe {
            self.offer_stripe(tile, decision, slot, nearest);
        }
        if wedge {
            self.offer_wedge(tile, decision, slot, nearest);
        }
        stripe | wedge
    }

    /// Offers every piece of every slot: the reference.
    #[inline(always)]
    pub fn offer_all(&self, tile: &Tile, decision: &Decision, nearest: &mut NearestPieces) {
        for slot in 0..self.projected.len() {
            let (here, vessel) = (&self.projected[slot], self.level.vessel_of_slot[slot]);
            let mut is_wanted = false;
            for l in 0..PIXELS {
                is_wanted |= decision.vessel[l] == vessel;
            }
            if is_wanted & here.has_stripe() {
                self.offer_stripe(tile, decision, slot, nearest);
            }
            if is_wanted & here.stands {
                self.offer_wedge(tile, decision, slot, nearest);
            }
        }
    }

    #[inline(always)]
    fn offer_stripe(&self, tile: &Tile, decision: &Decision, slot: usize, nearest: &mut NearestPieces) {
        let (here, end) = (&self.projected[slot], &self.projected[slot + 1]);
        let (stripe, slope) = (here.stripe(end), here.slope(end));
        let (z0, dz) = (here.point[2], end.point[2] - here.point[2]);
        let (r0, dr) = (here.radius, end.radius - here.radius);
        let s0 = self.level.arc_length[slot];
        let ds = self.level.arc_length[slot + 1] - s0;
        let (vessel, piece) = (self.level.vessel_of_slot[slot], slot as u32 * 2 + 1);
        for l in 0..PIXELS {
            let Foot { covered, t, distance } = stripe.foot(tile.x[l], tile.y[l]);
            let z = z0 + t * dz;
            let cost = self.rule.key::<false>(z, distance, r0 + t * dr);
            let along = (s0 + t * ds) - decision.arc_length[l];
            let is_own = decision.vessel[l] == vessel;
            nearest.offer(l, covered & is_own, Offered { along, cost, piece, z, slope });
        }
    }

    #[inline(always)]
    fn offer_wedge(&self, tile: &Tile, decision: &Decision, slot: usize, nearest: &mut NearestPieces) {
        let (here, wedge) = (&self.projected[slot], self.projected[slot].wedge());
        let (z, s, slope) = (here.point[2], self.level.arc_length[slot], [0.0; 2]);
        let (vessel, piece) = (self.level.vessel_of_slot[slot], slot as u32 * 2);
        for l in 0..PIXELS {
            let (covered, distance) = wedge.cover(tile.x[l], tile.y[l]);
            let cost = self.rule.key::<false>(z, distance, here.radius);
            let along = s - decision.arc_length[l];
            let is_own = decision.vessel[l] == vessel;
            nearest.offer(l, covered & is_own, Offered { along, cost, piece, z, slope });
        }
    }
}

/// Pixels of one vessel that look at about the same place on it.
struct Group {
    vessel: i32,
    /// The first slot of the vessel, and the one after its last.
    first: usize,
    end: usize,
    /// The slot that the search begins at.
    middle: usize,
    /// The arc lengths that belong to the group (mm).
    low: f32,
    high: f32,
}

impl NearestPieces {
    /// Between which arc lengths (mm) a piece can still be nearer to a member, and a little more than rounding.
    #[inline(always)]
    fn reach(&self, decision: &Decision, is_member: &[bool; PIXELS]) -> [f32; 2] {
        let (mut low, mut high) = ([SETTLED; PIXELS], [SETTLED; PIXELS]);
        for l in 0..PIXELS {
            let (s, apart) = (decision.arc_length[l], self.apart[l]);
            low[l] = if is_member[l] { apart - s } else { SETTLED };
            high[l] = if is_member[l] { apart + s } else { SETTLED };
        }
        let (low, high) = (largest(&low), largest(&high));
        let slack = 1e-6 * larger(low.abs(), high.abs());
        [-low - slack, high + slack]
    }
}
