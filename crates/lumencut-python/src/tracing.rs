//! Traces centerlines between clicks while other Python threads can run; Ctrl-C stops it.

use std::sync::{Mutex, PoisonError};

use glam::DVec3;
use lumencut::progress::Progress;
use lumencut::trace::clicks::Traced;
use lumencut::trace::clicks::checks::Clicks;
use lumencut::trace::clicks::doubts::Doubted;
use lumencut::trace::clicks::tracer::Tracer as Core;
use lumencut::trace::ways::region::Stopper;
use lumencut::voxels::Voxels;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::pool;
use crate::tree::points_of;
use crate::volume::VolumeArgument;
use crate::watching::{Reporter, SHARES, interruptible};

/// A line: points (n, 3), radii (n,), confidence (n,), whether each point is bridged (n,), and doubts in words.
type TracedArrays<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Vec<String>,
);

/// The data of a volume that are kept between tracings.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct Tracer(Mutex<Core>);

#[pymethods]
impl Tracer {
    #[new]
    fn new() -> Self {
        Self(Mutex::new(Core::default()))
    }

    /// Centerlines through the points (n, 3) of each vessel that avoid stoppers `(position, radius)`. `callback` receives the
    /// fraction of the work that is done.
    #[pyo3(signature = (volume, vessels, stoppers, bridge, callback=None))]
    #[allow(clippy::needless_pass_by_value)]
    fn trace<'py>(
        &self,
        py: Python<'py>,
        volume: VolumeArgument<'py>,
        vessels: Vec<PyReadonlyArray2<'py, f64>>,
        stoppers: Vec<([f64; 3], f64)>,
        bridge: bool,
        callback: Option<Py<PyAny>>,
    ) -> PyResult<Vec<TracedArrays<'py>>> {
        let borrowed = volume.borrow()?;
        let volume = volume.volume(&borrowed)?;
        let vessels = vessels.iter().map(points_of).collect::<PyResult<_>>()?;
        let stoppers = stoppers
            .into_iter()
            .map(|(c, radius)| Stopper { center: DVec3::from_array(c), radius })
            .collect();
        let clicks = Clicks { vessels, stoppers, bridge, beside: Vec::new() };
        let progress = Progress::default();
        let reporter = callback.as_ref().map(|callback| Reporter { progress: &progress, callback });
        let traced = interruptible(py, reporter.as_ref(), |stop| {
            let progress = reporter.as_ref().map(|reporter| reporter.progress);
            let mut tracer = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            let tracer = &mut *tracer;
            let with_doubts = || {
                let traced = tracer.trace(&volume, &clicks, stop, progress)?;
                let voxels = &Voxels::new(&volume);
                let pairs = traced.into_iter().zip(&clicks.vessels).map(|(traced, clicks)| {
                    let doubted = Doubted { line: &traced.line, bridged: &traced.bridged, clicks };
                    (doubted.doubts(voxels).into_iter().map(|doubt| doubt.words).collect(), traced)
                });
                Ok(pairs.collect::<Vec<(Vec<String>, Traced)>>())
            };
            pool::install(with_doubts)?.map_err(to_python)
        })?;
        if let Some(reporter) = reporter {
            reporter.report(py, SHARES)?;
        }
        traced.into_iter().map(|(doubts, traced)| arrays(py, traced, doubts)).collect()
    }
}

fn arrays(py: Python<'_>, traced: Traced, doubts: Vec<String>) -> PyResult<TracedArrays<'_>> {
    let line = traced.line;
    let flat: Vec<f64> = line.points.iter().flat_map(|p| p.to_array()).collect();
    Ok((
        PyArray1::from_vec(py, flat).reshape([line.points.len(), 3])?,
        PyArray1::from_vec(py, line.radius),
        PyArray1::from_vec(py, line.confidence),
        PyArray1::from_vec(py, traced.bridged),
        doubts,
    ))
}
