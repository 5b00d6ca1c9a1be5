//! Marks on a measured vessel, their results, and suggestions for places that are not marked.

use lumencut_core::error::Result;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::groups::Territory;
use lumencut_vessels::measure::stenosis::suggestions::Spot;
use lumencut_vessels::measure::stenosis::{Compared, Method, Stenosis};

use crate::measure_words::{MILLIMETRE_ASSUMED, of_diameter, of_doubts, of_limit, of_stenosis};
use crate::narrower::narrower;
use crate::scan_details::ScanDetails;

/// A reader's marks on one vessel. Inputs of all methods are kept, so that switching the method loses nothing.
#[derive(Clone, Debug)]
pub struct Marked {
    /// The place of the stenosis, an arc length (mm).
    pub at: Option<f64>,
    /// The grading method.
    pub method: Method,
    /// What the stenosis is compared with.
    pub compared: Compared,
    /// The territory for which severity groups are requested.
    pub group: Option<Territory>,
    /// Arc lengths (mm) whose diameters are noted.
    pub diameters: Vec<f64>,
    /// Arc lengths (mm) of marks that confirm suggestions.
    pub confirmed: Vec<f64>,
}

pub(crate) const REFERENCE: &str = "reference";
const NARROWEST: &str = "narrowest place";
pub(crate) const NOTED: &str = "noted diameter";
const MARKED: &str = "marked place";

/// The result at a marked place.
#[derive(Clone, Debug, PartialEq)]
pub enum Grade {
    /// A percentage.
    Graded {
        /// The stenosis.
        stenosis: Stenosis,
        /// The severity group with its source, if a territory was named and the method has groups.
        group: Option<String>,
    },
    /// No percentage.
    NotGraded {
        /// The marked place, an arc length (mm), if something was measured there.
        at: Option<f64>,
        /// Why there is no percentage: a missing mark or an invalid place.
        reason: String,
    },
}

impl Grade {
    /// The stenosis, if graded.
    pub fn stenosis(&self) -> Option<&Stenosis> {
        match self {
            Self::Graded { stenosis, .. } => Some(stenosis),
            Self::NotGraded { .. } => None,
        }
    }

    /// The severity group.
    pub fn group(&self) -> Option<&str> {
        match self {
            Self::Graded { group, .. } => group.as_deref(),
            Self::NotGraded { .. } => None,
        }
    }

    /// Why there is no percentage.
    pub fn not_graded(&self) -> Option<&str> {
        match self {
            Self::Graded { .. } => None,
            Self::NotGraded { reason, .. } => Some(reason),
        }
    }

    /// The marked place that was measured, an arc length (mm).
    pub(crate) fn at(&self) -> Option<f64> {
        match self {
            Self::Graded { stenosis, .. } => Some(stenosis.at),
            Self::NotGraded { at, .. } => *at,
        }
    }

    /// Doubts about the measured place and the references of a percentage, one sentence each.
    pub(crate) fn doubts(&self, profile: &Profile) -> Vec<String> {
        match self {
            Self::Graded { stenosis, .. } => of_doubts(&stenosis.doubts),
            Self::NotGraded { at, .. } => {
                at.map(|at| of_doubts(&profile.doubts(at, Method::Nascet, &[]))).unwrap_or_default()
            }
        }
    }

    /// The first line of the result: the percentage, or the diameter and why there is no percentage.
    pub(crate) fn headline(&self, profile: &Profile) -> String {
        match self {
            Self::Graded { stenosis, .. } => of_stenosis(stenosis),
            Self::NotGraded { at, reason } => {
                let known = at.and_then(|at| Some((at, profile.diameter_at(at).ok()?)));
                let known = known.map(|(at, measured)| format!("{}. ", of_diameter(measured, at)));
                format!("{}No percentage: {reason}", known.unwrap_or_default())
            }
        }
    }

