//! Uses the voxels of NumPy arrays without copying them.

use glam::{DAffine3, DMat3, DVec3};
use lumencut::extent::Extent;
use lumencut::named::Named;
use lumencut::polarity::Polarity;
use lumencut::scan_details::ScanDetails;
use lumencut::stop::go_on;
use lumencut::volume::{Volume, Voxels};
use lumencut::windows;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::errors::{exception, to_python};
use crate::tree::points_of;
use crate::watching::computed;

/// `lumencut.Volume`: voxels in memory order, size and strides (elements) along (i, j, k), and the index-to-world affine by rows.
#[derive(FromPyObject)]
pub(crate) struct VolumeArgument<'py> {
    #[pyo3(attribute("_voxels"))]
    voxels: Bound<'py, PyAny>,
    size: [usize; 3],
    #[pyo3(attribute("_strides"))]
    strides: [usize; 3],
    #[pyo3(attribute("_affine_rows"))]
    affine_rows: [[f64; 4]; 3],
    #[pyo3(attribute("_polarity"))]
    polarity: String,
    scan: ScanArgument,
}

pub(crate) enum Borrowed<'py> {
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
    pub(crate) fn scan(&self) -> ScanDetails {
        self.scan.details()
    }

    pub(crate) fn borrow(&self) -> PyResult<Borrowed<'py>> {
        borrow(&self.voxels)
    }

    pub(crate) fn volume<'a>(&self, borrowed: &'a Borrowed<'py>) -> PyResult<Volume<'a>> {
        let affine = affine(self.affine_rows);
        let volume = Volume::new(borrowed.voxels()?, self.size, self.strides, affine);
        let polarity = Polarity::named("polarity", &self.polarity);
        volume.and_then(|volume| Ok(volume.with_polarity(polarity?))).map_err(to_python)
    }
}

fn affine(rows: [[f64; 4]; 3]) -> DAffine3 {
    let [x, y, z] = rows.map(|row| DVec3::new(row[0], row[1], row[2]));
    let translation = DVec3::from_array(rows.map(|row| row[3]));
    DAffine3::from_mat3_translation(DMat3::from_cols(x, y, z).transpose(), translation)
}

#[derive(FromPyObject)]
pub(crate) struct GridArgument {
    size: [usize; 3],
    #[pyo3(attribute("_affine_rows"))]
    affine_rows: [[f64; 4]; 3],
}

impl GridArgument {
    pub(crate) fn extent(&self) -> Extent {
        Extent::new(self.size, affine(self.affine_rows))
    }
}

/// Why a grid's lengths, from size (ni, nj, nk) and affine rows, are implausible; None if they are plausible.
#[pyfunction]
pub(crate) fn doubted_grid(size: [usize; 3], affine_rows: [[f64; 4]; 3]) -> Option<String> {
    lumencut::doubted_scan::doubted_grid(size, affine(affine_rows))
}

/// A note for the user if dark values of the volume were cut off.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn cut_off_note(py: Python<'_>, volume: VolumeArgument<'_>) -> PyResult<Option<String>> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    Ok(py.detach(|| lumencut::cut_off_values::cut_off_note(&volume)))
}

/// Number of points that are sampled before the next check whether to stop.
const PART: usize = 1 << 14;

/// Whether world points (n, 3) (mm, LPS) lie within a volume's outer corners; shape (n,).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn contains<'py>(
    py: Python<'py>,
    volume: GridArgument,
    points: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let (extent, points) = (volume.extent(), points_of(&points)?);
    Ok(PyArray1::from_iter(py, points.into_iter().map(|point| extent.contains(point))))
}

/// The values of the volume at world points (n, 3) (mm, LPS), interpolated trilinearly; NaN outside; shape (n,).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn sample<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    points: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f32>>> {
    let borrowed = volume.borrow()?;
    let (volume, points) = (volume.volume(&borrowed)?, points_of(&points)?);
    let values = computed(py, |stop| {
        let mut values = vec![0.0; points.len()];
        let parts = values.par_chunks_mut(PART).zip(points.par_chunks(PART));
        parts.try_for_each(|(values, points)| {
            go_on(stop)?;
            values.copy_from_slice(&windows::sample(&volume, points));
            Ok(())
        })?;
        Ok(values)
    })?;
    Ok(PyArray1::from_vec(py, values))
}

/// How a scan was made, as Python describes it.
#[derive(FromPyObject)]
pub(crate) struct ScanArgument {
    series_number: Option<String>,
    series_description: Option<String>,
    phase: Option<String>,
    slice_thickness: Option<f64>,
    kernel: Option<String>,
}

impl ScanArgument {
    pub(crate) fn details(&self) -> ScanDetails {
        ScanDetails {
            series_number: self.series_number.clone(),
            series_description: self.series_description.clone(),
            phase: self.phase.clone(),
            slice_thickness_mm: self.slice_thickness,
            kernel: self.kernel.clone(),
        }
    }
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn scan_words(scan: ScanArgument) -> String {
    scan.details().words()
}
