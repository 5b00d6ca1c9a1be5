//! Which part of a chosen vessel takes precedence over all other vessels. The centerline of a branch begins in the
//! middle of its parent, with the parent's radius. With precedence, its first disc would cover the parent, so points
//! (slots) inside the parent get none.

use std::ops::Range;

use glam::DVec3;

use super::projection::Level;

/// For each vessel, the slots that take precedence. Those of a chosen vessel begin where its centerline first
/// leaves the lumens of the other vessels, and end where it last enters one; if it never leaves, all take
/// precedence. Other vessels have none.
pub fn chosen_slots(level: &Level, vessels: &[usize]) -> Vec<Range<u32>> {
    let count = level.first_slot.len() - 1;
    let mut is_chosen = vec![false; count];
    vessels.iter().for_each(|vessel| is_chosen[*vessel] = true);
    let slots = |vessel: usize| level.first_slot[vessel]..level.first_slot[vessel + 1];
    let others: Vec<_> = (0..count).filter(|vessel| !is_chosen[*vessel]).map(slots).collect();
    let is_outside = |slot: &u32| {
        let point = level.points[*slot as usize];
        !others.iter().any(|other| is_within(level, other.clone(), point))
    };
    let of_vessel = |vessel: usize| {
        let all = slots(vessel);
        if !is_chosen[vessel] {
            return all.start..all.start;
        }
        let [first, last] = [all.clone().find(is_outside), all.clone().rev().find(is_outside)];
        // If the last slot takes precedence, so does its half-plane. Else precedence ends at the last slot outside.
        let end = last.map_or(all.end, |last| if last + 1 == all.end { all.end } else { last });
        let first = first.unwrap_or(all.start);
        if first < end { first..end } else { all }
    };
    (0..count).map(of_vessel).collect()
}

fn is_within(level: &Level, slots: Range<u32>, point: DVec3) -> bool {
    let last = slots.end.saturating_sub(1) as usize;
    slots.map(|slot| slot as usize).any(|slot| {
        let next = (slot + 1).min(last);
        let [from, to] = [slot, next].map(|slot| level.points[slot]);
        let [first, second] = [slot, next].map(|slot| f64::from(level.radii[slot]));
        let along = to - from;
        let t = ((point - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (point - from - along * t).length() < first + (second - first) * t
    })
}
