//! The volume within the outer wall of a stretch with a thick wall, and its largest diameter.

use std::f64::consts::PI;

use glam::DVec3;

use super::Profile;
use crate::measure::outer::found::OuterWall;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::same_place::REPEATED_POINT;

/// Areas are interpolated across gaps of at most this length (mm).
const GAP_MM: f64 = 5.0;

/// The outer wall of a stretch: where it is widest, and the volume that it encloses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OuterStretch {
    /// Start and end (arc lengths, mm).
    pub ends: [f64; 2],
    /// Arc length of the section with the largest diameter, that diameter and its standard deviation (mm).
    pub widest: [f64; 3],
    /// Volume and its standard deviation (mm³).
    pub volume: [f64; 2],
}

impl Profile {
    /// Volume within the outer wall between two arc lengths, and its standard deviation (mm³). Errors:
    /// [`ErrorKind::Measuring`] for places beyond the vessel, or if the outer wall is missing over more than 5 mm.
    pub fn outer_volume(&self, [from, to]: [f64; 2]) -> Result<[f64; 2]> {
        self.check_stretch([from, to])?;
        let ends = [from.min(to), from.max(to)];
        let inside = |n: &usize| {
            let at = self.arc_length[*n];
            at >= ends[0] - REPEATED_POINT && at <= ends[1] + REPEATED_POINT
        };
        let seen: Vec<usize> =
            (0..self.len()).filter(|n| inside(n) && self.outer_wall[*n] == OuterWall::Seen).collect();
        let mut places = vec![ends[0]];
        places.extend(seen.iter().map(|n| self.arc_length[*n]));
        places.push(ends[1]);
        if let Some(gap) = places.windows(2).find(|two| seen.is_empty() || two[1] - two[0] > GAP_MM) {
            let found = format!("none from {:.1} to {:.1} mm", gap[0], gap[1]);
            let expected = format!("one at least every {GAP_MM} mm, around thrombus or plaque");
            return Err(Error::new(ErrorKind::Measuring, "outer wall of the stretch", found, expected)
                .mend("choose a stretch whose sections show it"));
        }
        let [first, last] = [seen[0], seen[seen.len() - 1]];
        let area = |n: usize| PI / 4.0 * self.diameter_outer[n][0].powi(2);
        let unsure = |n: usize| PI / 2.0 * self.diameter_outer[n][0] * self.diameter_outer[n][1];
        // Up to the ends, the outline continues as in the nearest section.
        let before = self.arc_length[first] - ends[0];
        let behind = ends[1] - self.arc_length[last];
        let mut volume =
            [before * area(first) + behind * area(last), before * unsure(first) + behind * unsure(last)];
        for two in seen.windows(2) {
            let [a, b] = [two[0], two[1]];
            // In a bend, the sections of a sac are farther apart on its outer side.
            let apart = (self.outer_middle(b) - self.outer_middle(a))
                .dot((self.normal[a] + self.normal[b]).normalize());
            // Errors of levels and blur are those of all sections, so they add.
            volume[0] += apart * f64::midpoint(area(a), area(b));
            volume[1] += apart.abs() * f64::midpoint(unsure(a), unsure(b));
        }
        Ok(volume)
    }

    /// The longest stretch that shows the outer wall of a thick wall; None if there is none.
    pub fn outer_stretch(&self) -> Option<OuterStretch> {
        let seen: Vec<usize> = (0..self.len()).filter(|n| self.outer_wall[*n] == OuterWall::Seen).collect();
        let at = |n: usize| self.arc_length[n];
        let length = |run: &&[usize]| at(run[run.len() - 1]) - at(run[0]);
        let runs = seen.chunk_by(|a, b| at(*b) - at(*a) <= GAP_MM);
        let run = runs.max_by(|a, b| length(a).total_cmp(&length(b)))?;
        let ends = [at(run[0]), at(run[run.len() - 1])];
        let widest =
            run.iter().max_by(|a, b| self.diameter_outer[**a][0].total_cmp(&self.diameter_outer[**b][0]))?;
        let [diameter, unsure] = self.diameter_outer[*widest];
        let volume = self.outer_volume(ends).ok()?;
        Some(OuterStretch { ends, widest: [at(*widest), diameter, unsure], volume })
    }

    fn outer_middle(&self, n: usize) -> DVec3 {
        let corners = &self.outer_contour[n];
        let mut moment = DVec3::ZERO;
        let mut all = 0.0;
        let middle = self.center[n];
        for (m, a) in corners.iter().enumerate() {
            let (a, b) = (*a - middle, corners[(m + 1) % corners.len()] - middle);
            let area = a.cross(b).dot(self.normal[n]);
            moment += (a + b) * (area / 3.0);
            all += area;
        }
        middle + moment / all
    }
}
