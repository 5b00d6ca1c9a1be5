//! Fits that do not depend on where they begin.
//!
//! Where a fit begins decides which voxels it is of, what is in the way of them, what is expected of its shape and how far it may go.
//! So it is begun anew from what it ended at until it stays there. Where it does not, as in a lumen that is no ellipse, two lumens fit
//! about as well, and which of them misses less says nothing of which is right: the second makes the first unsure.

use super::ellipse::Ellipse;
use super::fit::Fit;
use super::place::Place;
use super::sections::{Bench, Known};

/// A fit stays where it begins if no parameter of its ellipse moves by more than this share of the blur's width.
const STAYS: f64 = 0.05;

/// How often a fit is begun anew, at most.
const ROUNDS: usize = 3;

/// Fits of one lumen are no wider or narrower than each other by more than this factor, and their centres no farther apart than
/// this share of the radius.
const SAME: (f64, f64) = (1.6, 0.6);

impl Bench<'_, '_> {
    /// The fit of a section by itself that stays where it begins, or else with what it was last begun from. One that runs away is
    /// taken as it was before it was begun anew.
    pub fn settled(&self, place: &Place, known: &Known) -> Option<Fit> {
        let least = STAYS * self.blur.width(place);
        let first = self.fit(place, known)?;
        let (mut begun, mut fit) = (known.ellipse, first);
        for _ in 0..ROUNDS {
            if fit.ellipse.differs(&begun) <= least {
                return Some(fit);
            }
            let Some(next) = self.fit(place, &Known { ellipse: fit.ellipse, ..*known }) else { break };
            if !is_same_lumen(&first.ellipse, &next.ellipse) {
                return Some(Fit { other: Some(fit.ellipse), ..first });
            }
            (begun, fit) = (fit.ellipse, next);
        }
        let other = (fit.ellipse.differs(&begun) > least).then_some(begun);
        Some(Fit { other, ..fit })
    }

    /// The fit of a section, unsure by what it is where it begins from another lumen, if there is one that fits.
    pub fn fit_of_either(&self, place: &Place, known: &Known, other: Option<Ellipse>) -> Option<Fit> {
        let fit = self.fit(place, known)?;
        let other = other.and_then(|ellipse| self.fit(place, &Known { ellipse, ..*known }));
        Some(other.map_or(fit, |other| fit.or(&other)))
    }
}

/// Whether a fit that was begun anew is still of the lumen that the first one found.
fn is_same_lumen(first: &Ellipse, again: &Ellipse) -> bool {
    let (factor, share) = SAME;
    let is_as_wide = again.mean <= factor * first.mean && first.mean <= factor * again.mean;
    is_as_wide && again.center.distance(first.center) <= share * first.mean
}

#[cfg(test)]
#[path = "tests/settled.rs"]
mod tests;
