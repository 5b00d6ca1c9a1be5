//! Volume files for `lumencut.files.grids`, which reads and writes the bytes of files.

use std::path::{Path, PathBuf};

use lumencut_volumes::{
    Affine, Error, ErrorKind, Fill, Found, Kind, Known, Need, Packer, Plan, Step, Stop, Window, Written,
    grid_fault, open, stated_units,
};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{exception, overlap};

/// Most bytes of voxels that one call writes or checks, so that Ctrl-C is noticed in time.
const PIECE: usize = 16 << 20;

/// The error as an exception; its file is in the folder of `path`.
fn raised(error: &Error, path: &Path) -> PyErr {
    let is_own = path.file_name().is_some_and(|name| name == error.subject.as_str());
    let subject: PathBuf = if is_own { path.into() } else { path.with_file_name(&error.subject) };
    let subject = subject.to_string_lossy();
    let class = match error.kind {
        ErrorKind::Format => "FormatError",
        ErrorKind::File => "FileError",
        ErrorKind::Overlap => {
            return overlap([&subject, &error.found, &error.expected, &error.mend]);
        }
    };
    exception(class, &subject, &error.found, &error.expected, &error.mend)
}

/// A file whose header is being read; `next` states what is needed.
#[pyclass(module = "lumencut._lumencut")]
pub(crate) struct VolumeOpening {
    path: PathBuf,
    name: String,
    chosen: Option<Vec<u32>>,
    known: Known,
}

#[pymethods]
impl VolumeOpening {
    #[new]
    #[pyo3(signature = (path, name, chosen, /))]
    fn new(path: PathBuf, name: String, chosen: Option<Vec<u32>>) -> Self {
        Self { path, name, chosen, known: Known::new() }
    }

    /// Adds the size of a file (None if it is missing), and whether it lies outside the folder.
    #[pyo3(signature = (name, size, is_outside, /))]
    fn add_size(&mut self, name: &str, size: Option<u64>, is_outside: bool) {
        let there = if is_outside { Found::Outside } else { Found::Size };
        self.known.add_size(name, size.map_or(Found::Missing, there));
    }

    /// Adds requested bytes of a file, which begin at `start`.
    #[pyo3(signature = (name, start, content, /))]
    fn add_bytes(&mut self, name: &str, start: u64, content: &[u8]) {
        self.known.add_bytes(name, start, content);
    }

    /// The plan; or the names of files whose sizes are needed; or name, start and end of needed bytes; None for an
    /// unknown format.
    fn next<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match open(&self.name, &self.known, self.chosen.as_deref()) {
            Ok(plan) => Ok(Bound::new(py, VolumePlan { path: self.path.clone(), plan })?.into_any()),
            Err(Stop::Need(Need::Sizes(names))) => Ok(names.into_pyobject(py)?.into_any()),
            Err(Stop::Need(Need::Bytes { name, start, end })) => {
                Ok((name, start, end).into_pyobject(py)?.into_any())
            }
            Err(Stop::Unknown) => Ok(py.None().into_bound(py)),
            Err(Stop::Refused(error)) => Err(raised(&error, &self.path)),
        }
    }
}

/// A volume whose header was read.
#[pyclass(module = "lumencut._lumencut", frozen)]
pub(crate) struct VolumePlan {
    path: PathBuf,
    plan: Plan,
}

#[pymethods]
impl VolumePlan {
    #[getter]
    fn format(&self) -> &'static str {
        self.plan.format.name()
    }

    #[getter]
    fn size(&self) -> [u64; 3] {
        self.plan.grid.size
    }

    /// The upper three rows of the affine matrix.
    #[getter]
    fn world_from_index(&self) -> Affine {
        self.plan.grid.world_from_index
    }

    #[getter]
    fn states_spacing(&self) -> bool {
        self.plan.grid.states_spacing
    }

    #[getter]
    fn states_orientation(&self) -> bool {
        self.plan.grid.states_orientation
    }

    #[getter]
    fn space(&self) -> &str {
        &self.plan.grid.space
    }

    /// NumPy's name of the stored type, and whether numbers are big-endian.
    #[getter]
    fn stored(&self) -> (&'static str, bool) {
        (self.plan.stored.kind.name(), self.plan.stored.is_big)
    }

    /// NumPy's name of the voxels' type once they are read; None if the voxels decide it.
    #[getter]
    fn settled(&self) -> Option<&'static str> {
        self.plan.settled(false).map(Kind::name)
    }

    /// The name of the file that holds the voxels.
    #[getter]
    fn voxels(&self) -> &str {
        &self.plan.place.name
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.plan.notes.clone()
    }

    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.plan.remarks.clone()
    }

    #[getter]
    fn description(&self) -> &str {
        &self.plan.description
    }

    #[getter]
    fn label_names(&self) -> Vec<(i64, String)> {
        self.plan.label_names.clone()
    }

    /// Layers and segments in words; None if the file is not a segmentation.
    #[getter]
    fn segmentation(&self) -> Option<[String; 2]> {
        self.plan.segmentation.as_ref().map(lumencut_volumes::Segmentation::details)
    }

    /// The exception for a missing file of voxels.
    fn missing(&self, py: Python<'_>) -> Py<PyAny> {
        raised(&self.plan.missing(), &self.path).into_value(py).into_any()
    }

    /// Begins to read voxels from a file of this size (bytes).
    #[pyo3(signature = (size, /))]
    fn fill(&self, size: u64) -> VolumeFill {
        let fill = Fill::new(self.plan.clone(), size, false);
        VolumeFill { path: self.path.clone(), fill }
    }
}

