//! A reader's marks on a vessel, and the results at the marked places.

use lumencut::measure::stenosis::groups::Territory;
use lumencut::measure::stenosis::{Compared, Method};
use lumencut::named::Named;
use lumencut::profile_marks::{self, Marked};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::measuring::Profile;
use crate::stenosis::Stenosis;

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
    pub(crate) fn marked(&self) -> PyResult<Marked> {
        let method = Method::named("method of the stenosis", &self.method).map_err(to_python)?;
        let territory = self.group.as_ref().map(|name| Territory::named("vessel of the group", name));
        let compared = Compared {
            reference: self.references.clone(),
            original: self.original,
            comparison: self.comparison,
        };
        let group = territory.transpose().map_err(to_python)?;
        Ok(Marked {
            at: self.at,
            method,
            compared,
            group,
            diameters: self.diameters.clone(),
            confirmed: Vec::new(),
        })
    }
}

#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct Grade(pub profile_marks::Grade);

#[pymethods]
impl Grade {
    #[getter]
    fn stenosis(&self) -> Option<Stenosis> {
        self.0.stenosis().cloned().map(Stenosis)
    }

    #[getter]
    fn group(&self) -> Option<&str> {
        self.0.group()
    }

    #[getter]
    fn not_graded(&self) -> Option<&str> {
        self.0.not_graded()
    }

    fn lines(&self, profile: &Profile) -> Vec<String> {
        self.0.lines(&profile.0)
    }
}

/// The result at the marked place; None if no place is marked.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn grade(profile: &Profile, marked: MarkedParts) -> PyResult<Option<Grade>> {
    Ok(marked.marked()?.grade(&profile.0).map(Grade))
}
