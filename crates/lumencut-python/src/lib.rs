//! The extension module `lumencut._lumencut`: thin wrappers over `lumencut`.

use pyo3::prelude::*;

mod camera;
mod centerlines;
mod cpr;
mod device;
mod dicom;
mod errors;
mod mask_tracing;
mod measuring;
mod phantom;
mod placement;
mod pool;
mod ranges;
mod renderer;
mod seed_tracing;
mod settings;
mod tracing;
mod tree;
mod values;
mod views;
mod volume;
mod windows;
mod write_centerlines;

#[pymodule]
fn _lumencut(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    settings::add_table(module)?;
    placement::add_names(module)?;
    dicom::add_names(module)?;
    views::add_names(module)?;
    measuring::add_names(module)?;
    module.add_class::<centerlines::CenterlineFile>()?;
    module.add_class::<cpr::Cpr>()?;
    module.add_class::<measuring::Profile>()?;
    module.add_class::<measuring::Stenosis>()?;
    module.add_class::<renderer::Renderer>()?;
    module.add_class::<settings::Checked>()?;
    module.add_class::<tracing::Tracer>()?;
    module.add_function(wrap_pyfunction!(cpr::picture, module)?)?;
    module.add_function(wrap_pyfunction!(device::devices, module)?)?;
    module.add_function(wrap_pyfunction!(dicom::describe_dicom, module)?)?;
    module.add_function(wrap_pyfunction!(dicom::judge_dicom, module)?)?;
    module.add_function(wrap_pyfunction!(camera::check_camera, module)?)?;
    module.add_function(wrap_pyfunction!(measuring::cross_section, module)?)?;
    module.add_function(wrap_pyfunction!(measuring::measure, module)?)?;
    module.add_function(wrap_pyfunction!(measuring::measured_radii, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_cr, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_window, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_opacity, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_slab, module)?)?;
    module.add_function(wrap_pyfunction!(ranges::check_transfer_function, module)?)?;
    module.add_function(wrap_pyfunction!(tree::check_vessel, module)?)?;
    module.add_function(wrap_pyfunction!(tree::levels, module)?)?;
    module.add_function(wrap_pyfunction!(tree::smoothed, module)?)?;
    module.add_function(wrap_pyfunction!(views::fitted, module)?)?;
    module.add_function(wrap_pyfunction!(views::fitted_turn, module)?)?;
    module.add_function(wrap_pyfunction!(views::frame_angles, module)?)?;
    module.add_function(wrap_pyfunction!(views::rotated, module)?)?;
    module.add_function(wrap_pyfunction!(views::zoomed, module)?)?;
    module.add_function(wrap_pyfunction!(views::panned, module)?)?;
    module.add_function(wrap_pyfunction!(views::positions, module)?)?;
    module.add_function(wrap_pyfunction!(windows::window_from_data, module)?)?;
    module.add_function(wrap_pyfunction!(windows::mip_window, module)?)?;
    module.add_function(wrap_pyfunction!(windows::whole_window, module)?)?;
    module.add_function(wrap_pyfunction!(windows::full_window, module)?)?;
    module.add_function(wrap_pyfunction!(windows::mra_window, module)?)?;
    module.add_function(wrap_pyfunction!(placement::placement, module)?)?;
    module.add_function(wrap_pyfunction!(placement::better_place, module)?)?;
    module.add_function(wrap_pyfunction!(placement::fits_nowhere, module)?)?;
    module.add_function(wrap_pyfunction!(volume::contains, module)?)?;
    module.add_function(wrap_pyfunction!(volume::sample, module)?)?;
    module.add_function(wrap_pyfunction!(mask_tracing::correspondence, module)?)?;
    module.add_function(wrap_pyfunction!(mask_tracing::trace_mask, module)?)?;
    module.add_function(wrap_pyfunction!(seed_tracing::trace_from, module)?)?;
    module.add_function(wrap_pyfunction!(phantom::make_phantom, module)?)?;
    module.add_function(wrap_pyfunction!(write_centerlines::write_centerlines, module)?)?;
    module.add_function(wrap_pyfunction!(pool::set_threads, module)?)?;
    module.add_function(wrap_pyfunction!(pool::threads, module)?)?;
    Ok(())
}
