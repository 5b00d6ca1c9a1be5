//! How a scan was made, as its file tells it: a number that is measured depends on it, and is told with it.

use serde::{Deserialize, Serialize};

use crate::text::rounded;

/// Digits of a number.
const DIGITS: usize = 6;

/// What a file tells of how its scan was made; None of what it does not tell. Nothing of it names a patient.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(default)]
pub struct ScanDetails {
    /// The number of the series.
    pub series_number: Option<String>,
    /// What the series is called.
    pub series_description: Option<String>,
    /// The phase of the heart, of the contrast medium and of the series, as far as they are stated.
    pub phase: Option<String>,
    /// How thick slices are (mm).
    pub slice_thickness_mm: Option<f64>,
    /// The kernel of the reconstruction.
    pub kernel: Option<String>,
}

/// What tables write of a text that the file does not state.
pub(crate) const NOT_STATED: &str = "not stated";

impl ScanDetails {
    /// That of a file that tells nothing.
    pub(crate) const NOTHING: Self = Self {
        series_number: None,
        series_description: None,
        phase: None,
        slice_thickness_mm: None,
        kernel: None,
    };

    /// All of it in words, with what is not stated.
    pub fn words(&self) -> String {
        let series = match (&self.series_number, &self.series_description) {
            (Some(number), Some(description)) => Some(format!("series {number}, {description}")),
            (Some(one), None) | (None, Some(one)) => Some(format!("series {one}")),
            (None, None) => None,
        };
        let named = [
            ("series", series),
            ("phase", self.phase.as_ref().map(|phase| format!("phase {phase}"))),
            (
                "slice thickness",
                self.slice_thickness_mm.map(|mm| format!("slice thickness {} mm", rounded(mm, DIGITS))),
            ),
            ("kernel", self.kernel.as_ref().map(|kernel| format!("kernel {kernel}"))),
        ];
        let missing: Vec<&str> =
            named.iter().filter(|(_, told)| told.is_none()).map(|(name, _)| *name).collect();
        let told = named.iter().filter_map(|(_, told)| told.clone());
        let missing = (!missing.is_empty()).then(|| format!("{} {NOT_STATED}", missing.join(", ")));
        told.chain(missing).collect::<Vec<_>>().join("; ")
    }

    /// Names and values of the columns of a table.
    pub fn columns(&self) -> [(&'static str, String); 5] {
        let text = |stated: &Option<String>| stated.clone().unwrap_or_else(|| NOT_STATED.to_owned());
        [
            ("series_number", text(&self.series_number)),
            ("series_description", text(&self.series_description)),
            ("phase", text(&self.phase)),
            ("slice_thickness_mm", self.slice_thickness_mm.map(|mm| rounded(mm, DIGITS)).unwrap_or_default()),
            ("kernel", text(&self.kernel)),
        ]
    }
}

#[cfg(test)]
#[path = "tests/scan_details.rs"]
mod tests;
