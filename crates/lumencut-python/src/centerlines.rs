//! Centerline files for `lumencut.centerlines`.

use lumencut::centerlines::{Centerlines, Error, Line, Space, Unit, junctions};
use lumencut::mends::Mend;
use numpy::{PyArray1, PyArray2, ndarray::Array2};
use pyo3::prelude::*;

use crate::errors::mended;

type Vessel<'py> = (Bound<'py, PyArray2<f64>>, Option<Bound<'py, PyArray1<f64>>>, Option<String>);

/// The lines of a centerline file in its own space and unit.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct CenterlineFile {
    name: String,
    lines: Centerlines,
}

#[pymethods]
impl CenterlineFile {
    /// Reads the content of the file `name`.
    #[new]
    fn new(py: Python<'_>, content: &[u8], name: String) -> PyResult<Self> {
        let lines = py.detach(|| lumencut::centerlines::read(content, &name)).map_err(raised)?;
        Ok(Self { name, lines })
    }

    /// The name of the format.
    #[getter]
    fn format(&self) -> &'static str {
        self.lines.format
    }

    /// `"lps"`, `"ras"`, or None where the file states no space.
    #[getter]
    fn space(&self) -> Option<&'static str> {
        self.lines.space.map(Space::name)
    }

    /// `"um"`, `"mm"`, `"cm"`, `"dm"`, `"m"`, or None where the file states no unit.
    #[getter]
    fn unit(&self) -> Option<&'static str> {
        self.lines.unit.map(Unit::name)
    }

    /// The unit that files of the format usually have.
    #[getter]
    fn conventional_unit(&self) -> &'static str {
        self.lines.conventional_unit.unwrap_or(Unit::Millimetre).name()
    }

    /// `(vessels, notes)`: the vessels that the lines form, each `(points (n, 3), radius (n,) or None, name or
    /// None)`, in mm in the file's space, where one unit of the file is `mm_per_unit`.
    fn vessels<'py>(&self, py: Python<'py>, mm_per_unit: f64) -> PyResult<(Vec<Vessel<'py>>, Vec<String>)> {
        let lines = self.lines.clone();
        let placed = py.detach(|| lines.scaled(mm_per_unit).map(junctions::vessels));
        let placed = placed.map_err(|error| raised(error.in_file(&self.name)))?;
        Ok((placed.lines.into_iter().map(|line| vessel(py, line)).collect(), placed.notes))
    }
}

/// The exception that stands for an error of a file.
pub fn raised(error: Error) -> PyErr {
    let Error { subject, found, expected, mend, mended_by } = error;
    let mended_by = mended_by.map(|mend| Mend::from(*mend));
    mended("FormatError", [&subject, &found, &expected, &mend], mended_by.as_ref())
}

fn vessel(py: Python<'_>, line: Line) -> Vessel<'_> {
    let points = Array2::from_shape_fn((line.points.len(), 3), |(i, axis)| line.points[i][axis]);
    let radius = line.radius.map(|radius| PyArray1::from_vec(py, radius));
    (PyArray2::from_owned_array(py, points), radius, line.name)
}
