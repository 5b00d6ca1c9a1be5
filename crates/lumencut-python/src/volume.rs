//! Volumes, borrowed from NumPy without a copy.

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::math::sampling::Grid;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_core::with_voxels;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::errors::{exception, to_python};

/// `lumencut.Volume` as the binding needs it: voxels in memory order, grid size and strides along (i, j, k)
/// in elements, and the affine from index to world, row by row.
#[derive(FromPyObject)]
pub struct VolumeArgument<'py> {
    #[pyo3(attribute("_voxels"))]
    voxels: Bound<'py, PyAny>,
    size: [usize; 3],
    #[pyo3(attribute("_strides"))]
    strides: [usize; 3],
    #[pyo3(attribute("_affine_rows"))]
    affine_rows: [[f64; 4]; 3],
}

/// The voxels of a volume, locked against writing from Rust while they are in use.
pub enum Borrowed<'py> {
    I8(PyReadonlyArray1<'py, i8>),
    U8(PyReadonlyArray1<'py, u8>),
    I16(PyReadonlyArray1<'py, i16>),
    U16(PyReadonlyArray1<'py, u16>),
    I32(PyReadonlyArray1<'py, i32>),
    U32(PyReadonlyArray1<'py, u32>),
    I64(PyReadonlyArray1<'py, i64>),
    U64(PyReadonlyArray1<'py, u64>),
    F32(PyReadonlyArray1<'py, f32>),
    F64(PyReadonlyArray1<'py, f64>),
}

macro_rules! each_type {
    ($($name:ident $type:ty),*) => {
        /// The voxels of an array of any of the types.
        fn borrow<'py>(array: &Bound<'py, PyAny>) -> PyResult<Borrowed<'py>> {
            $(if let Ok(array) = array.cast::<PyArray1<$type>>() {
                return Ok(Borrowed::$name(array.try_readonly()?));
            })*
            let found = format!("voxels of {}", array.get_type());
            Err(exception("VolumeError", "array of the volume", &found, "a flat array of integers or floats", ""))
        }

        impl Borrowed<'_> {
            fn voxels(&self) -> PyResult<Voxels<'_>> {
                Ok(match self {
                    $(Borrowed::$name(array) => Voxels::$name(array.as_slice()?),)*
                })
            }
        }
    };
}
each_type!(I8 i8, U8 u8, I16 i16, U16 u16, I32 i32, U32 u32, I64 i64, U64 u64, F32 f32, F64 f64);

impl<'py> VolumeArgument<'py> {
    /// Borrows the voxels.
    pub fn borrow(&self) -> PyResult<Borrowed<'py>> {
        borrow(&self.voxels)
    }

    /// The volume of the core over borrowed voxels.
    pub fn volume<'a>(&self, borrowed: &'a Borrowed<'py>) -> PyResult<Volume<'a>> {
        let [x, y, z] = self.affine_rows.map(|row| DVec3::new(row[0], row[1], row[2]));
        let translation = DVec3::from_array(self.affine_rows.map(|row| row[3]));
        let matrix = DMat3::from_cols(x, y, z).transpose();
        let affine = DAffine3::from_mat3_translation(matrix, translation);
        Volume::new(borrowed.voxels()?, self.size, self.strides, affine).map_err(to_python)
    }
}

/// The volume at world points (n, 3) (mm, LPS), trilinear, NaN outside; shape (n,).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn sample<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    points: Vec<[f64; 3]>,
) -> PyResult<Bound<'py, PyArray1<f32>>> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let (grid, to_index) = (Grid::new(&volume), volume.index_from_world());
    let values: Vec<f32> = py.detach(|| {
        with_voxels!(volume.voxels(), voxels => points
            .iter()
            .map(|p| grid.trilinear(voxels, to_index.transform_point3(DVec3::from_array(*p))))
            .collect())
    });
    Ok(PyArray1::from_vec(py, values))
}
