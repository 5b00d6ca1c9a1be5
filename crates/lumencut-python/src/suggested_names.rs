//! Suggests names for the vessels of a tree.

use glam::DVec3;
use lumencut::suggested_names;
use pyo3::prelude::*;

use crate::tree::{VesselArrays, points_of};
use crate::volume::VolumeArgument;

/// The suggested name of a vessel, its named stretches with their ends (arc length, mm), and whether it seems to be a vein or the heart.
type Suggested = (Option<String>, Vec<(String, [f64; 2])>, bool);

/// Suggests names for vessels with points (n, 3) and radii (n,).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
#[pyo3(signature = (vessels, volume=None))]
pub(crate) fn suggest_names(
    py: Python<'_>,
    vessels: Vec<VesselArrays<'_>>,
    volume: Option<VolumeArgument<'_>>,
) -> PyResult<Vec<Suggested>> {
    let lines = vessels.iter().map(|(points, radius)| {
        Ok((points_of(points)?, radius.as_ref().map(|radius| radius.as_array().to_vec())))
    });
    let lines = lines.collect::<PyResult<Vec<(Vec<DVec3>, Option<Vec<f64>>)>>>()?;
    let lines: Vec<_> = lines.iter().map(|(points, radius)| (&points[..], radius.as_deref())).collect();
    let borrowed = volume.as_ref().map(VolumeArgument::borrow).transpose()?;
    let volume = volume.as_ref().zip(borrowed.as_ref());
    let volume = volume.map(|(volume, borrowed)| volume.volume(borrowed)).transpose()?;
    let suggested = py.detach(|| suggested_names::suggested_names(&lines, volume.as_ref()));
    let plain = suggested.into_iter().map(|line| {
        let stretches = line.stretches.into_iter().map(|stretch| (stretch.name, stretch.range));
        (line.name, stretches.collect(), line.is_vein_or_heart)
    });
    Ok(plain.collect())
}

/// A suggested name for a vessel with this name, which may be empty; None if a reader named it.
#[pyfunction]
pub(crate) fn suggested_for(name: &str, suggested: String) -> Option<String> {
    suggested_names::is_nameless(name).then_some(suggested)
}
