//! The grade of a stenosis.

use lumencut::measure::stenosis as graded;
use lumencut::measure::stenosis::groups::Territory;
use lumencut::measure_words;
use lumencut::named::Named;
use pyo3::prelude::*;

use crate::errors::to_python;

#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct Stenosis(pub graded::Stenosis);

#[pymethods]
impl Stenosis {
    /// Percent, place (mm), diameter (mm) and its uncertainty, reference (mm), and uncertainty of the percentage.
    fn numbers(&self) -> (f64, f64, f64, f64, f64, f64) {
        let graded = &self.0;
        let unsure = graded.percent_uncertainty;
        (graded.percent, graded.at, graded.diameter, graded.uncertainty, graded.reference, unsure)
    }

    /// Arc length and diameter of each reference (mm).
    #[getter]
    fn references(&self) -> Vec<(f64, f64)> {
        self.0.references.iter().map(|[at, diameter]| (*at, *diameter)).collect()
    }

    #[getter]
    fn method(&self) -> &'static str {
        self.0.method.name()
    }

    #[getter]
    fn doubts(&self) -> Vec<String> {
        measure_words::of_doubts(&self.0.doubts)
    }

    fn words(&self) -> String {
        measure_words::of_stenosis(&self.0)
    }

    fn doubtful_words(&self) -> String {
        measure_words::of_doubtful_stenosis(&self.0)
    }

    fn group(&self, vessel: &str) -> PyResult<String> {
        let group =
            Territory::named("vessel of the group", vessel).and_then(|territory| self.0.group(territory));
        group.map_err(to_python)
    }
}
