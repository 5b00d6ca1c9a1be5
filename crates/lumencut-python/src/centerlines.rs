//! Reads centerline files for `lumencut.files.centerlines`, and session files for `lumencut.viewer.session_file`.

use pyo3::prelude::*;

use crate::errors::{advised, mended};
use crate::tree::{VesselArrays, points_of};
use lumencut::centerlines::{Centerlines, Error, Line, Space, Unit, junctions, session_file};
use lumencut::line_doubts::{DoubtedLine, LineDoubt, beside_doubts_of, order_doubts_of};
use lumencut::mends::Mend;
use lumencut::reordering::{in_order, parted_doubt};
use numpy::{PyArray1, PyArray2, ndarray::Array2};

type Vessel<'py> = (Bound<'py, PyArray2<f64>>, Option<Bound<'py, PyArray1<f64>>>, Option<String>);

/// The lines of a centerline file, in the file's space and unit.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct CenterlineFile {
    name: String,
    lines: Centerlines,
}

#[pymethods]
impl CenterlineFile {
    /// Parses the file `name`.
    #[new]
    fn new(py: Python<'_>, content: &[u8], name: String) -> PyResult<Self> {
        let lines = py.detach(|| lumencut::centerlines::read(content, &name)).map_err(raised)?;
        Ok(Self { name, lines })
    }

    #[getter]
    fn format(&self) -> &'static str {
        self.lines.format
    }

    /// The space that the file states: `"lps"`, `"ras"`, or None.
    #[getter]
    fn space(&self) -> Option<&'static str> {
        self.lines.space.map(Space::name)
    }

    /// The unit that the file states: `"um"`, `"mm"`, `"cm"`, `"dm"`, `"m"`, or None.
    #[getter]
    fn unit(&self) -> Option<&'static str> {
        self.lines.unit.map(Unit::name)
    }

    /// The unit that files of this format usually have.
    #[getter]
    fn conventional_unit(&self) -> &'static str {
        self.lines.conventional_unit.unwrap_or(Unit::Millimetre).name()
    }

    fn parted_doubts<'py>(&self, py: Python<'py>) -> PyResult<Vec<Doubt<'py>>> {
        worded(py, py.detach(|| parted_doubt(&self.lines)).into_iter().collect())
    }

    /// Returns `(vessels, notes)`; each vessel is `(points (n, 3), radius (n,) or None, name or None)` in mm, in the file's space.
    /// One unit of the file is `mm_per_unit` mm. `reorder` first sorts the points of each line.
    fn vessels<'py>(
        &self,
        py: Python<'py>,
        mm_per_unit: f64,
        reorder: bool,
    ) -> PyResult<(Vec<Vessel<'py>>, Vec<String>)> {
        let lines = self.lines.clone();
        let ordered = |lines| if reorder { in_order(lines) } else { Ok(lines) };
        let placed = py.detach(|| lines.scaled(mm_per_unit).and_then(ordered).map(junctions::vessels));
        let placed = placed.map_err(|error| raised(error.in_file(&self.name)))?;
        Ok((placed.lines.into_iter().map(|line| vessel(py, line)).collect(), placed.notes))
    }
}

/// A doubt about a line: index of the vessel, of the other vessel if two lie side by side, finding, and remedy.
type Doubt<'py> = (usize, Option<usize>, String, Bound<'py, PyAny>);

fn worded<'py>(py: Python<'py>, doubts: Vec<LineDoubt>) -> PyResult<Vec<Doubt<'py>>> {
    let worded = |doubt: LineDoubt| {
        let advice = if doubt.mend.is_some() { "" } else { doubt.advice };
        Ok((doubt.vessel, doubt.other, doubt.found, advised(py, advice, doubt.mend.as_ref())?))
    };
    doubts.into_iter().map(worded).collect()
}

/// Points (n, 3), radii (n,), and name.
type NamedVessel<'py> = (VesselArrays<'py>, Option<String>);

/// Doubts about the point order of vessels and, if `beside` is set, about pairs of vessels side by side.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn line_doubts<'py>(
    py: Python<'py>,
    vessels: Vec<NamedVessel<'py>>,
    beside: bool,
) -> PyResult<Vec<Doubt<'py>>> {
    let mut owned = Vec::with_capacity(vessels.len());
    for ((points, radius), name) in &vessels {
        let radius = radius.as_ref().map(|radius| radius.as_array().to_vec());
        owned.push((points_of(points)?, radius, name.clone().unwrap_or_default()));
    }
    let doubts = py.detach(|| {
        let lines: Vec<DoubtedLine> = owned
            .iter()
            .map(|(points, radius, name)| DoubtedLine { points, radius: radius.as_deref(), name })
            .collect();
        let mut doubts = order_doubts_of(&lines);
        doubts.extend(if beside { beside_doubts_of(&lines) } else { Vec::new() });
        doubts
    });
    worded(py, doubts)
}

pub(crate) fn raised(error: Error) -> PyErr {
    let Error { subject, found, expected, mend, mended_by } = error;
    let mended_by = mended_by.map(|mend| Mend::from(*mend));
    mended("FormatError", [&subject, &found, &expected, &mend], mended_by.as_ref())
}

fn vessel(py: Python<'_>, line: Line) -> Vessel<'_> {
    let points = Array2::from_shape_fn((line.points.len(), 3), |(i, axis)| line.points[i][axis]);
    let radius = line.radius.map(|radius| PyArray1::from_vec(py, radius));
    (PyArray2::from_owned_array(py, points), radius, line.name)
}

#[pyfunction]
pub(crate) fn is_session_file(py: Python<'_>, content: &[u8]) -> bool {
    py.detach(|| session_file::is_session(content))
}

/// Checks the session file `name` and returns its content, without the lines, as JSON.
#[pyfunction]
pub(crate) fn read_session_file(py: Python<'_>, content: &[u8], name: &str) -> PyResult<String> {
    let file = py.detach(|| session_file::read_session(content, name)).map_err(raised)?;
    file.session.json().map_err(raised)
}
