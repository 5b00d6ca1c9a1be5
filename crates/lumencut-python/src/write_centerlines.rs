//! Writes centerline files for `lumencut.files.centerline_writers`.

use lumencut::centerlines::{Line, write_csv, write_mrk_json, write_swc, write_vtk, write_vtp};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::exception;
use crate::tree::points_of;

type Numbers<'py> = Option<PyReadonlyArray1<'py, f64>>;

/// Points (n, 3), radii (n,), name and confidence (n,).
type NamedVessel<'py> = (PyReadonlyArray2<'py, f64>, Numbers<'py>, Option<String>, Numbers<'py>);

/// Writes vessels (mm, LPS) to a file; `kind` is its file name extension.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn write_centerlines<'py>(
    py: Python<'py>,
    vessels: Vec<NamedVessel<'py>>,
    kind: &str,
) -> PyResult<Bound<'py, PyBytes>> {
    let write = match kind {
        "vtp" => write_vtp,
        "mrk.json" => write_mrk_json,
        "vtk" => write_vtk,
        "csv" => write_csv,
        "swc" => write_swc,
        _ => return Err(exception("FormatError", "format", kind, "vtp, mrk.json, vtk, csv or swc", "")),
    };
    let lines = vessels.into_iter().map(line).collect::<PyResult<Vec<_>>>()?;
    let written = py.detach(|| write(&lines));
    let bytes =
        written.map_err(|e| exception("VesselTreeError", &e.subject, &e.found, &e.expected, &e.mend))?;
    Ok(PyBytes::new(py, &bytes))
}

fn line((points, radius, name, confidence): NamedVessel) -> PyResult<Line> {
    let points = points_of(&points)?;
    let [radius, confidence] = [radius, confidence].map(|numbers| numbers.map(|n| n.as_array().to_vec()));
    Ok(Line { points, radius, name, confidence, ..Line::default() })
}
