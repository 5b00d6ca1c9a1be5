//! Places on a measured vessel: those that a reader marked, and suggestions for what was not marked.

use lumencut_core::error::Result;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::{Compared, Method, Stenosis};

/// What a reader marked on one vessel to have it graded.
#[derive(Clone, Debug)]
pub struct Marked {
    /// The place of a stenosis, an arc length (mm).
    pub at: Option<f64>,
    /// How it is graded.
    pub method: Method,
    /// What it is compared with.
    pub compared: Compared,
}

impl Marked {
    /// The stenosis; None where its place, or what its method compares it with, is not marked yet.
    ///
    /// # Errors
    /// As [`Profile::stenosis`].
    pub fn stenosis(&self, profile: &Profile) -> Result<Option<Stenosis>> {
        let is_whole = match self.method {
            Method::Ecst => self.compared.original.is_some(),
            Method::Nascet | Method::Area => !self.compared.reference.is_empty(),
        };
        let at = self.at.filter(|_| is_whole);
        at.map(|at| profile.stenosis(at, self.method, &self.compared)).transpose()
    }
}

/// A place that somebody should look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// What it is: `marked place`, `narrowest place` or `reference`.
    pub name: &'static str,
    /// Its arc length (mm).
    pub at: f64,
    /// The diameter of a circle of the same area there (mm).
    pub diameter: f64,
    /// Whether it is offered; a reader named it otherwise.
    pub is_suggestion: bool,
}

/// The places to look at: those that a reader named, and suggestions for what was not named.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Measuring`] for a place beyond the vessel or where nothing was measured.
pub fn marks(profile: &Profile, at: Option<f64>, references: &[f64]) -> Result<Vec<Mark>> {
    // The diameter at the place itself; references of a stenosis are medians around their places.
    let mark = |name, at, is_suggestion| {
        profile.diameter_at(at).map(|(diameter, _)| Mark { name, at, diameter, is_suggestion })
    };
    let mut found = Vec::new();
    match at {
        Some(at) => found.push(mark("marked place", at, false)?),
        None => {
            if let Some(spot) = profile.narrowest() {
                found.push(mark("narrowest place", spot.at, true)?);
            }
        }
    }
    for place in references {
        found.push(mark("reference", *place, false)?);
    }
    if let (Some(first), true) = (found.first().map(|first| first.at), references.is_empty()) {
        for spot in profile.suggested_references(first)?.into_iter().flatten() {
            found.push(mark("reference", spot.at, true)?);
        }
    }
    Ok(found)
}
