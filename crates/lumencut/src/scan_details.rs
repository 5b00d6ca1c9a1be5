//! How a scan was made, as stated by its file. Measurements depend on it, so it is reported with them.

use serde::{Deserialize, Serialize};

use crate::text::rounded;

const DIGITS: usize = 6;

/// Acquisition details; None if the file does not state them. No detail identifies the patient.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(default)]
pub struct ScanDetails {
    /// Series number.
    pub series_number: Option<String>,
    /// Series description.
    pub series_description: Option<String>,
    /// Phase of the heart, of the contrast medium and of the series, as far as the file states them.
    pub phase: Option<String>,
    /// Slice thickness (mm).
    pub slice_thickness_mm: Option<f64>,
    /// Reconstruction kernel.
    pub kernel: Option<String>,
}

/// What tables show for a detail that is not stated.
pub(crate) const NOT_STATED: &str = "not stated";

impl ScanDetails {
    pub(crate) const NOTHING: Self = Self {
        series_number: None,
        series_description: None,
        phase: None,
        slice_thickness_mm: None,
        kernel: None,
    };

    /// All details in words; details that are not stated are named too.
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
            named.iter().filter(|(_, stated)| stated.is_none()).map(|(name, _)| *name).collect();
        let stated = named.iter().filter_map(|(_, stated)| stated.clone());
        let missing = (!missing.is_empty()).then(|| format!("{} {NOT_STATED}", missing.join(", ")));
        stated.chain(missing).collect::<Vec<_>>().join("; ")
    }

    /// Names and values of the table columns that describe the scan.
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
