//! Finds pieces of coarser levels near the winner (the piece that a pixel shows at the finest level) in arc length.

use super::candidates::Cover;
use super::cost::Rule;
use super::decision::Part;
use super::lanes::{EXCLUDED, PART_PIXELS, UNSET, larger, largest};
use super::pieces::Foot;
use super::projection::{Level, Projected};

/// Number of slots on each side of the starting slot that a group of pixels searches together.
const GROUP_SLOTS: usize = 8;

/// For each pixel of a part: of the pieces of its vessel at a level, the one nearest in arc length so far.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct NearestPieces {
    /// Distance between the piece and the winner along the vessel (mm).
    apart: [f32; PART_PIXELS],
    /// Arc length of the piece minus that of the winner (mm).
    pub along: [f32; PART_PIXELS],
    cost: [f32; PART_PIXELS],
    /// Twice the slot of the piece, plus 1 for a stripe: decides between equal costs.
    pub piece: [u32; PART_PIXELS],
    pub z: [f32; PART_PIXELS],
    /// Change of depth to the right and upwards (mm per mm), if a sheet is made.
    pub slope: [[f32; PART_PIXELS]; 2],
}

impl NearestPieces {
    /// Nothing is searched for pixels whose weight for this level is 0.
    #[inline(always)]
    pub(crate) fn new(weight: &[f32; PART_PIXELS]) -> Self {
        let zero = [0.0; PART_PIXELS];
        let mut apart = zero;
        for l in 0..PART_PIXELS {
            apart[l] = if weight[l] > 0.0 { UNSET } else { EXCLUDED };
        }
        Self { apart, along: zero, cost: zero, piece: [u32::MAX; PART_PIXELS], z: zero, slope: [zero; 2] }
    }

    #[inline(always)]
    fn offer<const SHEET: bool>(&mut self, l: usize, covered: bool, offered: Offered) {
        let Offered { along, cost, piece, z, slope } = offered;
        let apart = along.abs();
        let first = (cost < self.cost[l]) | ((cost == self.cost[l]) & (piece < self.piece[l]));
        let wins = covered & ((apart < self.apart[l]) | ((apart == self.apart[l]) & first));
        self.apart[l] = if wins { apart } else { self.apart[l] };
        self.along[l] = if wins { along } else { self.along[l] };
        self.cost[l] = if wins { cost } else { self.cost[l] };
        self.piece[l] = if wins { piece } else { self.piece[l] };
        self.z[l] = if wins { z } else { self.z[l] };
        if SHEET {
            self.slope[0][l] = if wins { slope[0] } else { self.slope[0][l] };
            self.slope[1][l] = if wins { slope[1] } else { self.slope[1][l] };
        }
    }

    /// The arc lengths (mm, widened for rounding) between which a piece can still be nearer to a member of the group.
    #[inline(always)]
    fn reach(&self, part: &Part, is_member: &[bool; PART_PIXELS]) -> [f32; 2] {
        let (mut low, mut high) = ([EXCLUDED; PART_PIXELS], [EXCLUDED; PART_PIXELS]);
        for l in 0..PART_PIXELS {
            let (s, apart) = (part.arc_length[l], self.apart[l]);
            low[l] = if is_member[l] { apart - s } else { EXCLUDED };
            high[l] = if is_member[l] { apart + s } else { EXCLUDED };
        }
        let (low, high) = (largest(&low), largest(&high));
        let slack = 1e-6 * larger(low.abs(), high.abs());
        [-low - slack, high + slack]
    }
}

#[derive(Clone, Copy)]
struct Offered {
    along: f32,
    cost: f32,
    piece: u32,
    z: f32,
    slope: [f32; 2],
}

struct Group {
    vessel: i32,
    /// The first slot of the vessel, and the one after its last.
    first: usize,
    end: usize,
    middle: usize,
    low: f32,
    high: f32,
}

#[derive(Clone, Copy)]
pub(crate) struct OwnPieces<'a> {
    pub level: &'a Level,
    pub projected: &'a [Projected],
    pub rule: &'a Rule,
}

