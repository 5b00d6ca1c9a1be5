//! Offers a throat whose lumen is too dim for a clear wall: its diameter is limited, but not measured.

use super::suggestions::Spot;
use crate::measure::profile::Profile;

/// A limit up to this multiple of the narrowest measured diameter is offered, since the lumen is mostly narrower.
const TIGHTER: f64 = 1.2;

impl Profile {
    /// Place with the smallest limit ([`Profile::at_most`]), if no measured place is narrower. The diameter of the
    /// spot is that limit.
    pub fn throat(&self) -> Option<Spot> {
        let limit = |n: usize| Spot { at: self.arc_length[n], diameter: self.at_most[n] };
        let limits = (0..self.len()).map(limit).filter(|spot| spot.diameter.is_finite());
        let tightest = limits.min_by(|a, b| a.diameter.total_cmp(&b.diameter))?;
        let measured = self.narrowest_measured().map_or(f64::INFINITY, |spot| spot.diameter);
        (tightest.diameter < TIGHTER * measured).then_some(tightest)
    }

    /// Largest diameter (mm) that the values allow at an arc length without a clear wall, if it is limited there.
    pub(crate) fn limit_at(&self, at: f64) -> Option<f64> {
        Some(self.at_most[self.nearest_section(at)]).filter(|most| most.is_finite())
    }
}

#[cfg(test)]
#[path = "tests/throat.rs"]
mod tests;
