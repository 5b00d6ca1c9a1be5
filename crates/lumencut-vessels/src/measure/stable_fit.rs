//! Fits that do not depend on their start.
//!
//! The start of a fit decides which voxels count, what obstructs them, the shape prior and the limits. The
//! fit is therefore restarted from its own result until it stays there. If it does not, two lumens fit about
//! as well and the residual cannot decide between them (on a dissection the lower residual was farther from
//! the reference in 7 of 10 sections), so the second solution only adds uncertainty.

use super::ellipse::Ellipse;
use super::fit::Fit;
use super::section_plane::SectionPlane;
use super::sections::{Bench, Known};

/// Largest movement of a parameter in blur widths for a fit that stays.
const MAX_MOVEMENT: f64 = 0.05;

/// Maximum number of restarts.
const MAX_RESTARTS: usize = 3;

/// Two fits show the same lumen within this ratio of sizes and this distance of centres (radii).
const SAME_LUMEN: (f64, f64) = (1.6, 0.6);

impl Bench<'_, '_> {
    /// Restarts the fit until it stays; otherwise reports a second solution. Jumps to another lumen are
    /// discarded.
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

    /// Fit with the second solution, if any, added to its uncertainty.
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
