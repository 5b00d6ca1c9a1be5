//! The extension module `lumencut._lumencut`: thin wrappers over `lumencut-core`, `lumencut-gpu` and
//! `lumencut-io`.

use pyo3::prelude::*;

mod backend;
mod camera;
mod centerlines;
mod device;
mod errors;
mod phantom;
mod pool;
mod ranges;
mod renderer;
mod settings;
mod tree;
mod values;
mod volume;
mod write_centerlines;

#[pymodule]
fn _lumencut(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    settings::add_table(module)?;
    module.add_class::<centerlines::CenterlineFile>()?;
    module.add_class::<renderer::Renderer>()?;
    module.add_class::<settings::Checked>()?;
    module.add_function(wrap_pyfunction!(device::devices, module)?)?;
    module.add_function(wrap_pyfunction!(camera::check_camera, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_window, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_opacity, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_slab, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_transfer_function, module)?)?;
    module.add_function(wrap_pyfunction!(tree::check_vessel, module)?)?;
    module.add_function(wrap_pyfunction!(tree::levels, module)?)?;
    module.add_function(wrap_pyfunction!(volume::sample, module)?)?;
    module.add_function(wrap_pyfunction!(phantom::make_phantom, module)?)?;
    module.add_function(wrap_pyfunction!(write_centerlines::write_centerlines, module)?)?;
    Ok(())
}
