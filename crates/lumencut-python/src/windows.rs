//! Named windows and windows computed from the data, for `lumencut.Window`.

use lumencut::named::Named;
use lumencut::settings::ContextName;
use lumencut::window_presets::{DataWindow, PresetSource, WINDOW_PRESETS};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::tree::{VesselArrays, tree};
use crate::volume::VolumeArgument;

/// Level and width of a named window that is computed from the data; only "auto" uses vessels.
#[pyfunction]
#[pyo3(signature = (name, volume, vessels))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn find_window(
    py: Python<'_>,
    name: &str,
    volume: VolumeArgument<'_>,
    vessels: Option<Vec<VesselArrays<'_>>>,
) -> PyResult<(f64, f64)> {
    let kind = DataWindow::named("window from the data", name).map_err(to_python)?;
    let tree = vessels.map(|vessels| tree(&vessels)).transpose()?;
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let window = py.detach(|| kind.find(&volume, tree.as_ref())).map_err(to_python)?;
    Ok((window.level, window.width))
}

#[pyfunction]
pub(crate) fn context_window(context: &str, has_tree: bool) -> PyResult<&'static str> {
    let context = ContextName::named("context", context).map_err(to_python)?;
    Ok(DataWindow::of_context(context, has_tree).name())
}

/// Adds the named windows to the module: label, and level and width if they are constant.
pub(crate) fn add_presets(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let presets = WINDOW_PRESETS.map(|preset| match preset.source {
        PresetSource::Fixed(window) => (preset.name, preset.words, Some((window.level, window.width))),
        PresetSource::Data(_) => (preset.name, preset.words, None),
    });
    module.add("WINDOW_PRESETS", presets.to_vec())
}
