//! Reasons, in addition to the flags, not to suggest a section as the narrowest place or as a reference.

use std::f64::consts::PI;

use crate::measure::profile::Profile;
use crate::measure::section::flags::{CALCIUM, IRREGULAR, LEFT_OUT, METAL, NEIGHBOR, PLAQUE};

/// The lumen jumps sideways from the previous section, and its level or width may change too.
pub const CHANGE_OF_LUMEN: u32 = 1 << 16;
/// Another lumen lies next to an irregular wall, as at the flap of a dissection.
pub const FLAP: u32 = 1 << 17;
/// The standard deviation of the diameter exceeds a third of the diameter.
pub const UNSURE: u32 = 1 << 18;

const FLAGGED: u32 = LEFT_OUT | METAL | CALCIUM;

/// Maximum relative standard deviation of a suggested diameter.
const UNSURE_SHARE: f64 = 1.0 / 3.0;

/// Sideways movement of the centre that counts as a jump, as a fraction of the radius. The distance between
/// the sections is added, so a vessel at 45° to its centerline has no jumps.
const JUMP: f64 = 0.5;

/// Half of the movement `JUMP` suffices if the diameter also changes by this factor, or the level by this fraction.
const OTHER: (f64, f64) = (1.4, 0.25);

impl Profile {
    /// For each section, the reasons not to suggest it, as bits. Changes of lumen and flaps also mark the
    /// sections within one diameter.
    pub fn hindrances(&self) -> Vec<u32> {
        let mut found: Vec<u32> = (0..self.len()).map(|n| self.flags[n] & FLAGGED | self.unsure(n)).collect();
        let measured: Vec<usize> = (0..self.len()).filter(|n| self.area[*n].is_finite()).collect();
        for two in measured.windows(2) {
            if self.is_change(two[0], two[1]) {
                let reach = self.width(two[0]).min(self.width(two[1]));
                self.spread(&mut found, [two[0], two[1]], reach, CHANGE_OF_LUMEN);
            }
        }
        for n in measured {
            if self.flags[n] & NEIGHBOR != 0 && self.flags[n] & IRREGULAR != 0 {
                self.spread(&mut found, [n; 2], self.width(n), FLAP);
            }
        }
        found
    }

    fn unsure(&self, n: usize) -> u32 {
        // Beside bright plaque the diameter is less sure, but such a place must not be passed over.
        let is_told = self.flags[n] & PLAQUE != 0;
        if is_told || self.uncertainty[n] <= UNSURE_SHARE * self.width(n) { 0 } else { UNSURE }
    }

    fn width(&self, n: usize) -> f64 {
        2.0 * (self.area[n] / PI).sqrt()
    }

    fn is_change(&self, before: usize, n: usize) -> bool {
        let [a, b] = [self.width(before), self.width(n)];
        let way = self.center[n] - self.center[before];
        let sideways = (way - self.normal[n] * way.dot(self.normal[n])).length();
        let [lumen, background] = self.levels[before];
        let step = (self.levels[n][0] - lumen).abs() / (lumen - background).abs();
        let is_other = a.max(b) > OTHER.0 * a.min(b) || step > OTHER.1;
        let jump = JUMP * 0.5 * a.min(b) + (self.arc_length[n] - self.arc_length[before]);
        sideways > if is_other { 0.5 * jump } else { jump }
    }

    fn spread(&self, found: &mut [u32], [from, to]: [usize; 2], reach: f64, bit: u32) {
        let [low, high] = [self.arc_length[from] - reach, self.arc_length[to] + reach];
        let first = self.arc_length.partition_point(|at| *at < low);
        let behind = self.arc_length.partition_point(|at| *at <= high);
        for hindrance in &mut found[first..behind] {
            *hindrance |= bit;
        }
    }
}

#[cfg(test)]
#[path = "tests/hindrances.rs"]
mod tests;
