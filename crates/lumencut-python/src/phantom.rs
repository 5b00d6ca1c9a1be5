//! Phantoms for Python: voxels as NumPy arrays, the true answers as dictionaries.

use lumencut::error::{Error, ErrorKind, Result};
use lumencut::stop::Stop;
use lumencut_phantom::{AORTA, CERVICAL, Phantom, Plaque, PlaqueKind, RUNOFF, Stenosis};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::watching::computed;

/// The phantom `name`. Only the phantom "stenosis" uses `percent`, and only benchmark phantoms use `seed` and `scale`.
#[pyfunction]
#[pyo3(signature = (name, *, percent = 50.0, seed = 0, scale = 1.0))]
pub(crate) fn make_phantom<'py>(
    py: Python<'py>,
    name: &str,
    percent: f64,
    seed: u64,
    scale: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let made = computed(py, |stop| make(name, percent, (seed, scale), stop))?;
    to_dict(py, made)
}

fn make(name: &str, percent: f64, (seed, scale): (u64, f64), stop: Stop) -> Result<Phantom> {
    match name {
        "straight_tube" => lumencut_phantom::straight_tube(),
        "helix" => lumencut_phantom::helix(),
        "y_junction" => lumencut_phantom::y_junction(),
        "crossing" => lumencut_phantom::crossing(),
        "trefoil" => lumencut_phantom::trefoil(),
        "collinear_run" => lumencut_phantom::collinear_run(),
        "stenosis" => lumencut_phantom::stenosis(percent),
        "airways" => lumencut_phantom::airways(),
        "calcified_wall" => lumencut_phantom::calcified_wall(),
        "aorta" => AORTA.make(seed, scale, stop),
        "runoff" => RUNOFF.make(seed, scale, stop),
        "cervical" => CERVICAL.make(seed, scale, stop),
        _ => Err(Error::new(
            ErrorKind::Settings,
            "name of the phantom",
            name,
            "a function of lumencut.phantom",
        )),
    }
}

fn to_dict(py: Python<'_>, made: Phantom) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    let [ni, nj, nk] = made.size;
    dict.set_item("name", made.name)?;
    dict.set_item("array", PyArray1::from_vec(py, made.voxels).reshape([nk, nj, ni])?)?;
    let affine = glam::DMat4::from(made.world_from_index).transpose().to_cols_array_2d();
    dict.set_item("world_from_index", PyArray2::from_vec2(py, &affine.map(Vec::from))?)?;
    let vessels = PyList::empty(py);
    for (vessel, name) in made.tree.vessels().iter().zip(&made.vessel_names) {
        let points: Vec<f64> = vessel.points().iter().flat_map(|p| p.to_array()).collect();
        let points = PyArray1::from_vec(py, points).reshape([vessel.points().len(), 3])?;
        let radius = PyArray1::from_slice(py, vessel.radius().unwrap_or_default());
        vessels.append((points, radius, name))?;
    }
    dict.set_item("vessels", vessels)?;
    let reference: Vec<_> = made.reference_radius.into_iter().map(|r| PyArray1::from_vec(py, r)).collect();
    dict.set_item("reference_radius", reference)?;
    let stenoses: PyResult<Vec<_>> = made.stenoses.iter().map(|s| stenosis(py, s)).collect();
    dict.set_item("stenoses", stenoses?)?;
    let plaques: PyResult<Vec<_>> = made.plaques.iter().map(|p| plaque(py, p)).collect();
    dict.set_item("plaques", plaques?)?;
    Ok(dict)
}

fn stenosis<'py>(py: Python<'py>, stenosis: &Stenosis) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("vessel", stenosis.vessel)?;
    dict.set_item("arc_length", stenosis.arc_length)?;
    dict.set_item("length", stenosis.length)?;
    dict.set_item("percent", stenosis.percent)?;
    Ok(dict)
}

fn plaque<'py>(py: Python<'py>, plaque: &Plaque) -> PyResult<Bound<'py, PyDict>> {
    let kind = match plaque.kind {
        PlaqueKind::Soft => "soft",
        PlaqueKind::Calcified => "calcified",
    };
    let dict = PyDict::new(py);
    dict.set_item("vessel", plaque.vessel)?;
    dict.set_item("arc_length", plaque.arc_length)?;
    dict.set_item("kind", kind)?;
    dict.set_item("angle", plaque.angle)?;
    dict.set_item("length", plaque.length)?;
    dict.set_item("angular_extent", plaque.angular_extent)?;
    dict.set_item("thickness", plaque.thickness)?;
    dict.set_item("position", <(f64, f64, f64)>::from(plaque.position))?;
    Ok(dict)
}