    /// The result as lines of text: percentage, doubts, a narrower place and group, or why there is no percentage.
    pub fn lines(&self, profile: &Profile) -> Vec<String> {
        match self {
            Self::NotGraded { reason, .. } => vec![format!("no percentage: {reason}")],
            Self::Graded { stenosis, group } => {
                let group = group.iter().map(|group| format!("severity group: {group}"));
                let doubts = self.doubts(profile).into_iter().chain(narrower(profile, self.at()));
                [of_stenosis(stenosis)].into_iter().chain(doubts).chain(group).collect()
            }
        }
    }
}

impl Marked {
    /// Grades the marked place; None if nothing is marked. Only the inputs of the chosen method are used.
    pub fn grade(&self, profile: &Profile) -> Option<Grade> {
        let is_marked = self.at.is_some() || !self.compared.reference.is_empty();
        let at = self.at.filter(|at| profile.diameter_at(*at).is_ok());
        is_marked.then(|| self.graded(profile).unwrap_or_else(|reason| Grade::NotGraded { at, reason }))
    }

    fn graded(&self, profile: &Profile) -> std::result::Result<Grade, String> {
        let at = self.at.ok_or("mark the place of the stenosis.")?;
        let words = |error: lumencut_core::error::Error| error.to_string();
        profile.diameter_at(at).map_err(words)?;
        if let Some(missing) = self.missing() {
            return Err(missing.to_owned());
        }
        let stenosis = profile.stenosis(at, self.method, &self.used()).map_err(words)?;
        // Only some methods have groups.
        let group = self.group.and_then(|territory| stenosis.group(territory).ok());
        Ok(Grade::Graded { stenosis, group })
    }

    fn missing(&self) -> Option<&'static str> {
        match self.method {
            Method::Ecst => self
                .compared
                .original
                .is_none()
                .then_some("ECST needs the assumed original diameter at that place."),
            Method::Nascet | Method::Area => {
                self.compared.reference.is_empty().then_some("mark a reference where the vessel is normal.")
            }
        }
    }

    fn used(&self) -> Compared {
        let Compared { reference, original, comparison } = self.compared.clone();
        let none = Compared::default();
        match self.method {
            Method::Ecst => Compared { original, ..none },
            Method::Nascet => Compared { reference, comparison, ..none },
            Method::Area => Compared { reference, ..none },
        }
    }

    /// The references that are offered in addition to the marks; see [`offered_references`].
    pub(crate) fn offered_references(&self, profile: &Profile) -> Result<[Option<Spot>; 2]> {
        offered_references(profile, self.at, &self.compared.reference)
    }

    /// All places to review: [`marks`], then the noted diameters. Places without a measurement are omitted.
    pub fn places(&self, profile: &Profile) -> Vec<Mark> {
        let is_measured = |place: &f64| profile.diameter_at(*place).is_ok();
        let references: Vec<f64> = self.compared.reference.iter().copied().filter(is_measured).collect();
        let mut found = marks(profile, self.at.filter(is_measured), &references).unwrap_or_default();
        for mark in &mut found {
            mark.is_confirmed = !mark.is_suggestion && self.confirmed.contains(&mark.at);
            if mark.is_confirmed && mark.name == MARKED {
                mark.name = NARROWEST;
            }
        }
        found.extend(self.noted(profile));
        found
    }

    fn noted(&self, profile: &Profile) -> Vec<Mark> {
        let mut places = self.diameters.clone();
        places.sort_unstable_by(f64::total_cmp);
        let mark = |at: f64| {
            let (diameter, _) = profile.diameter_at(at).ok()?;
            Some(Mark::measured(NOTED, at, diameter))
        };
        places.into_iter().filter_map(mark).collect()
    }
}

/// A measured vessel with its grade.
#[derive(Clone, Debug)]
pub struct Measured<'a> {
    /// Id of the vessel in the tree; several ids for a path.
    pub id: String,
    /// Name of the vessel, if it has one.
    pub name: Option<String>,
    /// A name for a reader to confirm, if the vessel has none or only a number.
    pub suggested_name: Option<String>,
    /// The profile of the vessel.
    pub profile: &'a Profile,
    /// How the scan was made.
    pub scan: &'a ScanDetails,
    /// The result at the marked place, if any.
    pub grade: Option<&'a Grade>,
    /// Whether 1 mm between voxels is assumed; every output states this.
    pub is_millimetre_assumed: bool,
}

