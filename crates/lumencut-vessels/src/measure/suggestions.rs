//! What is offered to the reader of a profile: the narrowest and the widest place, and places to compare with. These are
//! suggestions: nothing of it finds a stenosis.

use super::flags::{BRANCH, IRREGULAR};
use super::profile::Profile;
use super::stenosis::REFERENCE_REACH;
use lumencut_core::error::Result;
use lumencut_core::math::statistics::{median, quantile};

/// Walls are parallel where diameters within this distance (mm) to both sides differ by no more than this share.
const PARALLEL: (f64, f64) = (2.5, 0.06);

/// References are looked for from so far on to so far from a place (mm).
const AWAY: [f64; 2] = [3.0, 50.0];

/// A reference is at least this share of what most of the vessel on its side is.
const NORMAL: f64 = 0.92;

/// The calibre steps where neighbouring places with parallel walls differ by this factor.
const CALIBRE_STEP: f64 = 1.25;

/// A longest diameter is not offered where a section within this distance (mm) of it is irregular or lies in a branch.
const BESIDE: f64 = 1.0;

/// A place on a vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Its arc length (mm).
    pub at: f64,
    /// The diameter there (mm).
    pub diameter: f64,
}

impl Profile {
    /// Where the vessel is narrowest, by the median of three, of the sections that nothing keeps from being suggested
    /// ([`Profile::hindrances`]). None where none is safe; [`Profile::none_safe`] says why.
    pub fn narrowest(&self) -> Option<Spot> {
        let hindrances = self.hindrances();
        let spot = |n: usize| {
            let around = n.saturating_sub(1)..(n + 2).min(self.len());
            median(&mut self.widths(around)).map(|diameter| Spot { at: self.arc_length[n], diameter })
        };
        let safe = (0..self.len()).filter(|n| self.counts(*n) && hindrances[*n] == 0);
        safe.filter_map(spot).min_by(|a, b| a.diameter.total_cmp(&b.diameter))
    }

    /// What keeps all sections from being suggested, as bits of all of their hindrances; None where one is safe.
    pub fn none_safe(&self) -> Option<u32> {
        let hindrances = self.hindrances();
        let is_safe = |n: usize| self.counts(n) && hindrances[n] == 0;
        let all = hindrances.iter().fold(0, |all, one| all | one);
        (!(0..self.len()).any(is_safe)).then_some(all)
    }

    /// The longest diameter of all sections that count, whatever else their flags say, and its place; None where none counts.
    pub fn widest(&self) -> Option<Spot> {
        let spot = |n| Spot { at: self.arc_length[n], diameter: self.diameter_max[n] };
        let spots = (0..self.len()).filter(|n| self.counts(*n)).map(spot);
        spots.reduce(|a, b| if b.diameter > a.diameter { b } else { a })
    }

    /// The longest diameter as it is offered to readers: None where an odd outline or a branch, at its place or beside it, may be
    /// what makes it the longest one. [`Profile::widest`] has it all the same.
    pub fn offered_widest(&self) -> Option<Spot> {
        let spot = self.widest()?;
        let is_beside = |n: &usize| (self.arc_length[*n] - spot.at).abs() <= BESIDE;
        let is_odd = |n: usize| self.flags[n] & (BRANCH | IRREGULAR) != 0;
        (!(0..self.len()).filter(is_beside).any(is_odd)).then_some(spot)
    }

    /// Places before and after an arc length (mm) that it could be compared with: the nearest ones, at least their own diameter
    /// away, whose walls are parallel, that are as wide as most of the vessel on that side, not narrower than the place, and that
    /// nothing keeps from being suggested ([`Profile::hindrances`]). No branch and no step of the calibre lies between a place and
    /// its reference, as beyond it the vessel is of another width; only where that leaves neither side one, they are passed. None
    /// on a side without such a place.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Measuring`] for a place beyond the vessel.
    pub fn suggested_references(&self, at: f64) -> Result<[Option<Spot>; 2]> {
        self.check_place("place on the vessel", at)?;
        let normal = self.normal_places(at);
        let within = |reach: [f64; 2]| {
            [(0, -1.0), (1, 1.0)].map(|(n, side)| self.suggested_on((at, side), reach[n], &normal))
        };
        let place = self.diameter_at(at).map_or(0.0, |(diameter, _)| diameter);
        // What is about as wide as the place is a part of the narrowing.
        let wider = normal.iter().filter(|spot| spot.diameter > CALIBRE_STEP * place);
        let wider: Vec<Spot> = wider.copied().collect();
        let end = |side: f64| self.nearest_branch(at, side).min(calibre_step((at, side), &wider));
        let segment = within([-1.0, 1.0].map(end));
        Ok(if segment == [None, None] { within([f64::INFINITY; 2]) } else { segment })
    }

