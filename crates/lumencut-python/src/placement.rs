//! Finds space and unit of centerlines; used by `lumencut.scene.placement`.

use glam::DVec3;
use lumencut::centerlines::{Space, Unit};
use lumencut::extent::Extent;
use lumencut::lumen_points::{Lines, lumen_count};
use lumencut::misplaced;
use lumencut::placement::{self as decision, Judge, Known};
use lumencut::places::{LARGEST, SMALLEST, Statement, signs};
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::centerlines::raised;
use crate::tree::points_of;
use crate::volume::{GridArgument, VolumeArgument};

pub(crate) struct SpaceArgument(Space);

impl FromPyObject<'_, '_> for SpaceArgument {
    type Error = PyErr;

    fn extract(name: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        let name: String = name.extract()?;
        let space = Space::ALL.into_iter().find(|space| space.name() == name);
        space.map(Self).ok_or_else(|| PyValueError::new_err(name))
    }
}

pub(crate) struct UnitArgument(Unit);

impl FromPyObject<'_, '_> for UnitArgument {
    type Error = PyErr;

    fn extract(name: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        let name: String = name.extract()?;
        let unit = Unit::ALL.into_iter().find(|unit| unit.name() == name);
        unit.map(Self).ok_or_else(|| PyValueError::new_err(name))
    }
}

/// What is known about a file's coordinates: the caller's request and the file's statement (`lumencut.scene.placement.Stated`).
#[derive(FromPyObject)]
pub(crate) struct KnownArgument {
    #[pyo3(item)]
    asked_space: Option<SpaceArgument>,
    #[pyo3(item)]
    asked_unit: Option<UnitArgument>,
    #[pyo3(item)]
    stated_space: Option<SpaceArgument>,
    #[pyo3(item)]
    stated_unit: Option<UnitArgument>,
    #[pyo3(item)]
    usual_unit: UnitArgument,
}

impl KnownArgument {
    fn known(self) -> Known {
        Known {
            asked_space: self.asked_space.map(|space| space.0),
            asked_unit: self.asked_unit.map(|unit| unit.0),
            stated_space: self.stated_space.map(|space| space.0),
            stated_unit: self.stated_unit.map(|unit| unit.0),
            usual_unit: self.usual_unit.0,
        }
    }
}

/// Adds to the module: millimetres per unit, signs from each space to LPS, and the plausible extents of vessels (mm).
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let (units, spaces) = (PyDict::new(module.py()), PyDict::new(module.py()));
    for unit in Unit::ALL {
        units.set_item(unit.name(), unit.in_mm())?;
    }
    for space in Space::ALL {
        let signs: (f64, f64, f64) = signs(space).into();
        spaces.set_item(space.name(), signs)?;
    }
    module.add("MILLIMETRES", units)?;
    module.add("SIGNS", spaces)?;
    module.add("SMALLEST_EXTENT", SMALLEST)?;
    module.add("LARGEST_EXTENT", LARGEST)
}

/// Calls `decide` with the extent of a volume and its values along points (n, 3) with radii (n,).
fn judged<T: Send>(
    py: Python<'_>,
    (points, radii): (&[DVec3], &PyReadonlyArray1<'_, f64>),
    volume: &VolumeArgument<'_>,
    decide: impl Fn(&Judge) -> T + Sync,
) -> PyResult<T> {
    if radii.len() != points.len() {
        return Err(PyValueError::new_err(format!("{} points, {} radii", points.len(), radii.len())));
    }
    let (borrowed, radii) = (volume.borrow()?, radii.as_array().to_vec());
    let volume = volume.volume(&borrowed)?;
    let lines = Lines { points, radii: &radii };
    let lumen = |place| lumen_count(&volume, &lines, place);
    Ok(py.detach(|| decide(&Judge { extent: Extent::from(&volume), lumen: &lumen })))
}

/// How to read the file `subject` with points (n, 3) and radii (n,), NaN if unknown. Returns the attributes of
/// `lumencut.scene.placement.Placement`.
#[pyfunction]
#[pyo3(signature = (subject, points, radii, known, volume))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn placement<'py>(
    py: Python<'py>,
    subject: &str,
    points: PyReadonlyArray2<'py, f64>,
    radii: PyReadonlyArray1<'py, f64>,
    known: KnownArgument,
    volume: Option<VolumeArgument<'py>>,
) -> PyResult<Bound<'py, PyDict>> {
    let (points, known) = (points_of(&points)?, known.known());
    let found = match volume {
        Some(volume) => {
            let decide = |judge: &Judge| decision::placement(&known, &points, Some(judge));
            judged(py, (&points, &radii), &volume, decide)?
        }
        None => decision::placement(&known, &points, None),
    };
    let found = found.map_err(|error| raised(error.in_file(subject)))?;
    let fields = PyDict::new(py);
    fields.set_item("space", found.place.space.name())?;
    fields.set_item("unit", found.place.unit.name())?;
    fields.set_item("space_from", found.space_from.name())?;
    fields.set_item("unit_from", found.unit_from.name())?;
    fields.set_item("decision", found.decision)?;
    fields.set_item("confirmed_by", names_of(found.confirmed_by))?;
    fields.set_item("is_unusual", found.is_unusual)?;
    fields.set_item("also", found.also.iter().map(|unit| unit.name()).collect::<Vec<_>>())?;
    let doubt = found
        .doubt
        .map(|doubt| (doubt.found, doubt.units.iter().map(|unit| unit.name()).collect::<Vec<_>>()));
    fields.set_item("doubt", doubt)?;
    Ok(fields)
}

fn names_of(stated: Statement) -> (Option<&'static str>, Option<&'static str>) {
    (stated.space.map(Space::name), stated.unit.map(Unit::name))
}

type Better = (String, (&'static str, &'static str));

/// The space and unit in which points (n, 3) with radii (n,), read as LPS in mm, fit the volume or its lumen better; None if they
/// fit as read. Unknown radii are NaN.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn better_place(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    radii: PyReadonlyArray1<'_, f64>,
    volume: VolumeArgument<'_>,
) -> PyResult<Option<Better>> {
    let points = points_of(&points)?;
    let better = judged(py, (&points, &radii), &volume, |judge| misplaced::better_place(&points, judge))?;
    Ok(better.map(|better| (better.found, (better.meant.space.name(), better.meant.unit.name()))))
}

/// Whether points (n, 3) (mm, LPS) miss a volume in every combination of space and unit.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn fits_nowhere(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    volume: GridArgument,
) -> PyResult<bool> {
    let (points, extent) = (points_of(&points)?, volume.extent());
    Ok(py.detach(|| misplaced::fits_nowhere(&points, &extent)))
}
