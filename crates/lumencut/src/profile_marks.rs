//! Places on a measured vessel: those that a reader marked with what is told of them, and suggestions for what was not marked.

use lumencut_core::error::Result;
use lumencut_vessels::measure::groups::Territory;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::{Compared, Method, Stenosis};
use lumencut_vessels::measure::suggestions::Spot;

use crate::measure_words::{MILLIMETRE_ASSUMED, of_doubts, of_stenosis};
use crate::scan_details::ScanDetails;

/// What a reader marked on one vessel to have it graded. It may hold what another method than the chosen one needs: readers try
/// several, and nothing that they gave is lost.
#[derive(Clone, Debug)]
pub struct Marked {
    /// The place of a stenosis, an arc length (mm).
    pub at: Option<f64>,
    /// How it is graded.
    pub method: Method,
    /// What it is compared with.
    pub compared: Compared,
    /// The vessel whose groups of the field are asked for.
    pub group: Option<Territory>,
    /// Places whose diameters are noted, whatever is graded (arc lengths, mm).
    pub diameters: Vec<f64>,
}

/// What a place is called whose diameter a reader noted.
pub(crate) const NOTED: &str = "noted diameter";

/// What is told of a place that a reader marked.
#[derive(Clone, Debug, PartialEq)]
pub enum Grade {
    /// A percentage.
    Graded {
        /// The stenosis.
        stenosis: Stenosis,
        /// Its group of the field with its source, where a territory was named and its method has groups.
        group: Option<String>,
    },
    /// Why there is none: what is still missing, or what is wrong with a place.
    NotGraded(String),
}

impl Grade {
    /// The stenosis, where there is a percentage.
    pub fn stenosis(&self) -> Option<&Stenosis> {
        match self {
            Self::Graded { stenosis, .. } => Some(stenosis),
            Self::NotGraded(_) => None,
        }
    }

    /// The group of the stenosis.
    pub fn group(&self) -> Option<&str> {
        match self {
            Self::Graded { group, .. } => group.as_deref(),
            Self::NotGraded(_) => None,
        }
    }

    /// Why there is no percentage.
    pub fn not_graded(&self) -> Option<&str> {
        match self {
            Self::Graded { .. } => None,
            Self::NotGraded(reason) => Some(reason),
        }
    }

    /// All of it in lines: the percentage, what makes it doubtful, and its group; or why there is none.
    pub fn lines(&self) -> Vec<String> {
        match self {
            Self::NotGraded(reason) => vec![format!("no percentage: {reason}")],
            Self::Graded { stenosis, group } => {
                let group = group.iter().map(|group| format!("severity group: {group}"));
                [of_stenosis(stenosis)].into_iter().chain(of_doubts(&stenosis.doubts)).chain(group).collect()
            }
        }
    }
}

impl Marked {
    /// What is told of the marked place; None where nothing is marked. Of what was given only what the method uses counts, and
    /// only a method that has groups gets one.
    pub fn grade(&self, profile: &Profile) -> Option<Grade> {
        let is_marked = self.at.is_some() || !self.compared.reference.is_empty();
        is_marked.then(|| self.graded(profile).unwrap_or_else(Grade::NotGraded))
    }

    fn graded(&self, profile: &Profile) -> std::result::Result<Grade, String> {
        let at = self.at.ok_or("Mark the place of the stenosis.")?;
        let words = |error: lumencut_core::error::Error| error.to_string();
        profile.diameter_at(at).map_err(words)?;
        if let Some(missing) = self.missing() {
            return Err(missing.to_owned());
        }
        let stenosis = profile.stenosis(at, self.method, &self.used()).map_err(words)?;
        // Other methods than that of the groups have none.
        let group = self.group.and_then(|territory| stenosis.group(territory).ok());
        Ok(Grade::Graded { stenosis, group })
    }