    /// All places, rising, that could be compared with an arc length (mm): safe, with parallel walls, and not narrower.
    fn normal_places(&self, at: f64) -> Vec<Spot> {
        let hindrances = self.hindrances();
        let least = self.diameter_at(at).map_or(0.0, |(diameter, _)| diameter);
        let is_safe = |n: usize| {
            let around = |m: &usize| (self.arc_length[*m] - self.arc_length[n]).abs() <= REFERENCE_REACH;
            (0..self.len()).filter(around).all(|m| hindrances[m] == 0)
        };
        let spot = |n: usize| {
            let diameter = self.parallel(n, at)?;
            let is_offered = diameter >= least && is_safe(n);
            is_offered.then_some(Spot { at: self.arc_length[n], diameter })
        };
        (0..self.len()).filter_map(spot).collect()
    }

    /// How far from a place the nearest branch on a side begins (mm); a place within a branch is not beside it.
    fn nearest_branch(&self, at: f64, side: f64) -> f64 {
        let away = (0..self.len()).filter(|n| self.flags[*n] & BRANCH != 0);
        let away = away.map(|n| (self.arc_length[n] - at) * side).filter(|away| *away >= AWAY[0]);
        away.fold(f64::INFINITY, f64::min)
    }

    fn suggested_on(&self, (at, side): (f64, f64), reach: f64, normal: &[Spot]) -> Option<Spot> {
        let away = |there: f64| (there - at) * side;
        let is_there = |there: f64| (AWAY[0]..=AWAY[1].min(reach)).contains(&away(there));
        let mut widths = self.widths((0..self.len()).filter(|n| is_there(self.arc_length[*n])));
        let most = quantile(&mut widths, 0.75)?;
        let is_offered = |spot: &&Spot| {
            // Nearer than its own diameter it would be refused.
            let is_apart = self.reference_at(spot.at).is_ok_and(|reference| away(spot.at) >= reference);
            is_there(spot.at) && is_apart && spot.diameter >= NORMAL * most
        };
        let offered = normal.iter().filter(is_offered);
        offered.min_by(|a, b| away(a.at).total_cmp(&away(b.at))).copied()
    }

    /// The median diameter around a section where all of them count and the walls are parallel; no section around reaches the
    /// place `but`.
    fn parallel(&self, n: usize, but: f64) -> Option<f64> {
        let here = self.arc_length[n];
        let (reach, share) = PARALLEL;
        if (here - but).abs() < reach || here < reach || here > self.arc_length[self.len() - 1] - reach {
            return None;
        }
        let around: Vec<usize> =
            (0..self.len()).filter(|m| (self.arc_length[*m] - here).abs() <= reach).collect();
        let mut widths = self.widths(around.iter().copied());
        let middle = median(&mut widths)?;
        let [low, high] = [0.1, 0.9].map(|part| quantile(&mut widths, part).unwrap_or(middle));
        (widths.len() == around.len() && high - low <= share * middle).then_some(middle)
    }
}

/// How far from a place the calibre of the vessel steps on a side (mm): from one normal place to the next one behind it.
fn calibre_step((at, side): (f64, f64), normal: &[Spot]) -> f64 {
    let mut there: Vec<&Spot> = normal.iter().filter(|spot| (spot.at - at) * side >= AWAY[0]).collect();
    there.sort_by(|a, b| ((a.at - at) * side).total_cmp(&((b.at - at) * side)));
    let is_step = |two: &&[&Spot]| {
        let [a, b] = [two[0].diameter, two[1].diameter];
        a.max(b) > CALIBRE_STEP * a.min(b)
    };
    there.windows(2).find(is_step).map_or(f64::INFINITY, |two| (two[0].at - at).abs())
}

#[cfg(test)]
#[path = "tests/suggestions.rs"]
mod tests;
