//! Grades stenoses at places that the caller chooses.
//!
//! - NASCET: 1 - narrowest / normal distal diameter (NASCET 1991, doi:10.1056/NEJM199108153250701). It does
//!   not apply to a near-occlusion, beyond which the vessel is narrowed (Fox et al. 2005, AJNR 26:2086).
//! - ECST: 1 - narrowest / assumed original diameter (ECST 1998, doi:10.1016/S0140-6736(97)09292-1).
//! - Area: 1 - narrowest / normal area.

pub mod groups;
pub mod hindrances;
pub mod suggestions;
pub mod throat;

use std::f64::consts::PI;

use crate::measure::profile::Profile;
use crate::measure::section::flags::BRANCH;
use crate::measure::uncertainty::{Parts, deviation_of_sum};
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::arc_length::LinePlace;
use lumencut_core::math::same_place::ALONG_LINE;
use lumencut_core::math::statistics::median;
use lumencut_core::named::Named;

/// The reference diameter is the median of the sections within this distance (mm).
pub(crate) const REFERENCE_REACH: f64 = 1.5;

/// A distal vessel is itself narrowed below this fraction of the diameter on the other side of the stenosis.
pub(crate) const NARROWED: f64 = 0.5;

/// The same limit relative to a comparison vessel, such as the contralateral one (Bartlett et al. 2006, AJNR 27:632).
pub(crate) const NARROWED_BESIDE: f64 = 0.87;

/// Distances from the stenosis (mm) between which the vessel on the other side is measured.
const OTHER_SIDE: [f64; 2] = [3.0, 50.0];

/// A place closer to a section than this fraction of the section spacing counts as lying at the section.
const AT_SECTION: f64 = 1e-6;

/// Grading method of a stenosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The diameter is compared with that of the normal vessel.
    Nascet,
    /// The diameter is compared with the assumed original diameter at the stenosis.
    Ecst,
    /// The area is compared with that of the normal vessel.
    Area,
}

impl Named for Method {
    const NAMES: &'static [(&'static str, Self)] =
        &[("nascet", Self::Nascet), ("ecst", Self::Ecst), ("area", Self::Area)];
}

/// Values with which the diameter at a stenosis is compared.
#[derive(Clone, Debug, Default)]
pub struct Compared {
    /// Arc length of a normal place, or of one on each side of the stenosis (mm).
    pub reference: Vec<f64>,
    /// Assumed original diameter (mm), for ECST.
    pub original: Option<f64>,
    /// Diameter of a comparable normal vessel, such as the contralateral one (mm), for NASCET.
    pub comparison: Option<f64>,
}

/// Reasons to doubt a percentage. They should be shown with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Doubts {
    /// Flags of the sections that were used; see [`crate::measure::section::flags`].
    pub flags: u32,
    /// Whether a branch lies between the stenosis and a reference; the calibre may change there.
    pub is_branch_between: bool,
}

/// A stenosis with its grade and the values from which it was computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Stenosis {
    /// Narrowing of diameter or area, 0 to 100.
    pub percent: f64,
    /// Standard deviation of the percentage.
    pub percent_uncertainty: f64,
    /// Arc length of the stenosis (mm).
    pub at: f64,
    /// Equivalent diameter at the stenosis (mm).
    pub diameter: f64,
    /// Standard deviation of the diameter (mm).
    pub uncertainty: f64,
    /// Reference diameter (mm); for [`Method::Area`], that of a circle with the reference area.
    pub reference: f64,
    /// Arc length and diameter of each reference (mm).
    pub references: Vec<[f64; 2]>,
    /// Grading method.
    pub method: Method,
    /// Reasons to doubt the percentage.
    pub doubts: Doubts,
}

impl Profile {
    /// Grades the stenosis at an arc length (mm). Errors: [`ErrorKind::Measuring`] for a place beyond the
    /// vessel or not measured, a missing original diameter, or NASCET at a near-occlusion. Also if a
    /// reference is narrower than the stenosis or within one diameter of it, or both are on one side.
    pub fn stenosis(&self, at: f64, method: Method, compared: &Compared) -> Result<Stenosis> {
        let (diameter, uncertainty) = self.diameter_at(at)?;
        let references = compared
            .reference
            .iter()
            .map(|place| self.reference_at(*place).map(|diameter| [*place, diameter]))
            .collect::<Result<Vec<_>>>()?;
        let reference = match method {
            Method::Ecst => original(compared.original)?,
            Method::Nascet | Method::Area => {
                references.iter().try_for_each(|reference| refuse_near(at, *reference))?;
                at_stenosis(at, &references)?
            }
        };
        if reference < diameter {
            let how = match method {
                Method::Ecst => "as given".to_owned(),
                _ => format!("the median within {REFERENCE_REACH} mm"),
            };
            let found =
                format!("{reference:.2} mm, {how}, but the stenosis at {at:.1} mm measures {diameter:.2} mm");
            let expected = "a diameter that is not below that of the stenosis";
            return Err(measuring("reference of the stenosis", found, expected));
        }
        if method == Method::Nascet {
            self.refuse_near_occlusion(at, &references, compared.comparison)?;
        }
        let share = diameter / reference;
        let left = if method == Method::Area { share * share } else { share };
        let percent = 100.0 * (1.0 - left);
        let doubts = self.doubts(at, method, &compared.reference);
        let percent_uncertainty = self.percent_uncertainty(at, method, share, &references) / reference;
        Ok(Stenosis {
            percent,
            percent_uncertainty,
            at,
            diameter,
            uncertainty,
            reference,
            references,
            method,
            doubts,
        })
    }

