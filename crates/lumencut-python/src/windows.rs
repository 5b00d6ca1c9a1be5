//! Windows from the data, for `lumencut.Window`.

use lumencut::error::Result;
use lumencut::settings::Window;
use lumencut::volume::Volume;
use lumencut::windows;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::tree::{VesselArrays, tree};
use crate::volume::VolumeArgument;

/// Level and width of a window that tells lumen from its surroundings; without vessels from the volume alone.
#[pyfunction]
#[pyo3(signature = (volume, vessels))]
#[allow(clippy::needless_pass_by_value)]
pub fn window_from_data(
    py: Python<'_>,
    volume: VolumeArgument<'_>,
    vessels: Option<Vec<VesselArrays<'_>>>,
) -> PyResult<(f64, f64)> {
    let tree = vessels.map(|vessels| tree(&vessels)).transpose()?;
    found(py, &volume, |volume| match &tree {
        Some(tree) => windows::along(volume, tree),
        None => windows::of_volume(volume),
    })
}

/// Level and width of a window for a MIP of the volume alone.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn mip_window(py: Python<'_>, volume: VolumeArgument<'_>) -> PyResult<(f64, f64)> {
    found(py, &volume, windows::of_mip)
}

/// Level and width of a window that shows air to lumen.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn whole_window(py: Python<'_>, volume: VolumeArgument<'_>) -> PyResult<(f64, f64)> {
    found(py, &volume, windows::whole)
}

/// Level and width of a window from the smallest voxel to the largest.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn full_window(py: Python<'_>, volume: VolumeArgument<'_>) -> PyResult<(f64, f64)> {
    found(py, &volume, windows::full)
}

/// Level and width of a window that shows all tissues of an MR angiography.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn mra_window(py: Python<'_>, volume: VolumeArgument<'_>) -> PyResult<(f64, f64)> {
    found(py, &volume, windows::mra)
}

fn found(
    py: Python<'_>,
    volume: &VolumeArgument<'_>,
    window: impl Fn(&Volume) -> Result<Window> + Sync,
) -> PyResult<(f64, f64)> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let window = py.detach(|| window(&volume)).map_err(to_python)?;
    Ok((window.level, window.width))
}
