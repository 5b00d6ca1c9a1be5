//! The smallest angles by which branches must turn about their common point, so that they do not overlap.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::hull::Disc;

/// A lack of room below this (radians) counts as rounding.
const ROUNDING: f64 = 1e-9;

/// The angles of a branch, seen from where it begins (radians, counter-clockwise from the forward direction).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sector {
    pub low: f64,
    pub high: f64,
}

impl Sector {
    pub(super) fn of(discs: &[Disc], forward: DVec2) -> Option<Self> {
        let middle: DVec2 = discs.iter().map(|disc| disc.center.normalize_or_zero()).sum();
        let middle = wrapped(middle.try_normalize()?.to_angle() - forward.to_angle());
        let sector = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };
        let grown = discs.iter().fold(sector, |sector, disc| {
            let angle = disc.center.to_angle() - forward.to_angle();
            let angle = middle + wrapped(angle - middle);
            let half = (disc.radius / disc.center.length()).clamp(0.0, 1.0).asin();
            Self { low: sector.low.min(angle - half), high: sector.high.max(angle + half) }
        });
        Some(grown)
    }

    pub(super) fn width(&self) -> f64 {
        self.high - self.low
    }
}

fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// The turns (radians) with the smallest sum of squares that separate sectors within the sector `room`, in
/// the order of their middles. If middles are equal, the first sector lies lowest. If the room is too small,
/// all sectors share the missing angle.
pub(super) fn turns(sectors: &[Sector], room: Sector) -> Vec<f64> {
    let mut order: Vec<usize> = (0..sectors.len()).collect();
    let middle = |n: &usize| sectors[*n].low + sectors[*n].high;
    order.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
    let mut before = 0.0;
    let mut wanted = Vec::with_capacity(order.len());
    for n in &order {
        wanted.push(sectors[*n].low - before);
        before += sectors[*n].width();
    }
    let (low, high) = (room.low, room.high - before);
    let missing = (low - high).max(0.0) / 2.0;
    let mut turns = vec![0.0; sectors.len()];
    for ((n, place), wanted) in order.iter().zip(rising(&wanted)).zip(&wanted) {
        turns[*n] = place.clamp(low - missing, (high + missing).max(low - missing)) - wanted;
        if turns[*n].abs() < ROUNDING {
            turns[*n] = 0.0;
        }
    }
    turns
}

/// The non-decreasing numbers nearest to given ones by the sum of squares: pool adjacent violators.
fn rising(wanted: &[f64]) -> Vec<f64> {
    let mut pools: Vec<(f64, usize)> = Vec::with_capacity(wanted.len());
    for value in wanted {
        let mut pool = (*value, 1);
        while let Some((sum, count)) =
            pools.pop_if(|(sum, count)| *sum / *count as f64 > pool.0 / pool.1 as f64)
        {
            pool = (pool.0 + sum, pool.1 + count);
        }
        pools.push(pool);
    }
    pools.iter().flat_map(|(sum, count)| std::iter::repeat_n(sum / *count as f64, *count)).collect()
}
