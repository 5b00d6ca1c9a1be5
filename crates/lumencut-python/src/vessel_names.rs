//! The vessel that a name means, with codes for reports.

use lumencut::vessel_names::{NamedVessel, Side, VESSEL_NAMES, vessel_named};
use pyo3::prelude::*;

type Code = (&'static str, &'static str);

/// SNOMED CT code and meaning of a named vessel and of its side; None for a name that has no code.
#[pyfunction]
pub(crate) fn vessel_code(name: &str) -> Option<(Code, Option<Code>)> {
    vessel_named(name).map(|(vessel, side)| ((vessel.snomed, vessel.meaning), side.map(Side::code)))
}

/// Adds the names that hosts offer to the module.
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let names: Vec<String> = VESSEL_NAMES.iter().flat_map(NamedVessel::offered).collect();
    module.add("VESSEL_NAMES", names)
}
