//! Centerlines of masks, and the connections between two centerlines, for `lumencut.mask_tracing` and
//! `lumencut.centerline_comparison`.

use lumencut::progress::Progress;
use lumencut::trace::{correspondence::correspondence as connections, mask};
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, ndarray::Array2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::to_python;
use crate::pool;
use crate::renderer::{SHARES, Watched, interruptible};
use crate::tree::points_of;
use crate::volume::VolumeArgument;

/// Points (n, 3), radii (n,), the label, and whether it bridges a gap.
type TracedArrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, i64, bool);

type Place = (f64, f64, f64);

/// Width (mm), the ids of the vessels and the points on both sides, whether it was bridged.
type GapParts = (f64, (usize, usize), (Place, Place), bool);

/// The connections between two lines of points (n, 3), (m, 3) as indices of their points, shape (n + m - 1, 2).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn correspondence<'py>(
    py: Python<'py>,
    first: PyReadonlyArray2<'py, f64>,
    second: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let [first, second] = [points_of(&first)?, points_of(&second)?];
    let pairs = interruptible(py, None, |stop| connections(&first, &second, stop).map_err(to_python))?;
    let pairs = Array2::from_shape_fn((pairs.len(), 2), |(n, line)| pairs[n][line] as i64);
    Ok(PyArray2::from_owned_array(py, pairs))
}

/// The vessels of a mask with what else was found, by name.
#[pyfunction]
#[pyo3(signature = (volume, labels, parent_radii, step, bridge, told=None))]
#[allow(clippy::needless_pass_by_value)]
pub fn trace_mask<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    labels: Option<Vec<i64>>,
    parent_radii: f64,
    step: f64,
    bridge: f64,
    told: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let progress = Progress::default();
    let watched = told.as_ref().map(|told| Watched { progress: &progress, told });
    let traced = interruptible(py, watched.as_ref(), |stop| {
        let labels = labels.as_deref();
        let request = mask::Request {
            labels,
            parent_radii,
            step,
            bridge,
            refine: None,
            stop,
            progress: Some(&progress),
        };
        pool::install(|| mask::trace_mask(&volume, &request))?.map_err(to_python)
    })?;
    if let Some(watched) = watched {
        watched.tell(py, SHARES)?;
    }
    let vessels = traced.vessels.into_iter().map(|vessel| -> TracedArrays<'py> {
        let points = Array2::from_shape_fn((vessel.points.len(), 3), |(n, axis)| vessel.points[n][axis]);
        let radius = PyArray1::from_vec(py, vessel.radius);
        (PyArray2::from_owned_array(py, points), radius, vessel.label, vessel.is_bridge)
    });
    let gaps = traced.gaps.into_iter().map(|gap| -> GapParts {
        (gap.width, gap.vessels.into(), gap.points.map(Into::into).into(), gap.is_bridged)
    });
    let all = PyDict::new(py);
    all.set_item("vessels", vessels.collect::<Vec<_>>())?;
    all.set_item("gaps", gaps.collect::<Vec<_>>())?;
    all.set_item("filled", traced.filled)?;
    all.set_item("pieces", traced.pieces)?;
    Ok(all)
}
