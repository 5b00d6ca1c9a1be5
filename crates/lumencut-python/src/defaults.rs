//! The table of defaults, and the pixel side of reformations.

use lumencut::defaults::{self, PIXEL_SIDE_WORDS, QUANTITIES, SMALLEST_RADIUS_WORDS};
use lumencut::trace::lumen::refine;
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

/// The pixel side (mm) of reformations by default, in a scan with this smallest voxel side (mm).
#[pyfunction]
pub(crate) fn pixel_side(smallest_side: f64) -> f64 {
    defaults::pixel_side(smallest_side)
}

/// Adds to the module: the defaults by name, the table (name, other functions, unit, range, default, sentence), and
/// the rules for pixel sides and smallest radii in words.
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let by_name: Vec<_> = QUANTITIES.iter().map(|row| (row.name, row.default)).collect();
    module.add("DEFAULTS", by_name.into_py_dict(module.py())?)?;
    let rows = QUANTITIES
        .iter()
        .map(|row| (row.name, row.also.to_vec(), row.unit, row.range, row.default, row.about));
    module.add("QUANTITIES", rows.collect::<Vec<_>>())?;
    module.add("POINT_DISTANCE", refine::STEP)?;
    module.add("PIXEL_SIDE", PIXEL_SIDE_WORDS)?;
    module.add("SMALLEST_RADIUS", SMALLEST_RADIUS_WORDS)
}
