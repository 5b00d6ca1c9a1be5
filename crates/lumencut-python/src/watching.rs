//! Long work that tells a function of Python how far it is.

use lumencut::progress::Progress;
use lumencut::stop::Stop;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::pool;
use crate::renderer::{SHARES, Watched, interruptible};

/// Runs what the core computes on the threads of this process, as [`interruptible`] does.
pub fn computed<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Stop<'_>) -> lumencut::error::Result<T> + Send,
) -> PyResult<T> {
    interruptible(py, None, |stop| pool::install(|| work(stop))?.map_err(to_python))
}

/// Runs long work as [`interruptible`] does, and tells `told` how far it is, to its end.
pub fn told_while<T: Send>(
    py: Python<'_>,
    told: Option<&Py<PyAny>>,
    work: impl FnOnce(Stop<'_>, Option<&Progress>) -> PyResult<T> + Send,
) -> PyResult<T> {
    let progress = Progress::default();
    let watched = told.map(|told| Watched { progress: &progress, told });
    let done = interruptible(py, watched.as_ref(), |stop| work(stop, told.is_some().then_some(&progress)))?;
    if let Some(watched) = watched {
        watched.tell(py, SHARES)?;
    }
    Ok(done)
}