    /// Diameter and standard deviation at an arc length (mm), interpolated between usable sections
    /// ([`Profile::counts`]). Errors: [`ErrorKind::Measuring`] for a place beyond the vessel or not measured.
    pub fn diameter_at(&self, at: f64) -> Result<(f64, f64)> {
        self.check_place("place on the vessel", at)?;
        let (place, ends) = self.sections_around(at);
        let diameter = place.between(ends.map(|n| 2.0 * (self.area[n] / PI).sqrt()));
        if diameter.is_nan() {
            let found = self.limit_at(at).map_or_else(
                || format!("nothing measured at {at:.1} mm"),
                |most| format!("no clear wall at {at:.1} mm, where the lumen is at most {most:.2} mm"),
            );
            return Err(measuring("place on the vessel", found, MEASURED));
        }
        Ok((diameter, place.between(ends.map(|n| self.uncertainty[n]))))
    }

    /// Parts of the diameter's standard deviation at an arc length (mm), interpolated between sections.
    pub(crate) fn uncertainty_at(&self, at: f64) -> Parts {
        let (place, ends) = self.sections_around(at);
        let [a, b] = ends.map(|n| &self.uncertainty_parts[n]);
        a.with(b, |a, b| place.between([a, b]))
    }

    /// The sections before and after an arc length (mm); the same section twice if only one of them is
    /// usable. A place at a section always uses that section.
    fn sections_around(&self, at: f64) -> (LinePlace, [usize; 2]) {
        let place = LinePlace::at(&self.arc_length, at);
        let ends = [place.segment, (place.segment + 1).min(self.len() - 1)];
        let is_between = place.share > AT_SECTION && place.share < 1.0 - AT_SECTION;
        let ends = match ends.map(|n| self.counts(n)) {
            [true, false] if is_between => [ends[0]; 2],
            [false, true] if is_between => [ends[1]; 2],
            _ => ends,
        };
        (place, ends)
    }

    /// Standard deviation of the percentage times the reference diameter (mm); `share` is the ratio of the diameters.
    fn percent_uncertainty(&self, at: f64, method: Method, share: f64, references: &[[f64; 2]]) -> f64 {
        let place = self.uncertainty_at(at);
        let known: Vec<(f64, Parts)> = match (method, references) {
            (Method::Ecst, _) => Vec::new(),
            (_, [[a, _], [b, _]]) => {
                let weight = (at - a) / (b - a);
                vec![(1.0 - weight, self.uncertainty_at(*a)), (weight, self.uncertainty_at(*b))]
            }
            _ => references.iter().map(|[place, _]| (1.0, self.uncertainty_at(*place))).collect(),
        };
        let all: Vec<(f64, Parts)> =
            known.into_iter().map(|(weight, parts)| (-share * weight, parts)).chain([(1.0, place)]).collect();
        let by_area = if method == Method::Area { 2.0 * share } else { 1.0 };
        100.0 * by_area * deviation_of_sum(&all)
    }

    /// Median diameter of the usable sections around an arc length (mm).
    pub(crate) fn reference_at(&self, at: f64) -> Result<f64> {
        self.check_place("reference of the stenosis", at)?;
        let around = |n: &usize| (self.arc_length[*n] - at).abs() <= REFERENCE_REACH;
        let mut widths = self.widths((0..self.len()).filter(around));
        if widths.is_empty() {
            // If sections are far apart, the window may contain none.
            return self.diameter_at(at).map(|(diameter, _)| diameter);
        }
        median(&mut widths)
            .ok_or_else(|| measuring("reference of the stenosis", format!("nothing at {at:.1} mm"), MEASURED))
    }

    /// Reasons to doubt a stenosis at arc length `at` with these references (mm), from the sections that are used.
    pub fn doubts(&self, at: f64, method: Method, references: &[f64]) -> Doubts {
        let place = self.nearest_section(at);
        // ECST needs no reference place.
        let told_by = if method == Method::Ecst { &[] } else { references };
        let others: Vec<usize> = told_by.iter().map(|reference| self.nearest_section(*reference)).collect();
        let between = |other: usize| (place.min(other) + 1)..place.max(other);
        let is_branch = |n: usize| self.flags[n] & BRANCH != 0;
        // A reference is the median of several sections.
        let is_used = |n: &usize| {
            let near = |at: &f64| (self.arc_length[*n] - at).abs() <= REFERENCE_REACH;
            self.counts(*n) && told_by.iter().any(near)
        };
        let used = (0..self.len()).filter(is_used);
        Doubts {
            flags: others.iter().copied().chain(used).fold(self.flags[place], |all, n| all | self.flags[n]),
            is_branch_between: others.iter().any(|other| between(*other).any(is_branch)),
        }
    }