    /// What its method still needs to be given.
    fn missing(&self) -> Option<&'static str> {
        match self.method {
            Method::Ecst => self
                .compared
                .original
                .is_none()
                .then_some("ECST needs the assumed original diameter at that place."),
            Method::Nascet | Method::Area => {
                self.compared.reference.is_empty().then_some("Mark a reference: where the vessel is normal.")
            }
        }
    }

    /// What its method uses of what was given.
    fn used(&self) -> Compared {
        let Compared { reference, original, comparison } = self.compared.clone();
        let none = Compared::default();
        match self.method {
            Method::Ecst => Compared { original, ..none },
            Method::Nascet => Compared { reference, comparison, ..none },
            Method::Area => Compared { reference, ..none },
        }
    }

    /// The references that are offered beside what was marked; see [`offered_references`].
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Measuring`] for a place beyond the vessel.
    pub(crate) fn offered_references(&self, profile: &Profile) -> Result<[Option<Spot>; 2]> {
        offered_references(profile, self.at, &self.compared.reference)
    }

    /// The places to look at, as [`marks`] has them, then those whose diameters are noted; without those where nothing was measured.
    pub fn places(&self, profile: &Profile) -> Vec<Mark> {
        let is_measured = |place: &f64| profile.diameter_at(*place).is_ok();
        let references: Vec<f64> = self.compared.reference.iter().copied().filter(is_measured).collect();
        let mut found = marks(profile, self.at.filter(is_measured), &references).unwrap_or_default();
        found.extend(self.noted(profile));
        found
    }

    /// The places whose diameters are noted, rising, without those where nothing was measured.
    fn noted(&self, profile: &Profile) -> Vec<Mark> {
        let mut places = self.diameters.clone();
        places.sort_unstable_by(f64::total_cmp);
        let mark = |at: f64| {
            let (diameter, _) = profile.diameter_at(at).ok()?;
            Some(Mark { name: NOTED, at, diameter, is_suggestion: false })
        };
        places.into_iter().filter_map(mark).collect()
    }
}

/// A measured vessel with what was graded on it.
#[derive(Clone, Debug)]
pub struct Measured<'a> {
    /// Its id in the tree, or those of the vessels that it is made of.
    pub id: String,
    /// Its name, where it has one.
    pub name: Option<String>,
    /// Its sections.
    pub profile: &'a Profile,
    /// How the scan was made that they were measured in.
    pub scan: &'a ScanDetails,
    /// What is told of the place that a reader marked, where one is marked.
    pub grade: Option<&'a Grade>,
    /// Whether its lengths are in mm only because a reader took the voxels for 1 mm apart; every output tells so.
    pub is_millimetre_assumed: bool,
}

impl Measured<'_> {
    /// What is assumed of its lengths, in words.
    pub fn assumed(&self) -> Option<&'static str> {
        self.is_millimetre_assumed.then_some(MILLIMETRE_ASSUMED)
    }
}

/// A place that somebody should look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// What it is: `marked place`, `narrowest place`, `reference` or [`NOTED`].
    pub name: &'static str,
    /// Its arc length (mm).
    pub at: f64,
    /// The diameter of a circle of the same area there (mm).
    pub diameter: f64,
    /// Whether it is offered; a reader named it otherwise.
    pub is_suggestion: bool,
}

/// The places to look at: those that a reader named, and suggestions for what was not named. They are rising, but for the
/// place of a stenosis, which is the first.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Measuring`] for a place beyond the vessel or where nothing was measured.
pub fn marks(profile: &Profile, at: Option<f64>, references: &[f64]) -> Result<Vec<Mark>> {
    // The diameter at the place itself; references of a stenosis are medians around their places.
    let mark = |name, at, is_suggestion| {
        profile.diameter_at(at).map(|(diameter, _)| Mark { name, at, diameter, is_suggestion })
    };
    let main = main_place(profile, at).map(|main| mark("marked place", main, false)).transpose()?;
    let main = main.map(|found| match at {
        Some(_) => found,
        None => Mark { name: "narrowest place", is_suggestion: true, ..found },
    });
    let named = references.iter().map(|place| mark("reference", *place, false));
    let offered = offered_references(profile, at, references)?;
    let offered = offered.into_iter().flatten().map(|spot| mark("reference", spot.at, true));
    let mut beside = named.chain(offered).collect::<Result<Vec<_>>>()?;
    beside.sort_by(|a, b| a.at.total_cmp(&b.at));
    Ok(main.into_iter().chain(beside).collect())
}

/// The references that are offered before and after the place of a stenosis, or the narrowest place where none is marked: one on
/// each side on which a reader marked none, and none once two are marked. Nothing is graded with them before a reader takes them.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Measuring`] for a place beyond the vessel.
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

/// The place of a stenosis: the marked one, or the narrowest one.
pub(crate) fn main_place(profile: &Profile, at: Option<f64>) -> Option<f64> {
    at.or_else(|| profile.narrowest().map(|spot| spot.at))
}

#[cfg(test)]
#[path = "tests/profile_marks.rs"]
mod tests;
