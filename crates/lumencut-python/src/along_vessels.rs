//! Values along the vessels of a tree, for rims and maps.

use lumencut::along_vessels::{self, Along, vessel_of};
use lumencut::named::Named;
use lumencut::settings::RimValue;
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::errors::{exception, to_python};
use crate::measuring::Profile;
use crate::stenosis::Stenosis;
use crate::tree::{VesselArrays, tree};

type MeasuredArguments<'py> = Vec<(PyRef<'py, Profile>, Vec<PyRef<'py, Stenosis>>)>;

/// Values of each vessel at equal steps of arc length, and what their colours mean.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct ValuesAlong(pub along_vessels::ValuesAlong);

#[pymethods]
impl ValuesAlong {
    /// The values of this name of vessels, from profiles with their graded stenoses, otherwise from radii.
    #[new]
    #[allow(clippy::needless_pass_by_value)]
    fn new(kind: &str, vessels: Vec<VesselArrays<'_>>, measured: MeasuredArguments<'_>) -> PyResult<Self> {
        let (kind, tree) = (RimValue::named("value", kind).map_err(to_python)?, tree(&vessels)?);
        let mut along: Vec<_> =
            tree.vessels().iter().map(|vessel| Along { vessel, profile: None, stenoses: &[] }).collect();
        let graded: Vec<Vec<_>> =
            measured.iter().map(|(_, all)| all.iter().map(|one| one.0.clone()).collect()).collect();
        for ((profile, _), stenoses) in measured.iter().zip(&graded) {
            let id = vessel_of(&profile.0, tree.vessels()).map_err(to_python)?;
            if along[id].profile.is_some() {
                let found = format!("two profiles of vessel {id}");
                return Err(exception("MeasuringError", "profiles", &found, "one of each vessel", ""));
            }
            along[id] = Along { profile: Some(&profile.0), stenoses, ..along[id] };
        }
        along_vessels::ValuesAlong::new(kind, &along).map(Self).map_err(to_python)
    }

    /// The same values with other ends of the colours.
    fn ranged(&self, low: Option<f64>, high: Option<f64>) -> PyResult<Self> {
        self.0.clone().ranged([low, high]).map(Self).map_err(to_python)
    }

    /// The quantity and its unit in words, the values of the first and the last colour, and the name of the colours.
    #[getter]
    fn legend(&self) -> (&'static str, &'static str, f64, f64, &'static str) {
        let along_vessels::Legend { words, unit, ends: [low, high], colours } = self.0.legend;
        (words, unit, low, high, colours.name())
    }

    /// The values of each vessel, NaN where unknown.
    fn values<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyArray1<f32>>> {
        self.0.values.iter().map(|values| PyArray1::from_slice(py, values)).collect()
    }
}
