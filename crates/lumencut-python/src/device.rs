//! The GPUs of this machine.

use lumencut::devices::devices as found_devices;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The GPUs of this machine as dictionaries, preferred ones first.
#[pyfunction]
pub(crate) fn devices(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let found = py.detach(|| pollster::block_on(found_devices()));
    let described = found.into_iter().map(|device| {
        let fields = PyDict::new(py);
        fields.set_item("name", device.name)?;
        fields.set_item("backend", device.backend)?;
        fields.set_item("driver", device.driver)?;
        fields.set_item("is_software", device.is_software)?;
        fields.set_item("volume_side", device.volume_side)?;
        fields.set_item("buffer_bytes", device.buffer_bytes)?;
        Ok(fields)
    });
    described.collect()
}
