//! What a reader marked on a vessel, and what the facade tells of it.

use lumencut::measure::groups::Territory;
use lumencut::measure::stenosis::{Compared, Method};
use lumencut::named::Named;
use lumencut::profile_marks::{self, Marked};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::measuring::{Profile, Stenosis};

/// The attributes of `lumencut.measured_vessel.Marked`.
#[derive(FromPyObject)]
pub(crate) struct MarkedParts {
    at: Option<f64>,
    references: Vec<f64>,
    method: String,
    original: Option<f64>,
    comparison: Option<f64>,
    group: Option<String>,
    diameters: Vec<f64>,
}

impl MarkedParts {
    /// The same for the facade.
    pub(crate) fn marked(&self) -> PyResult<Marked> {
        let method = Method::named("method of the stenosis", &self.method).map_err(to_python)?;
        let territory = self.group.as_ref().map(|name| Territory::named("vessel of the group", name));
        let compared = Compared {
            reference: self.references.clone(),
            original: self.original,
            comparison: self.comparison,
        };
        let group = territory.transpose().map_err(to_python)?;
        Ok(Marked { at: self.at, method, compared, group, diameters: self.diameters.clone() })
    }
}

/// What is told of a place that a reader marked.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct Grade(pub profile_marks::Grade);

#[pymethods]
impl Grade {
    /// The stenosis; None where it is not graded.
    #[getter]
    fn stenosis(&self) -> Option<Stenosis> {
        self.0.stenosis().cloned().map(Stenosis)
    }

    /// The group of the field with its source.
    #[getter]
    fn group(&self) -> Option<&str> {
        self.0.group()
    }

    /// Why it is not graded.
    #[getter]
    fn not_graded(&self) -> Option<&str> {
        self.0.not_graded()
    }

    /// All of it in lines.
    #[getter]
    fn lines(&self) -> Vec<String> {
        self.0.lines()
    }
}

/// What is told of the place that a reader marked on a vessel; None where nothing is marked.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn grade(profile: &Profile, marked: MarkedParts) -> PyResult<Option<Grade>> {
    Ok(marked.marked()?.grade(&profile.0).map(Grade))
}