    pub(super) fn widths(&self, sections: impl Iterator<Item = usize>) -> Vec<f64> {
        sections.filter(|n| self.counts(*n)).map(|n| 2.0 * (self.area[n] / PI).sqrt()).collect()
    }

    pub(crate) fn check_place(&self, subject: &str, at: f64) -> Result<()> {
        let length = self.arc_length[self.len() - 1];
        // The tolerance allows for rounded arc lengths.
        if at >= -ALONG_LINE && at <= length + ALONG_LINE {
            return Ok(());
        }
        Err(measuring(subject, format!("{at} mm"), &format!("an arc length from 0 to {length:.3} mm")))
    }

    fn refuse_near_occlusion(&self, at: f64, references: &[[f64; 2]], comparison: Option<f64>) -> Result<()> {
        for [place, diameter] in references {
            if let Some(beside) = comparison
                && *diameter <= NARROWED_BESIDE * beside
            {
                let found = format!("{diameter:.2} mm at {place:.1} mm, next to a vessel of {beside:.2} mm");
                return Err(near_occlusion(found, NARROWED_BESIDE, "the vessel it is compared with"));
            }
        }
        let [[place, diameter]] = references else { return Ok(()) };
        let is_other = |n: &usize| {
            let away = self.arc_length[*n] - at;
            away * (place - at) < 0.0 && (OTHER_SIDE[0]..=OTHER_SIDE[1]).contains(&away.abs())
        };
        let mut others = self.widths((0..self.len()).filter(is_other));
        match median(&mut others) {
            Some(other) if *diameter < NARROWED * other => {
                let found = format!("{diameter:.2} mm at {place:.1} mm, {other:.2} mm beyond the stenosis");
                Err(near_occlusion(found, NARROWED, "the vessel on the other side of the stenosis"))
            }
            _ => Ok(()),
        }
    }
}

const MEASURED: &str = "a place where a lumen was measured";

fn measuring(subject: &str, found: String, expected: &str) -> Error {
    Error::new(ErrorKind::Measuring, subject, found, expected)
}

fn near_occlusion(found: String, share: f64, of: &str) -> Error {
    let expected = format!("a reference above {share} of {of}: no place beyond a near-occlusion is normal");
    measuring("reference of the stenosis", found, &expected).mend("state only the diameter in mm")
}

fn original(diameter: Option<f64>) -> Result<f64> {
    let found = match diameter {
        Some(mm) if mm > 0.0 && mm.is_finite() => return Ok(mm),
        Some(mm) => format!("{mm} mm"),
        None => "none".to_owned(),
    };
    Err(measuring("original diameter of the stenosis", found, "the assumed diameter (mm), for ECST"))
}

/// Rejects a reference closer to the stenosis than the reference diameter, because it still belongs to the narrowing.
fn refuse_near(at: f64, [place, diameter]: [f64; 2]) -> Result<()> {
    let away = (place - at).abs();
    // The tolerance allows for rounded arc lengths.
    if away + ALONG_LINE >= diameter {
        return Ok(());
    }
    let found = format!("{place:.1} mm, {away:.1} mm from the stenosis at {at:.1} mm");
    let expected = format!("a place at least one diameter of the vessel ({diameter:.2} mm) away from it");
    let mend = "mark the reference farther from the stenosis, where the vessel is normal";
    Err(measuring("reference of the stenosis", found, &expected).mend(mend))
}

/// The reference diameter at the stenosis, interpolated linearly between two references.
fn at_stenosis(at: f64, references: &[[f64; 2]]) -> Result<f64> {
    match references {
        [[_, diameter]] => Ok(*diameter),
        [[a, first], [b, second]] if (a - at) * (b - at) < 0.0 => {
            Ok(first + (second - first) * (at - a) / (b - a))
        }
        [[a, _], [b, _]] => {
            let found = format!("{a:.1} and {b:.1} mm for a stenosis at {at:.1} mm");
            Err(measuring("reference of the stenosis", found, "one place before it and one after it"))
        }
        _ => {
            let found = format!("{} places", references.len());
            Err(measuring("reference of the stenosis", found, "one place or two"))
        }
    }
}

#[cfg(test)]
#[path = "stenosis/tests/doubts.rs"]
mod tests;

#[cfg(test)]
#[path = "stenosis/tests/near_reference.rs"]
mod near_reference;

#[cfg(test)]
#[path = "stenosis/tests/made_profile.rs"]
pub(crate) mod made_profile;
