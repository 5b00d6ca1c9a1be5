//! The longest stretch of a vessel that shows two lumens.

use super::Profile;
use crate::measure::flap::GAP_MM;
use crate::measure::flap::found::Flap;

/// A stretch that shows both lumens of a dissected vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlapStretch {
    /// Start and end (arc lengths, mm).
    pub ends: [f64; 2],
    /// The section in which both lumens together are widest.
    pub widest: usize,
}

impl Profile {
    /// The longest stretch that shows both lumens; None if there is none.
    pub fn flap_stretch(&self) -> Option<FlapStretch> {
        let at = |n: usize| self.arc_length[n];
        let seen: Vec<usize> = (0..self.len()).filter(|n| self.flap[*n] == Flap::Seen).collect();
        let length = |run: &&[usize]| at(run[run.len() - 1]) - at(run[0]);
        let runs = seen.chunk_by(|a, b| at(*b) - at(*a) <= GAP_MM);
        let run = runs.max_by(|a, b| length(a).total_cmp(&length(b)))?;
        let both = self.area_both_lumens();
        let widest = *run.iter().max_by(|a, b| both[**a][0].total_cmp(&both[**b][0]))?;
        Some(FlapStretch { ends: [at(run[0]), at(run[run.len() - 1])], widest })
    }
}
