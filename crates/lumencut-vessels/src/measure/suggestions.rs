//! What is offered to the reader of a profile: the narrowest and the widest place, and places to compare with. These are
//! suggestions: nothing of it finds a stenosis.

use std::f64::consts::PI;

use super::flags::{BRANCH, IRREGULAR};
use super::profile::Profile;
use lumencut_core::error::Result;
use lumencut_core::math::statistics::{median, quantile};

/// Walls are parallel where diameters within this distance (mm) to both sides differ by no more than this share.
const PARALLEL: (f64, f64) = (2.5, 0.06);

/// References are looked for from so far on to so far from a place (mm).
const AWAY: [f64; 2] = [3.0, 50.0];

/// A reference is at least this share of what most of the vessel on its side is.
const NORMAL: f64 = 0.92;

/// A diameter is not sure where its standard deviation is more than this share of it.
const UNSURE: f64 = 1.0 / 3.0;

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
    /// Where the vessel is narrowest, of the sections that count and whose diameter is sure, by the median of three; of all that
    /// count where none is sure. None where none counts.
    pub fn narrowest(&self) -> Option<Spot> {
        let spot = |n: usize| {
            let around = n.saturating_sub(1)..(n + 2).min(self.len());
            median(&mut self.widths(around)).map(|diameter| Spot { at: self.arc_length[n], diameter })
        };
        let of = |sections: &dyn Fn(usize) -> bool| {
            let spots = (0..self.len()).filter(|n| self.counts(*n) && sections(*n)).filter_map(spot);
            spots.min_by(|a, b| a.diameter.total_cmp(&b.diameter))
        };
        of(&|n| self.is_sure(n)).or_else(|| of(&|_| true))
    }

    /// Whether the diameter of a section is known well enough to be suggested: between the struts of a stent a fit can hold on to
    /// a gap that is no lumen.
    fn is_sure(&self, n: usize) -> bool {
        let diameter = 2.0 * (self.area[n] / PI).sqrt();
        self.uncertainty[n] <= UNSURE * diameter
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
    /// away, whose walls are parallel and that are as wide as most of the vessel on that side. No branch lies between a place and its reference, as beyond it the
    /// vessel is of another width; only where that leaves neither side one, branches are passed. None on a side without such a
    /// place.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Measuring`] for a place beyond the vessel.
    pub fn suggested_references(&self, at: f64) -> Result<[Option<Spot>; 2]> {
        self.check_place("place on the vessel", at)?;
        let within =
            |reach: [f64; 2]| [(0, -1.0), (1, 1.0)].map(|(n, side)| self.suggested_on(at, side, reach[n]));
        let segment = within([-1.0, 1.0].map(|side| self.nearest_branch(at, side)));
        Ok(if segment == [None, None] { within([f64::INFINITY; 2]) } else { segment })
    }

    /// How far from a place the nearest branch on a side begins (mm); a place within a branch is not beside it.
    fn nearest_branch(&self, at: f64, side: f64) -> f64 {
        let away = (0..self.len()).filter(|n| self.flags[*n] & BRANCH != 0);
        let away = away.map(|n| (self.arc_length[n] - at) * side).filter(|away| *away >= AWAY[0]);
        away.fold(f64::INFINITY, f64::min)
    }

    fn suggested_on(&self, at: f64, side: f64, reach: f64) -> Option<Spot> {
        let away = |n: &usize| (self.arc_length[*n] - at) * side;
        let far = AWAY[1].min(reach);
        let mut there: Vec<usize> = (0..self.len()).filter(|n| (AWAY[0]..=far).contains(&away(n))).collect();
        there.sort_by(|a, b| away(a).total_cmp(&away(b)));
        let normal = quantile(&mut self.widths(there.iter().copied()), 0.75)?;
        there.into_iter().find_map(|n| {
            let diameter = self.parallel(n, at)?;
            let spot = Spot { at: self.arc_length[n], diameter };
            // Nearer than its own diameter it would be refused.
            let is_apart = self.reference_at(spot.at).is_ok_and(|reference| away(&n) >= reference);
            (diameter >= NORMAL * normal && is_apart).then_some(spot)
        })
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

#[cfg(test)]
#[path = "tests/suggestions.rs"]
mod tests;
