//! Space and unit of centerlines, for `lumencut.placement`.

use lumencut::centerlines::{Space, Unit};
use lumencut::placement::{self as decision, Known};
use lumencut::places::{LARGEST, SMALLEST, signs};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::centerlines::raised;
use crate::tree::points_of;
use crate::volume::GridArgument;

/// A space by its name.
pub struct SpaceArgument(Space);

impl FromPyObject<'_, '_> for SpaceArgument {
    type Error = PyErr;

    fn extract(name: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        let name: String = name.extract()?;
        let space = Space::ALL.into_iter().find(|space| space.name() == name);
        space.map(Self).ok_or_else(|| PyValueError::new_err(name))
    }
}

/// A unit by its name.
pub struct UnitArgument(Unit);

impl FromPyObject<'_, '_> for UnitArgument {
    type Error = PyErr;

    fn extract(name: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        let name: String = name.extract()?;
        let unit = Unit::ALL.into_iter().find(|unit| unit.name() == name);
        unit.map(Self).ok_or_else(|| PyValueError::new_err(name))
    }
}

/// What is known of a file's coordinates: what the caller asks for, and the attributes of `lumencut.placement.Stated`.
#[derive(FromPyObject)]
pub struct KnownArgument {
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

/// Millimetres per unit, what brings each space to LPS, and the extents (mm) that pass for vessels of a body.
pub fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
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

/// How the points (n, 3) of the file `subject` are to be understood: the attributes of `lumencut.placement.Placement`.
#[pyfunction]
#[pyo3(signature = (subject, points, known, volume))]
#[allow(clippy::needless_pass_by_value)]
pub fn placement<'py>(
    py: Python<'py>,
    subject: &str,
    points: PyReadonlyArray2<'py, f64>,
    known: KnownArgument,
    volume: Option<GridArgument>,
) -> PyResult<Bound<'py, PyDict>> {
    let (points, extent) = (points_of(&points)?, volume.map(|grid| grid.extent()));
    let found = py.detach(|| decision::placement(&known.known(), &points, extent.as_ref()));
    let found = found.map_err(|error| raised(&error.in_file(subject)))?;
    let fields = PyDict::new(py);
    fields.set_item("space", found.place.space.name())?;
    fields.set_item("unit", found.place.unit.name())?;
    fields.set_item("space_from", found.space_from.name())?;
    fields.set_item("unit_from", found.unit_from.name())?;
    fields.set_item("decision", found.decision)?;
    fields.set_item("is_unusual", found.is_unusual)?;
    Ok(fields)
}

/// What is to be said of points (n, 3) (mm, LPS) that another space or unit brings into a volume.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn better_place(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    volume: GridArgument,
) -> PyResult<Option<String>> {
    let (points, extent) = (points_of(&points)?, volume.extent());
    Ok(py.detach(|| decision::better_place(&points, &extent)))
}

/// Whether points (n, 3) (mm, LPS) miss a volume in whatever space and unit they might be meant.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn fits_nowhere(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    volume: GridArgument,
) -> PyResult<bool> {
    let (points, extent) = (points_of(&points)?, volume.extent());
    Ok(py.detach(|| decision::fits_nowhere(&points, &extent)))
}
