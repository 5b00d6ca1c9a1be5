//! Suggests the narrowest place, the widest place and references to the reader. It does not detect stenoses.

use std::cmp::Ordering;

use super::REFERENCE_REACH;
use crate::measure::profile::Profile;
use crate::measure::section::flags::{BRANCH, IRREGULAR};
use lumencut_core::error::Result;
use lumencut_core::math::statistics::{median, quantile};

/// Walls are parallel if diameters within this distance (mm) vary by at most this fraction of their median.
const PARALLEL: (f64, f64) = (2.5, 0.06);

/// Range of distances of a reference from the stenosis (mm).
const REFERENCE_DISTANCE_MM: [f64; 2] = [3.0, 50.0];

/// Minimum diameter of a reference, as a fraction of the typical diameter on its side.
const NORMAL: f64 = 0.92;

/// The calibre counts as changed if the diameters of neighbouring normal places differ by this factor.
const CALIBRE_STEP: f64 = 1.25;

/// The longest diameter is not suggested if an irregular section or a branch is within this distance (mm).
const MIN_DISTANCE_MM: f64 = 1.0;

/// Maximum ratio of the axes of a section, to exclude outliers of the fit: on its own, and with similar neighbours.
/// `NEIGHBOURS`: maximum distance (mm), minimum number, and fraction by which their longest diameter may be shorter.
const ROUND: [f64; 2] = [1.3, 2.0];
const NEIGHBOURS: (f64, usize, f64) = (2.5, 4, 0.1);

/// The narrowest place is a tapering end if the vessel is at least 1.25 times as wide on one side, but
/// nowhere 1.1 times as wide on the other side.
const THIN_END: [f64; 2] = [1.25, 1.1];

/// A place that is not suggested is reported if it is narrower than this fraction of the suggested diameter.
const NARROWER: f64 = 0.95;

/// Number of sections on each side that enter a median width, because single sections may be outliers.
const MEDIAN_SECTIONS: usize = 2;

/// A place on a vessel, with its diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Arc length (mm).
    pub at: f64,
    /// Diameter (mm).
    pub diameter: f64,
}

impl Profile {
    /// Narrowest place without [`Profile::hindrances`] that is not a tapering end; diameters are medians of
    /// three sections. None if there is no such place ([`Profile::none_safe`], [`Profile::thin_end`]), or if a place
    /// that is not measured must be narrower ([`Profile::throat`]).
    pub fn narrowest(&self) -> Option<Spot> {
        self.narrowest_measured().filter(|_| self.throat().is_none())
    }

    pub(super) fn narrowest_measured(&self) -> Option<Spot> {
        let spots = self.safe_spots();
        let narrowest = spots.iter().copied().min_by(thinner)?;
        let beside = self.widest_beside();
        let wider = |(n, spot): &(usize, Spot)| beside[*n].map(|wide| wide / spot.diameter);
        let [before, after] = wider(&narrowest);
        if before.max(after) < THIN_END[0] || before.min(after) >= THIN_END[1] {
            return Some(narrowest.1);
        }
        // In a tapering vessel, the narrowest place must be thinner than the vessel on both sides.
        let is_narrowing = |one: &(usize, Spot)| wider(one).iter().all(|factor| *factor >= THIN_END[1]);
        spots.into_iter().filter(is_narrowing).min_by(thinner).map(|(_, spot)| spot)
    }

    /// Narrowest place of a vessel that only tapers towards an end; None for other vessels.
    pub fn thin_end(&self) -> Option<Spot> {
        let narrowest = self.safe_spots().into_iter().min_by(thinner);
        narrowest.map(|(_, spot)| spot).filter(|_| self.narrowest_measured().is_none())
    }

    /// The narrowest usable place, and its hindrances, if a wider place is suggested, or is the end of a tapering vessel.
    pub fn passed_over(&self) -> Option<(Spot, u32)> {
        let least = NARROWER * self.narrowest().or_else(|| self.thin_end())?.diameter;
        let hindrances = self.hindrances();
        let (n, spot) = self.spots(|_| true).into_iter().min_by(thinner)?;
        (spot.diameter < least).then_some((spot, hindrances[n]))
    }

    /// Usable sections without hindrances; the diameter is the median of three sections.
    fn safe_spots(&self) -> Vec<(usize, Spot)> {
        let hindrances = self.hindrances();
        self.spots(|n| hindrances[n] == 0)
    }

    fn spots(&self, is_wanted: impl Fn(usize) -> bool) -> Vec<(usize, Spot)> {
        let spot = |n: usize| {
            let diameter = median(&mut self.widths(self.around(n, 1)))?;
            Some((n, Spot { at: self.arc_length[n], diameter }))
        };
        (0..self.len()).filter(|n| self.counts(*n) && is_wanted(*n)).filter_map(spot).collect()
    }

    /// Largest width before and after each section, from medians of five sections; 0 if no section there is usable.
    fn widest_beside(&self) -> Vec<[f64; 2]> {
        let width = |n: usize| median(&mut self.widths(self.around(n, MEDIAN_SECTIONS))).unwrap_or(0.0);
        let widths: Vec<f64> = (0..self.len()).map(width).collect();
        let mut found = vec![[0.0_f64; 2]; self.len()];
        for n in 1..self.len() {
            found[n][0] = found[n - 1][0].max(widths[n - 1]);
        }
        for n in (1..self.len()).rev() {
            found[n - 1][1] = found[n][1].max(widths[n]);
        }
        found
    }

    fn around(&self, n: usize, count: usize) -> std::ops::Range<usize> {
        n.saturating_sub(count)..(n + count + 1).min(self.len())
    }