impl Measured<'_> {
    /// The assumption about lengths, in words.
    pub fn assumed(&self) -> Option<&'static str> {
        self.is_millimetre_assumed.then_some(MILLIMETRE_ASSUMED)
    }
}

/// A place to review.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The kind of place: `marked place`, `narrowest place`, `reference` or `NOTED`.
    pub name: &'static str,
    /// Arc length (mm).
    pub at: f64,
    /// Diameter of the circle of the same area (mm); NaN at a throat without a clear wall.
    pub diameter: f64,
    /// The diameter, or the limit of the diameter at a throat.
    pub words: String,
    /// Whether the place is suggested and not marked.
    pub is_suggestion: bool,
    /// Whether the mark is a suggestion that a reader confirmed.
    pub is_confirmed: bool,
}

impl Mark {
    fn measured(name: &'static str, at: f64, diameter: f64) -> Self {
        Self {
            name,
            at,
            diameter,
            words: format!("{diameter:.2} mm"),
            is_suggestion: false,
            is_confirmed: false,
        }
    }

    fn limited(throat: Spot) -> Self {
        let words = of_limit(throat.diameter);
        Self {
            name: NARROWEST,
            at: throat.at,
            diameter: f64::NAN,
            words,
            is_suggestion: true,
            is_confirmed: false,
        }
    }
}

/// The places to review: marks, and suggestions for what is not marked. They ascend along the vessel, but a stenosis
/// comes first. Fails with [`lumencut_core::error::ErrorKind::Measuring`] for a place beyond the vessel or without a
/// measurement.
pub fn marks(profile: &Profile, at: Option<f64>, references: &[f64]) -> Result<Vec<Mark>> {
    // The diameter at the place itself; a percentage uses medians around its references.
    let mark = |name, at, is_suggestion| {
        let measured = profile.diameter_at(at);
        measured.map(|(diameter, _)| Mark { is_suggestion, ..Mark::measured(name, at, diameter) })
    };
    let main = match at {
        Some(at) => Some(mark(MARKED, at, false)?),
        None => match profile.throat() {
            Some(throat) => Some(Mark::limited(throat)),
            None => profile.narrowest().map(|spot| mark(NARROWEST, spot.at, true)).transpose()?,
        },
    };
    let named = references.iter().map(|place| mark(REFERENCE, *place, false));
    let offered = offered_references(profile, at, references)?;
    let offered = offered.into_iter().flatten().map(|spot| mark(REFERENCE, spot.at, true));
    let mut beside = named.chain(offered).collect::<Result<Vec<_>>>()?;
    beside.sort_by(|a, b| a.at.total_cmp(&b.at));
    Ok(main.into_iter().chain(beside).collect())
}

/// The references offered before and after the stenosis or the narrowest place: one on each side without a mark, and none if two
/// are marked. They do not count until a reader accepts them.
pub(crate) fn offered_references(
    profile: &Profile,
    at: Option<f64>,
    references: &[f64],
) -> Result<[Option<Spot>; 2]> {
    let Some(main) = main_place(profile, at).filter(|_| references.len() < 2) else { return Ok([None; 2]) };
    let [before, after] = profile.suggested_references(main)?;
    let is_free = |is_before: bool| !references.iter().any(|place| (*place < main) == is_before);
    Ok([before.filter(|_| is_free(true)), after.filter(|_| is_free(false))])
}

/// The place of the stenosis: the marked place, else the narrowest one or a throat that must be narrower.
pub(crate) fn main_place(profile: &Profile, at: Option<f64>) -> Option<f64> {
    at.or_else(|| profile.throat().or_else(|| profile.narrowest()).map(|spot| spot.at))
}

#[cfg(test)]
#[path = "tests/profile_marks.rs"]
mod tests;
