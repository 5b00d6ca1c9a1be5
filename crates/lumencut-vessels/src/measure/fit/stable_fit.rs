//! Makes the result of a fit independent of its start values.
//!
//! The start of a fit determines which voxels are used, what obstructs them, the prior of the shape, and the limits.
//! So the fit is restarted from its own result until that no longer changes. If it keeps changing, two lumens fit
//! about equally well. The residual cannot decide between them: in 7 of 10 sections of a dissection, the fit with the
//! lower residual was farther from the reference. So the second solution only increases the uncertainty.

use super::Fit;
use super::sections::{Bench, Known};
use crate::measure::model::ellipse::Ellipse;
use crate::measure::section::SectionPlane;

/// A fit has converged if no parameter moves by more than this (blur widths).
const MAX_MOVEMENT: f64 = 0.05;

const MAX_RESTARTS: usize = 3;

/// Two fits show the same lumen if the ratio of their sizes and the distance of their centres (radii) are at
/// most these.
const SAME_LUMEN: (f64, f64) = (1.6, 0.6);

impl Bench<'_, '_> {
    /// Restarts the fit until it no longer changes; if it keeps changing, the result has a second solution.
    /// Fits that jump to another lumen are discarded.
    pub(crate) fn stable_fit(&self, place: &SectionPlane, known: &Known) -> Option<Fit> {
        let least = MAX_MOVEMENT * self.blur.width(place);
        let first = self.fit(place, known)?;
        let (mut begun, mut fit) = (known.ellipse, first);
        for _ in 0..MAX_RESTARTS {
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

    /// Fits a section; if there is a second solution, it increases the uncertainty.
    pub(crate) fn fit_of_either(
        &self,
        place: &SectionPlane,
        known: &Known,
        other: Option<Ellipse>,
    ) -> Option<Fit> {
        let fit = self.fit(place, known)?;
        let other = other.and_then(|ellipse| self.fit(place, &Known { ellipse, ..*known }));
        Some(other.map_or(fit, |other| fit.or(&other)))
    }
}

fn is_same_lumen(first: &Ellipse, again: &Ellipse) -> bool {
    let (factor, share) = SAME_LUMEN;
    let is_as_wide = again.mean <= factor * first.mean && first.mean <= factor * again.mean;
    is_as_wide && again.center.distance(first.center) <= share * first.mean
}

#[cfg(test)]
#[path = "tests/stable_fit.rs"]
mod tests;
