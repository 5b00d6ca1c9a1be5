//! The extension module `lumencut._lumencut`: thin wrappers over `lumencut-core` and `lumencut-io`.

use pyo3::prelude::*;

mod centerlines;
mod errors;

#[pymodule]
fn _lumencut(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(centerlines::read_centerlines, module)?)?;
    Ok(())
}
