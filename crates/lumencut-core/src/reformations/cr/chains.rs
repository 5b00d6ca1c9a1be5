//! The segments of a view, in the order of their vessels; sixteen consecutive segments form a chain.

use crate::math::hierarchy::NO_SLOT;
use crate::math::lanes::{FAN, gap};
use crate::math::pieces::Bundle;
use crate::math::projection::{Level, ProjectedLevel};
use crate::math::tile::Area;

pub(super) struct Chains {
    pub bundles: Vec<Bundle>,
    /// The box around each chain in the image: smallest and largest view x, smallest and largest view y (mm).
    boxes: [Vec<f32>; 4],
    first_of_vessel: Vec<u32>,
}

impl Chains {
    pub(super) fn new(level: &Level, view: &ProjectedLevel) -> Self {
        let mut places = vec![0; level.points.len()];
        for (place, slot) in level.order.iter().enumerate().filter(|(_, slot)| **slot != NO_SLOT) {
            places[*slot as usize] = place;
        }
        let mut chains =
            Self { bundles: Vec::new(), boxes: Default::default(), first_of_vessel: Vec::from([0]) };
        for ends in level.first_slot.windows(2) {
            for first in (ends[0]..ends[1]).step_by(FAN) {
                let slots = first..ends[1].min(first + FAN as u32);
                let places = slots.map(|slot| places[slot as usize]);
                chains.push(places.map(|place| (&view.hierarchy.bundles[place / FAN], place % FAN)));
            }
            chains.first_of_vessel.push(chains.bundles.len() as u32);
        }
        chains
    }

    fn push<'a>(&mut self, slots: impl Iterator<Item = (&'a Bundle, usize)>) {
        let mut chain = Bundle::EMPTY;
        let [mut low_x, mut high_x, mut low_y, mut high_y] = [f32::MAX, f32::MIN, f32::MAX, f32::MIN];
        for (s, (from, f)) in slots.enumerate() {
            chain.slot[s] = from.slot[f];
            (chain.x[s], chain.y[s]) = (from.x[f], from.y[f]);
            (chain.edge_x[s], chain.edge_y[s]) = (from.edge_x[f], from.edge_y[f]);
            chain.inverse_length[s] = from.inverse_length[f];
            low_x = low_x.min(from.x[f]).min(from.next_x[f]);
            high_x = high_x.max(from.x[f]).max(from.next_x[f]);
            low_y = low_y.min(from.y[f]).min(from.next_y[f]);
            high_y = high_y.max(from.y[f]).max(from.next_y[f]);
        }
        self.bundles.push(chain);
        for (boxes, bound) in self.boxes.iter_mut().zip([low_x, high_x, low_y, high_y]) {
            boxes.push(bound);
        }
    }

    pub(super) fn chain_of(&self, level: &Level, vessel: i32, slot: u32) -> u32 {
        let vessel = vessel as usize;
        self.first_of_vessel[vessel] + (slot - level.first_slot[vessel]) / FAN as u32
    }

    pub(super) fn span(&self, level: &Level, vessel: i32, chain: u32) -> [f64; 2] {
        let [first, end] = [vessel, vessel + 1].map(|id| level.first_slot[id as usize]);
        let start = first + (chain - self.first_of_vessel[vessel as usize]) * FAN as u32;
        [start, (start + FAN as u32).min(end - 1)].map(|slot| f64::from(level.arc_length[slot as usize]))
    }

    pub(super) fn between(&self, level: &Level, vessel: u32, [low, high]: [f64; 2]) -> [u32; 2] {
        let [first, end] = [vessel, vessel + 1].map(|id| level.first_slot[id as usize] as usize);
        let arc_length = &level.arc_length[first..end];
        let slack = 1e-5 * (1.0 + low.abs().max(high.abs()));
        let starts = arc_length.partition_point(|at| f64::from(*at) < low - slack).saturating_sub(1);
        let ends = arc_length.partition_point(|at| f64::from(*at) <= high + slack);
        let before = self.first_of_vessel[vessel as usize];
        [before + (starts / FAN) as u32, before + ends.div_ceil(FAN) as u32]
    }

    #[inline(always)]
    pub(super) fn squared_distance(&self, chain: u32, area: &Area) -> f32 {
        let [low_x, high_x, low_y, high_y] = self.boxes.each_ref().map(|bounds| bounds[chain as usize]);
        let gx = gap(low_x, high_x, area.center[0], area.half[0]);
        let gy = gap(low_y, high_y, area.center[1], area.half[1]);
        gx * gx + gy * gy
    }
}
