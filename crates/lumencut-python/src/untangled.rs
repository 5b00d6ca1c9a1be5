//! Untangled CPRs for Python.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use lumencut::network;
use lumencut::reformations::untangled::{self, UntangledParameters};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;

use crate::along_vessels::ValuesAlong;
use crate::layout::Layout;
use crate::tree::{VesselArrays, tree};
use crate::views::CameraArgument;
use crate::watching::computed;

/// Part of a vessel in the image: id, arc lengths (n,) (mm), columns and rows (n, 2), rotation (radians), and whether the part
/// begins at its last position.
type LaidOutRow<'py> = (usize, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>, f64, bool);

/// A tree laid out in the plane without overlap.
#[pyclass(frozen, extends = Layout, module = "lumencut._lumencut")]
pub struct Untangled(untangled::Untangled);

#[pymethods]
impl Untangled {
    /// Lays out vessels (points, radius) in the view direction of a camera. Lengths (mm): half width, hull margin, smoothing, pixel
    /// side, and the radius used where it is unknown.
    #[new]
    #[pyo3(signature = (vessels, camera, lengths, root))]
    #[allow(clippy::needless_pass_by_value)]
    fn new(
        py: Python<'_>,
        vessels: Vec<VesselArrays<'_>>,
        camera: CameraArgument,
        lengths: [f64; 5],
        root: Option<[f64; 3]>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let [width, hull_margin, smoothing, pixel_spacing, unknown_radius] = lengths;
        let root = root.map(DVec3::from_array);
        let parameters =
            UntangledParameters { width, hull_margin, smoothing, pixel_spacing, unknown_radius, root };
        let (tree, camera) = (tree(&vessels)?, camera.camera()?);
        let made = computed(py, |stop| untangled::Untangled::new(&tree, &camera, parameters, stop))?;
        Ok(PyClassInitializer::from(Layout(Arc::new(made.clone()))).add_subclass(Self(made)))
    }

    /// The rotation of each vessel (radians, counter-clockwise in the image).
    #[getter]
    fn rotations(&self) -> Vec<f64> {
        self.0.rotations()
    }

    #[getter]
    fn ends(&self) -> Vec<[f64; 2]> {
        self.0.ends().iter().map(DVec2::to_array).collect()
    }

    #[getter]
    fn overlaps(&self) -> Vec<usize> {
        self.0.overlaps().to_vec()
    }

    /// For each place at which a cycle of the tree was cut: the two image positions (column, row) at which it appears.
    #[getter]
    fn closures(&self) -> Vec<[[f64; 2]; 2]> {
        self.0.closures().iter().map(|places| places.map(|place| place.to_array())).collect()
    }

    /// The map of the tree as coloured lines, RGBA, shape (H, W, 4).
    fn network<'py>(
        &self,
        py: Python<'py>,
        along: &Bound<'py, ValuesAlong>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        use lumencut::reformations::Layout as _;

        let ([width, height], along) = (self.0.size(), along.get());
        let pixels = computed(py, |stop| network::drawn(&self.0, &along.0, stop))?.into_flattened();
        PyArray1::from_vec(py, pixels).reshape([height, width, 4])
    }

    /// The vessel of each pixel, shape (H, W), -1 if none.
    fn vessel<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        use lumencut::reformations::Layout as _;

        let [width, height] = self.0.size();
        let vessel = computed(py, |stop| self.0.vessel(stop))?;
        PyArray1::from_vec(py, vessel).reshape([height, width])
    }

    fn laid_out<'py>(&self, py: Python<'py>) -> PyResult<Vec<LaidOutRow<'py>>> {
        let parts = self.0.laid_out().iter();
        let row = |part: &untangled::LaidOut| {
            let pixels: Vec<f64> = part.pixels.iter().flat_map(DVec2::to_array).collect();
            let pixels = PyArray1::from_vec(py, pixels).reshape([part.pixels.len(), 2])?;
            let along = PyArray1::from_slice(py, &part.arc_length);
            Ok((part.vessel, along, pixels, part.turn, part.is_reversed))
        };
        parts.map(row).collect()
    }
}