/// Converts bytes of a file to voxels.
#[pyclass(module = "lumencut._lumencut")]
pub(crate) struct VolumeFill {
    path: PathBuf,
    fill: Fill,
}

#[pymethods]
impl VolumeFill {
    /// Reads bytes of the file, which begin at `start`, and writes voxels to `output`. Returns the number of bytes
    /// written and the next step: ("read", start, end), ("sound", proven, least bytes), ("room", type, bytes),
    /// ("done",) or ("filled",).
    #[pyo3(signature = (start, content, output, /))]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        start: u64,
        content: &[u8],
        output: &Bound<'py, PyArray1<u8>>,
    ) -> PyResult<(usize, Bound<'py, PyAny>)> {
        let mut output = output.try_readwrite().map_err(|error| PyValueError::new_err(error.to_string()))?;
        let output = output.as_slice_mut()?;
        let fill = &mut self.fill;
        let (written, step) = py
            .detach(|| steps(fill, Window { start, bytes: content }, output))
            .map_err(|error| raised(&error, &self.path))?;
        let told = match step {
            Step::Read { start, end } => ("read", start, end).into_pyobject(py)?.into_any(),
            Step::Sound { is_proven, least } => ("sound", is_proven, least).into_pyobject(py)?.into_any(),
            Step::Room { kind, bytes } => ("room", kind.name(), bytes).into_pyobject(py)?.into_any(),
            Step::Checked(_) | Step::Filled(_) => ("filled",).into_pyobject(py)?.into_any(),
            Step::Done => ("done",).into_pyobject(py)?.into_any(),
        };
        Ok((written, told))
    }
}

/// Continues until another part of the file is needed, or [`PIECE`] bytes are written or checked.
fn steps(fill: &mut Fill, window: Window<'_>, output: &mut [u8]) -> Result<(usize, Step), Box<Error>> {
    let (mut written, mut checked) = (0, 0);
    loop {
        match fill.step(window, &mut output[written..])? {
            Step::Checked(count) if checked < PIECE => checked += count,
            Step::Filled(count) if count > 0 && written < PIECE => written += count,
            Step::Filled(count) => return Ok((written + count, Step::Filled(0))),
            step => return Ok((written, step)),
        }
    }
}

/// From the bytes of a NIfTI header: millimetres per unit, and whether lengths in mm and the sides of the patient are
/// known.
#[pyfunction]
#[pyo3(signature = (header, /))]
pub(crate) fn nifti_units(header: &[u8]) -> Option<(f64, bool, bool)> {
    stated_units(header).map(|stated| (stated.millimetres, stated.spacing, stated.orientation))
}

/// What is wrong with a grid of size (ni, nj, nk) and these affine rows, and what is expected; None for a sound grid.
#[pyfunction]
#[pyo3(name = "grid_fault", signature = (size, affine_rows, /))]
pub(crate) fn fault_of_grid(size: [u64; 3], affine_rows: Affine) -> Option<(String, &'static str)> {
    grid_fault(size, &affine_rows)
}

/// The header of a volume in the format `"nifti"`, `"nrrd"` or `"nrrd.gz"`, up to its first voxel.
#[pyfunction]
#[pyo3(signature = (file_format, size, world_from_index, kind, mark, /))]
pub(crate) fn volume_header<'py>(
    py: Python<'py>,
    file_format: &str,
    size: [u64; 3],
    world_from_index: Affine,
    kind: &str,
    mark: &str,
) -> PyResult<Bound<'py, PyBytes>> {
    let kind = Kind::of_name(kind).ok_or_else(|| PyValueError::new_err("a type of numbers"))?;
    let written = Written { size, world_from_index, kind, mark };
    let header = match file_format {
        "nifti" => written.nifti(),
        _ => written.nrrd(file_format.ends_with(".gz")).into_bytes(),
    };
    Ok(PyBytes::new(py, &header))
}

/// Compresses bytes into a gzip stream.
#[pyclass(module = "lumencut._lumencut")]
#[derive(Default)]
pub(crate) struct GzipPacker(Packer);

#[pymethods]
impl GzipPacker {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// Compresses bytes; returns the part of the stream that is ready.
    #[pyo3(signature = (content, /))]
    fn pack<'py>(&mut self, py: Python<'py>, content: &[u8]) -> Bound<'py, PyBytes> {
        let packer = &mut self.0;
        PyBytes::new(py, &py.detach(|| packer.pack(content)))
    }

    /// Returns the last bytes of the stream.
    fn end<'py>(&mut self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &std::mem::take(&mut self.0).end())
    }
}
