//! A cache of the profiles of one scan.

use std::slice;
use std::sync::{Arc, Mutex, PoisonError};

use lumencut::kept_profiles::{KeptProfiles as Core, MeasureParameters, Scan};
use lumencut::measure::profile::request::with_progress as counted;
use lumencut::vessel_tree::Vessel;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::measuring::Profile;
use crate::pool;
use crate::tree::{VesselArrays, vessel as vessel_of};
use crate::tree_findings::wall_request;
use crate::volume::VolumeArgument;
use crate::watching::reporting;

/// A cache of the profiles of one volume and its vessel tree.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct KeptProfiles(Mutex<Core<Vessel>>);

#[pymethods]
impl KeptProfiles {
    #[new]
    fn new() -> Self {
        Self(Mutex::new(Core::default()))
    }

    /// The cached profile of a vessel with points (n, 3) and radii (n,); `callback` as in [`crate::measuring::measure`].
    #[pyo3(signature = (volume, tree, measured, step, fwhm=None, wall=None, callback=None))]
    #[allow(clippy::needless_pass_by_value, clippy::too_many_arguments)]
    fn profile<'py>(
        &self,
        py: Python<'py>,
        volume: VolumeArgument<'py>,
        tree: Vec<VesselArrays<'py>>,
        measured: VesselArrays<'py>,
        step: f64,
        fwhm: Option<f64>,
        wall: Option<[f64; 2]>,
        callback: Option<Py<PyAny>>,
    ) -> PyResult<Profile> {
        let borrowed = volume.borrow()?;
        let scan = volume.scan();
        let volume = &volume.volume(&borrowed)?;
        let tree = &tree.iter().map(vessel_of).collect::<PyResult<Vec<_>>>()?;
        let vessel = &vessel_of(&measured)?;
        reporting(py, callback.as_ref(), |stop, progress| {
            if let Some(progress) = progress {
                progress.expect_views(1);
            }
            let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            let kept = &mut *kept;
            let found = pool::install(|| {
                counted(progress, (slice::from_ref(vessel), step), stop, |stop| {
                    let asking = MeasureParameters { step, fwhm, wall: wall_request(wall), stop };
                    kept.of(vessel.clone(), vessel, Scan { volume, tree }, &asking)
                })
            })?;
            found.map(|number| Profile(Arc::clone(kept.kept(number)), scan)).map_err(to_python)
        })
    }
}
