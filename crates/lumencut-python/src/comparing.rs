//! Compares the profiles of a vessel in two scans.

use lumencut::comparison::Compared;
use lumencut::measure::comparison::{self, ComparedPlace};
use lumencut::report::comparison::comparison_html;
use lumencut::scan_identity::{ScanIdentity, doubts};
use numpy::{PyArray1, PyArray2, ndarray::Array2};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::measuring::Profile;

/// The comparison of a vessel, with the names of vessel and scans.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub(crate) struct Comparison {
    comparison: comparison::Comparison,
    vessel: String,
    scans: [String; 2],
    doubts: Vec<String>,
}

impl Comparison {
    fn compared(&self) -> Compared<'_> {
        Compared {
            vessel: self.vessel.clone(),
            scans: self.scans.clone(),
            comparison: &self.comparison,
            doubts: self.doubts.clone(),
            pictures: Vec::new(),
        }
    }

    fn pairs<'py>(&self, py: Python<'py>, of: fn(&ComparedPlace) -> [f64; 2]) -> Bound<'py, PyArray2<f64>> {
        let places = &self.comparison.places;
        PyArray2::from_owned_array(
            py,
            Array2::from_shape_fn((places.len(), 2), |(n, which)| of(&places[n])[which]),
        )
    }
}

/// Ends of a change (mm), then the place of the largest difference: both arc lengths, diameters and uncertainties, the difference
/// and its uncertainty (mm).
type ChangeParts = ([f64; 2], [f64; 2], [f64; 2], [f64; 2], [f64; 2]);

#[pymethods]
impl Comparison {
    #[getter]
    fn at<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.pairs(py, |place| place.at)
    }

    #[getter]
    fn diameter<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.pairs(py, |place| place.diameter)
    }

    #[getter]
    fn uncertainty<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.pairs(py, |place| place.uncertainty)
    }

    /// Columns: the difference and its standard deviation (mm).
    #[getter]
    fn difference<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.pairs(py, |place| [place.difference, place.difference_uncertainty])
    }

    #[getter]
    fn changes(&self) -> Vec<ChangeParts> {
        let parts = |change: &comparison::Change| {
            let ComparedPlace { at, diameter, uncertainty, difference, difference_uncertainty } =
                change.largest;
            (change.range, at, diameter, uncertainty, [difference, difference_uncertainty])
        };
        self.comparison.changes.iter().map(parts).collect()
    }

    #[getter]
    fn typical(&self) -> f64 {
        self.comparison.typical
    }

    /// Rotation by columns, then translation (mm), of the motion from the first scan to the second.
    #[getter]
    fn motion<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let motion = &self.comparison.matching.motion;
        let turned = glam::DMat3::from_quat(motion.rotation).to_cols_array();
        PyArray1::from_vec(py, [&turned[..], &motion.translation.to_array()].concat())
    }

    #[getter]
    fn matched(&self) -> (String, f64) {
        (self.compared().matched(), self.comparison.matching.deviation)
    }

    #[getter]
    fn lines(&self) -> Vec<String> {
        self.compared().lines()
    }

    fn csv(&self) -> String {
        self.compared().csv()
    }

    fn json(&self) -> String {
        self.compared().json()
    }
}

/// Compares two profiles; `pairs` are arc lengths on both that belong together (mm), `stated` the patient, issuer and modality of each
/// scan.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn compare_scans(
    py: Python<'_>,
    profiles: [Py<Profile>; 2],
    pairs: Vec<[f64; 2]>,
    vessel: String,
    scans: [String; 2],
    stated: [(String, String, String); 2],
    other_patient: bool,
) -> PyResult<Comparison> {
    let stated = stated.map(|(patient, issuer, modality)| ScanIdentity { patient, issuer, modality });
    let doubts = doubts(&stated, other_patient, true).map_err(to_python)?;
    let [first, second] = profiles.each_ref().map(|profile| &profile.get().0);
    let comparison = py.detach(|| comparison::compare(first, second, &pairs)).map_err(to_python)?;
    Ok(Comparison { comparison, vessel, scans, doubts })
}

/// The report of compared vessels as HTML.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn comparison_report(vessels: Vec<Py<Comparison>>) -> PyResult<String> {
    let compared: Vec<Compared> = vessels.iter().map(|one| one.get().compared()).collect();
    comparison_html(&compared).map_err(to_python)
}
