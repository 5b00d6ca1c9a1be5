//! Converts Python's description of how a scan was made.

use lumencut::scan_details::ScanDetails;
use pyo3::prelude::*;

#[derive(FromPyObject)]
pub(crate) struct ScanArgument {
    series_number: Option<String>,
    series_description: Option<String>,
    phase: Option<String>,
    slice_thickness: Option<f64>,
    kernel: Option<String>,
}

impl ScanArgument {
    pub(crate) fn details(&self) -> ScanDetails {
        ScanDetails {
            series_number: self.series_number.clone(),
            series_description: self.series_description.clone(),
            phase: self.phase.clone(),
            slice_thickness_mm: self.slice_thickness,
            kernel: self.kernel.clone(),
        }
    }
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn scan_words(scan: ScanArgument) -> String {
    scan.details().words()
}
