//! Traces masks and compares centerlines; used by `lumencut.tracing.mask_tracing` and `lumencut.tracing.centerline_comparison`.

use glam::{DAffine3, DMat3, DVec3};
use lumencut::mask_grid::{Grid, place_of, place_within, placed_note};
use lumencut::mask_notes::notes;
use lumencut::progress::Progress;
use lumencut::trace::lines::correspondence::correspondence as connections;
use lumencut::trace::mask::grey_values::GreyValues;
use lumencut::trace::mask::{MaskRequest, trace_mask as core_trace_mask};
use lumencut::trace::skeleton::mask_refinement::Refine;
use lumencut::voxels::Voxels;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, ndarray::Array2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::to_python;
use crate::pool;
use crate::tree::points_of;
use crate::volume::VolumeArgument;
use crate::watching::{Reporter, SHARES, interruptible};

/// A vessel: points (n, 3), radii (n,), confidence (n,) or (0,), label, and whether it bridges a gap.
type TracedArrays<'py> =
    (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, i64, bool);

type Place = (f64, f64, f64);

/// The shortest branch (radii of its parent), the distance of points, and the widest gap to bridge (mm).
type Lengths = (f64, f64, f64);

/// A gap: its width (mm), vessel ids and points on both sides, and whether it was bridged.
type GapParts = (f64, (usize, usize), (Place, Place), bool);

/// The corresponding points of two lines (n, 3) and (m, 3): pairs of point indices, shape (n + m - 1, 2).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn correspondence<'py>(
    py: Python<'py>,
    first: PyReadonlyArray2<'py, f64>,
    second: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let [first, second] = [points_of(&first)?, points_of(&second)?];
    let pairs = interruptible(py, None, |stop| connections(&first, &second, stop).map_err(to_python))?;
    let pairs = Array2::from_shape_fn((pairs.len(), 2), |(n, line)| pairs[n][line] as i64);
    Ok(PyArray2::from_owned_array(py, pairs))
}

type GridParts = ([usize; 3], [[f64; 4]; 3]);

/// The volume axis of each mask axis; for each volume axis, whether the mask has the same direction, and its lowest index; a note.
type PlaceParts = ([usize; 3], [bool; 3], [usize; 3], String);

/// The position of a mask in its volume; None if their grids are equal.
#[pyfunction]
pub(crate) fn place_mask(mask: GridParts, volume: GridParts, always: bool) -> PyResult<Option<PlaceParts>> {
    let [own, every] = [mask, volume].map(|(size, rows)| {
        let column = |axis: usize| DVec3::from_array(rows.map(|row| row[axis]));
        let matrix3 = DMat3::from_cols(column(0), column(1), column(2));
        Grid { size, world_from_index: DAffine3 { matrix3, translation: column(3) } }
    });
    let place = if always { place_within(&own, &every).map(Some) } else { place_of(&own, &every) };
    let note = placed_note(own.size, every.size);
    Ok(place.map_err(to_python)?.map(|place| (place.axes, place.forward, place.low, note)))
}

/// The vessels of a mask, and a dictionary with details. If a volume is given, its grey values refine the vessels.
#[pyfunction]
#[pyo3(signature = (mask, volume, labels, lengths, callback=None))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn trace_mask<'py>(
    py: Python<'py>,
    mask: VolumeArgument<'py>,
    volume: Option<VolumeArgument<'py>>,
    labels: Option<Vec<i64>>,
    lengths: Lengths,
    callback: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let borrowed = mask.borrow()?;
    let mask = mask.volume(&borrowed)?;
    let borrowed = volume.as_ref().map(VolumeArgument::borrow).transpose()?;
    let volume = volume.iter().zip(&borrowed).map(|(volume, borrowed)| volume.volume(borrowed)).next();
    let volume = volume.transpose()?;
    let voxels = volume.as_ref().map(Voxels::new);
    let progress = Progress::default();
    let reporter = callback.as_ref().map(|callback| Reporter { progress: &progress, callback });
    let traced = interruptible(py, reporter.as_ref(), |stop| {
        let (labels, progress) = (labels.as_deref(), Some(&progress));
        let (parent_radii, step, bridge) = lengths;
        let grey_values = voxels.as_ref().map(|voxels| GreyValues { voxels, stop });
        let by_values = grey_values
            .as_ref()
            .map(|values| |points: &[DVec3], radius: &[f64]| values.refined(points, radius));
        let refine = by_values.as_ref().map(|refine| -> Refine { refine });
        let request = MaskRequest { labels, parent_radii, step, bridge, refine, stop, progress };
        pool::install(|| core_trace_mask(&mask, &request))?.map_err(to_python)
    })?;
    if let Some(reporter) = reporter {
        reporter.report(py, SHARES)?;
    }
    let notes = notes(&traced, &mask, volume.is_some());
    let vessels = traced.vessels.into_iter().map(|vessel| -> TracedArrays<'py> {
        let points = Array2::from_shape_fn((vessel.points.len(), 3), |(n, axis)| vessel.points[n][axis]);
        let [radius, confidence] = [vessel.radius, vessel.confidence].map(|of| PyArray1::from_vec(py, of));
        (PyArray2::from_owned_array(py, points), radius, confidence, vessel.label, vessel.is_bridge)
    });
    let gaps = traced.gaps.into_iter().map(|gap| -> GapParts {
        (gap.width, gap.vessels.into(), gap.points.map(Into::into).into(), gap.is_bridged)
    });
    let all = PyDict::new(py);
    all.set_item("vessels", vessels.collect::<Vec<_>>())?;
    all.set_item("gaps", gaps.collect::<Vec<_>>())?;
    all.set_item("notes", notes)?;
    Ok(all)
}
