//! Lumen maps for Python.

use std::sync::Arc;

use glam::DVec3;
use lumencut::endoscopy;
use lumencut::error::Result;
use lumencut::lumen_map::{self as maps, MapRequest};
use lumencut::lumen_wall::{FoundWall, lumen_wall};
use lumencut::math::centerline_path::CenterlinePath;
use lumencut::measure::profile;
use lumencut::named::Named;
use lumencut::reformations::Layout as _;
use lumencut::reformations::cpr::{Roll, Side, Straightened, View};
use lumencut::reformations::lumen_map;
use lumencut::vessel_tree::Vessel;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::endoscopy::Inside;
use crate::errors::to_python;
use crate::layout::Layout;
use crate::measuring::Profile;
use crate::pool;
use crate::tree::{VesselArrays, vessel as vessel_of};
use crate::volume::VolumeArgument;
use crate::watching::computed;

/// An ostium: vessel id, arc length (mm), point (mm, LPS), column and row.
type OstiumRow = (usize, f64, [f64; 3], [f64; 2]);

/// The wall around a vessel; all maps of the vessel share it.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct LumenWall {
    path: Arc<CenterlinePath>,
    view: View,
    found: FoundWall,
    profile: Option<Arc<profile::Profile>>,
}

#[pymethods]
impl LumenWall {
    /// The wall of a vessel with points (n, 3) and radii (n,), seen with `up` upwards; taken from `profile`, if given.
    #[new]
    #[pyo3(signature = (volume, vessel, smoothing, up, profile=None))]
    #[allow(clippy::needless_pass_by_value)]
    fn new<'py>(
        py: Python<'py>,
        volume: VolumeArgument<'py>,
        vessel: VesselArrays<'py>,
        smoothing: f64,
        up: [f64; 3],
        profile: Option<Bound<'py, Profile>>,
    ) -> PyResult<Self> {
        let borrowed = volume.borrow()?;
        let (volume, vessel) = (volume.volume(&borrowed)?, vessel_of(&vessel)?);
        let view = View { up: DVec3::from_array(up), angle: 0.0, normal: None };
        let profile = profile.map(|profile| Arc::clone(&profile.get().0));
        let found = || -> Result<Self> {
            // A map uses only the course of the vessel, so its radii are dropped.
            let line = Vessel::new(vessel.points().to_vec(), None)?;
            let path = Arc::new(CenterlinePath::new(&line, smoothing)?);
            let straightened = Straightened::new(Arc::clone(&path), &view)?;
            let found = lumen_wall(&volume, &vessel, &straightened, profile.as_deref())?;
            Ok(Self { path, view, found, profile })
        };
        py.detach(|| pool::install(found))?.map_err(to_python)
    }

    /// The inside of the vessel, for all places of an eye.
    fn inside(&self, py: Python<'_>) -> PyResult<Inside> {
        let inside = || -> Result<_> {
            let straightened = Straightened::new(Arc::clone(&self.path), &self.view)?;
            endoscopy::Inside::new(
                (Arc::clone(&self.path), straightened),
                &self.found,
                self.profile.as_deref(),
            )
        };
        py.detach(|| pool::install(inside))?.map(Inside).map_err(to_python)
    }

    /// The lowest value that counts as calcium or metal; None if the vessel was not measured.
    #[getter]
    fn calcium_level(&self) -> Option<f64> {
        self.found.levels.map(maps::calcium_level)
    }

    /// The radius (mm) at which the width of columns is true to scale.
    #[getter]
    fn mean_radius(&self) -> f64 {
        self.found.mean_radius
    }

    /// Arc lengths (mm), and at each of them the direction (radians) of the narrowest or widest side.
    fn roll<'py>(&self, py: Python<'py>, side: &str) -> PyResult<[Bound<'py, PyArray1<f64>>; 2]> {
        let side = Side::named("roll of the CPR", side).map_err(to_python)?;
        let length = self.path.length();
        let roll = py.detach(|| Roll::following(&self.found.wall, length, side));
        Ok([roll.places(), roll.angles()].map(|values| PyArray1::from_slice(py, values)))
    }

    /// A map of the wall, for a pixel side (mm), direction of the middle column (radians; None centres calcium), overlap (radians),
    /// band beyond the wall (mm), and calcium level.
    #[allow(clippy::needless_pass_by_value)]
    fn map<'py>(
        &self,
        py: Python<'py>,
        volume: VolumeArgument<'py>,
        pixel_spacing: f64,
        directions: (Option<f64>, f64),
        band: [f64; 2],
        calcium_level: Option<f64>,
    ) -> PyResult<Bound<'py, LumenMap>> {
        let borrowed = volume.borrow()?;
        let volume = volume.volume(&borrowed)?;
        let (angle, overlap) = directions;
        let request = MapRequest { pixel_spacing, angle, overlap, band, calcium_level };
        let map = computed(py, |stop| {
            maps::lumen_map(&volume, &self.path, &self.view, &self.found, (&request, stop))
        })?;
        let layout = Layout(Arc::new(map.clone()));
        Bound::new(py, PyClassInitializer::from(layout).add_subclass(LumenMap(map)))
    }
}

/// The unrolled wall of a vessel.
#[pyclass(frozen, extends = Layout, module = "lumencut._lumencut")]
pub struct LumenMap(lumen_map::LumenMap);

#[pymethods]
impl LumenMap {
    /// Direction of the middle column (radians).
    #[getter]
    fn angle(&self) -> f64 {
        self.0.parameters().angle
    }

    #[getter]
    fn overlap(&self) -> usize {
        self.0.overlap()
    }

    /// Wall radius (mm), shape (H, W).
    fn wall<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.shaped(py, computed(py, |stop| self.0.wall(stop))?)
    }

    fn open<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        self.shaped(py, computed(py, |stop| self.0.open(stop))?)
    }

    /// Shading of the wall by a light at the middle of the lumen (0 to 1), shape (H, W).
    fn shades<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        self.shaped(py, computed(py, |stop| self.0.shades(stop))?)
    }

    /// Thickness (mm) of what exceeds a level within a band beyond the wall, shape (H, W).
    #[allow(clippy::needless_pass_by_value)]
    fn thickness<'py>(
        &self,
        py: Python<'py>,
        volume: VolumeArgument<'py>,
        band: [f64; 2],
        level: f64,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let borrowed = volume.borrow()?;
        let volume = volume.volume(&borrowed)?;
        let thick = computed(py, |stop| maps::thickness(&volume, &self.0, (band, level), stop))?;
        self.shaped(py, thick)
    }

    #[allow(clippy::needless_pass_by_value)]
    fn ostia(&self, tree: Vec<VesselArrays<'_>>) -> PyResult<Vec<OstiumRow>> {
        let vessels = tree.iter().map(vessel_of).collect::<PyResult<Vec<_>>>()?;
        let row = |ostium: maps::Ostium| {
            let place = [self.0.column(ostium.around), ostium.at / self.0.pixel_spacing()];
            (ostium.vessel, ostium.at, ostium.point.to_array(), place)
        };
        Ok(maps::ostia(&maps::walls(&self.0), &vessels).into_iter().map(row).collect())
    }
}

impl LumenMap {
    fn shaped<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        image: Vec<T>,
    ) -> PyResult<Bound<'py, PyArray2<T>>> {
        let [width, height] = self.0.size();
        PyArray1::from_vec(py, image).reshape([height, width])
    }
}
