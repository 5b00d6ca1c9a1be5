//! What is offered to the reader of a profile: the narrowest and the widest place, and places to compare with. These are
//! suggestions: nothing of it finds a stenosis.

use super::profile::Profile;
use crate::error::Result;
use crate::math::statistics::{median, quantile};

/// Walls are parallel where diameters within so many mm to both sides differ by no more than this share.
const PARALLEL: (f64, f64) = (2.5, 0.06);

/// References are looked for from so far on to so far from a place (mm).
const AWAY: [f64; 2] = [3.0, 50.0];

/// A reference is at least this share of what most of the vessel on its side is.
const NORMAL: f64 = 0.92;

/// A place on a vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Its arc length (mm).
    pub at: f64,
    /// The diameter there (mm).
    pub diameter: f64,
}

impl Profile {
    /// Where the vessel is narrowest, of the sections that count, by the median of three; None where none counts.
    pub fn narrowest(&self) -> Option<Spot> {
        let spots = (0..self.len()).filter(|n| self.counts(*n)).filter_map(|n| {
            let around = n.saturating_sub(1)..(n + 2).min(self.len());
            median(&mut self.widths(around)).map(|diameter| Spot { at: self.arc_length[n], diameter })
        });
        spots.min_by(|a, b| a.diameter.total_cmp(&b.diameter))
    }

    /// The longest diameter of all sections that count, and its place; None where none counts.
    pub fn widest(&self) -> Option<Spot> {
        let spot = |n| Spot { at: self.arc_length[n], diameter: self.diameter_max[n] };
        let spots = (0..self.len()).filter(|n| self.counts(*n)).map(spot);
        spots.reduce(|a, b| if b.diameter > a.diameter { b } else { a })
    }

    /// Places before and after an arc length (mm) that it could be compared with: the nearest ones whose walls are parallel and
    /// that are as wide as most of the vessel on that side. None on a side without such a place.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Measuring`] for a place beyond the vessel.
    pub fn suggested_references(&self, at: f64) -> Result<[Option<Spot>; 2]> {
        self.check_place("place on the vessel", at)?;
        Ok([-1.0, 1.0].map(|side| self.suggested_on(at, side)))
    }

    fn suggested_on(&self, at: f64, side: f64) -> Option<Spot> {
        let away = |n: &usize| (self.arc_length[*n] - at) * side;
        let mut there: Vec<usize> =
            (0..self.len()).filter(|n| (AWAY[0]..=AWAY[1]).contains(&away(n))).collect();
        there.sort_by(|a, b| away(a).total_cmp(&away(b)));
        let normal = quantile(&mut self.widths(there.iter().copied()), 0.75)?;
        there.into_iter().find_map(|n| {
            let diameter = self.parallel(n, at)?;
            (diameter >= NORMAL * normal).then_some(Spot { at: self.arc_length[n], diameter })
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