    /// Union of all hindrances, as bits, if every section has one; None otherwise.
    pub fn none_safe(&self) -> Option<u32> {
        let hindrances = self.hindrances();
        let is_safe = |n: usize| self.counts(n) && hindrances[n] == 0;
        let all = hindrances.iter().fold(0, |all, one| all | one);
        (!(0..self.len()).any(is_safe)).then_some(all)
    }

    /// Longest diameter of the usable sections.
    pub fn widest(&self) -> Option<Spot> {
        let spot = |n| Spot { at: self.arc_length[n], diameter: self.diameter_max[n] };
        let spots = (0..self.len()).filter(|n| self.counts(*n)).map(spot);
        spots.reduce(|a, b| if b.diameter > a.diameter { b } else { a })
    }

    /// Longest diameter to suggest: that of [`Profile::widest`] or, if this is an outlier, that of the section with
    /// the largest area. None if both are outliers, or if an irregular section or a branch is near.
    pub fn offered_widest(&self) -> Option<Spot> {
        let largest = (0..self.len())
            .filter(|n| self.counts(*n))
            .max_by(|a, b| self.area[*a].total_cmp(&self.area[*b]));
        let longest = self.widest().map(|spot| self.nearest_section(spot.at));
        let plausible = longest.into_iter().chain(largest).find(|n| self.is_plausible(*n))?;
        let at = self.arc_length[plausible];
        let is_beside = |n: &usize| (self.arc_length[*n] - at).abs() <= MIN_DISTANCE_MM;
        let is_odd = |n: usize| self.flags[n] & (BRANCH | IRREGULAR) != 0;
        let is_plain = !(0..self.len()).filter(is_beside).any(is_odd);
        is_plain.then_some(Spot { at, diameter: self.diameter_max[plausible] })
    }

    fn is_plausible(&self, n: usize) -> bool {
        let (reach, least, share) = NEIGHBOURS;
        let longest = self.diameter_max[n];
        let is_near = |m: &usize| *m != n && (self.arc_length[*m] - self.arc_length[n]).abs() <= reach;
        let is_like = |m: &usize| self.counts(*m) && self.diameter_max[*m] >= (1.0 - share) * longest;
        let agree = (0..self.len()).filter(is_near).filter(is_like).count() >= least;
        longest <= ROUND[usize::from(agree)] * self.diameter_min[n]
    }

    /// Suggested references before and after an arc length (mm). A reference is the nearest place at least
    /// its own diameter away that has parallel walls and a typical width, is not narrower than the stenosis,
    /// and has no [`Profile::hindrances`]. It lies before the next branch or step of the calibre, unless
    /// neither side has such a place. Errors: `ErrorKind::Measuring` for a place beyond the vessel.
    pub fn suggested_references(&self, at: f64) -> Result<[Option<Spot>; 2]> {
        self.check_place("place on the vessel", at)?;
        let normal = self.normal_places(at);
        let within = |reach: [f64; 2]| {
            [(0, -1.0), (1, 1.0)].map(|(n, side)| self.suggested_on((at, side), reach[n], &normal))
        };
        let place = self.diameter_at(at).map_or(0.0, |(diameter, _)| diameter);
        // Places that are only a little wider still belong to the narrowing.
        let wider = normal.iter().filter(|spot| spot.diameter > CALIBRE_STEP * place);
        let wider: Vec<Spot> = wider.copied().collect();
        let end = |side: f64| self.nearest_branch(at, side).min(calibre_step((at, side), &wider));
        let segment = within([-1.0, 1.0].map(end));
        Ok(if segment == [None, None] { within([f64::INFINITY; 2]) } else { segment })
    }

    /// Possible references by arc length: without hindrances, with parallel walls, not narrower than the stenosis.
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

    /// Distance (mm) to the nearest branch on one side; a branch at the place itself is ignored.
    fn nearest_branch(&self, at: f64, side: f64) -> f64 {
        let away = (0..self.len()).filter(|n| self.flags[*n] & BRANCH != 0);
        let away =
            away.map(|n| (self.arc_length[n] - at) * side).filter(|away| *away >= REFERENCE_DISTANCE_MM[0]);
        away.fold(f64::INFINITY, f64::min)
    }

    fn suggested_on(&self, (at, side): (f64, f64), reach: f64, normal: &[Spot]) -> Option<Spot> {
        let away = |there: f64| (there - at) * side;
        let is_there = |there: f64| {
            (REFERENCE_DISTANCE_MM[0]..=REFERENCE_DISTANCE_MM[1].min(reach)).contains(&away(there))
        };
        let mut widths = self.widths((0..self.len()).filter(|n| is_there(self.arc_length[*n])));
        let most = quantile(&mut widths, 0.75)?;
        let is_offered = |spot: &&Spot| {
            // References closer to the stenosis would be rejected.
            let is_apart = self.reference_at(spot.at).is_ok_and(|reference| away(spot.at) >= reference);
            is_there(spot.at) && is_apart && spot.diameter >= NORMAL * most
        };
        let offered = normal.iter().filter(is_offered);
        offered.min_by(|a, b| away(a.at).total_cmp(&away(b.at))).copied()
    }

    /// Median diameter around a section; None if its walls are not parallel or the place `but` lies near.
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

fn thinner(a: &(usize, Spot), b: &(usize, Spot)) -> Ordering {
    a.1.diameter.total_cmp(&b.1.diameter)
}

fn calibre_step((at, side): (f64, f64), normal: &[Spot]) -> f64 {
    let mut there: Vec<&Spot> =
        normal.iter().filter(|spot| (spot.at - at) * side >= REFERENCE_DISTANCE_MM[0]).collect();
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