impl OwnPieces<'_> {
    #[inline(always)]
    pub(crate) fn find<const SHEET: bool>(&self, part: &Part, nearest: &mut NearestPieces) {
        let mut is_open = [false; PART_PIXELS];
        for l in 0..PART_PIXELS {
            is_open[l] = nearest.apart[l] > 0.0;
        }
        while let Some(seed) = is_open.iter().position(|is_open| *is_open) {
            let group = self.group(part, seed);
            let mut is_member = [false; PART_PIXELS];
            for l in 0..PART_PIXELS {
                let (vessel, s) = (part.vessel[l], part.arc_length[l]);
                is_member[l] = is_open[l] & (vessel == group.vessel) & (s >= group.low) & (s <= group.high);
                is_open[l] &= !is_member[l];
            }
            // The pixel that started the group belongs to it, even if rounding moves it beyond the ends.
            is_member[seed] = true;
            is_open[seed] = false;
            self.search::<SHEET>(part, &group, &is_member, nearest);
        }
    }

    #[inline(always)]
    fn group(&self, part: &Part, seed: usize) -> Group {
        let (vessel, s) = (part.vessel[seed], part.arc_length[seed]);
        let [first, end] = [vessel, vessel + 1].map(|id| self.level.first_slot[id as usize] as usize);
        let arc_length = &self.level.arc_length[first..end];
        let middle = first + arc_length.partition_point(|at| *at <= s).saturating_sub(1);
        let (lowest, highest) = (middle.saturating_sub(GROUP_SLOTS).max(first), middle + GROUP_SLOTS);
        let low = if lowest == first { -UNSET } else { self.level.arc_length[lowest] };
        let high = if highest >= end - 1 { UNSET } else { self.level.arc_length[highest] };
        Group { vessel, first, end, middle, low, high }
    }

    /// Offers slots from the middle of a group outwards, until no slot farther out can be nearer to a member.
    #[inline(always)]
    fn search<const SHEET: bool>(
        &self,
        part: &Part,
        group: &Group,
        is_member: &[bool; PART_PIXELS],
        nearest: &mut NearestPieces,
    ) {
        let arc_length = &self.level.arc_length;
        let mut reach = [-UNSET, UNSET];
        // The slots before `left` and those from `right` on have not been offered yet.
        let (mut left, mut right) = (group.middle, group.middle);
        loop {
            let is_left = left > group.first && arc_length[left] >= reach[0];
            let is_right = right < group.end && arc_length[right] <= reach[1];
            if !(is_left | is_right) {
                return;
            }
            let mut was_offered = false;
            if is_right {
                was_offered |= self.offer_within::<SHEET>(part, right, nearest);
                right += 1;
            }
            if is_left {
                left -= 1;
                was_offered |= self.offer_within::<SHEET>(part, left, nearest);
            }
            if was_offered {
                reach = nearest.reach(part, is_member);
            }
        }
    }

    #[inline(always)]
    fn offer_within<const SHEET: bool>(&self, part: &Part, slot: usize, nearest: &mut NearestPieces) -> bool {
        let here = &self.projected[slot];
        let end = &self.projected[slot + usize::from(here.has_stripe())];
        let ends = [here, end].map(|p| [p.point[0], p.point[1]]);
        let cover = Cover::new(part.area, ends, here.edge, here.before);
        let (stripe, wedge) = (here.has_stripe() & cover.in_stripe, here.stands & cover.in_wedge);
        if stripe {
            self.offer_stripe::<SHEET>(part, slot, nearest);
        }
        if wedge {
            self.offer_wedge::<SHEET>(part, slot, nearest);
        }
        stripe | wedge
    }

    /// Offers every piece of every slot, as a reference for tests.
    #[inline(always)]
    pub(crate) fn offer_all<const SHEET: bool>(&self, part: &Part, nearest: &mut NearestPieces) {
        for (slot, here) in self.projected.iter().enumerate() {
            let mut is_wanted = false;
            for l in 0..PART_PIXELS {
                is_wanted |= part.vessel[l] == here.vessel;
            }
            if is_wanted & here.has_stripe() {
                self.offer_stripe::<SHEET>(part, slot, nearest);
            }
            if is_wanted & here.stands {
                self.offer_wedge::<SHEET>(part, slot, nearest);
            }
        }
    }

    #[inline(always)]
    fn offer_stripe<const SHEET: bool>(&self, part: &Part, slot: usize, nearest: &mut NearestPieces) {
        let (here, end) = (&self.projected[slot], &self.projected[slot + 1]);
        let (stripe, slope) = (here.stripe(end), here.slope(end));
        let (z0, dz) = (here.point[2], end.point[2] - here.point[2]);
        let (r0, dr) = (here.radius, end.radius - here.radius);
        let (s0, ds) = (here.arc_length, end.arc_length - here.arc_length);
        let piece = slot as u32 * 2 + 1;
        for l in 0..PART_PIXELS {
            let Foot { covered, t, distance } = stripe.foot(part.x[l], part.y[l]);
            let z = z0 + t * dz;
            let cost = self.rule.key::<false>(z, distance, r0 + t * dr, 0.0);
            let along = (s0 + t * ds) - part.arc_length[l];
            let is_own = part.vessel[l] == here.vessel;
            nearest.offer::<SHEET>(l, covered & is_own, Offered { along, cost, piece, z, slope });
        }
    }

    #[inline(always)]
    fn offer_wedge<const SHEET: bool>(&self, part: &Part, slot: usize, nearest: &mut NearestPieces) {
        let (here, wedge) = (&self.projected[slot], self.projected[slot].wedge());
        let (z, slope, piece) = (here.point[2], [0.0; 2], slot as u32 * 2);
        for l in 0..PART_PIXELS {
            let (covered, distance) = wedge.cover(part.x[l], part.y[l]);
            let cost = self.rule.key::<false>(z, distance, here.radius, 0.0);
            let along = here.arc_length - part.arc_length[l];
            let is_own = part.vessel[l] == here.vessel;
            nearest.offer::<SHEET>(l, covered & is_own, Offered { along, cost, piece, z, slope });
        }
    }
}
