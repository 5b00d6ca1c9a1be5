//! The thread pool. A forked process makes its own pool: it inherits its parent's pool without threads, and would wait forever.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

struct Made {
    process: u32,
    wanted: usize,
    pool: Arc<ThreadPool>,
}

static POOL: Mutex<Option<Made>> = Mutex::new(None);

/// The requested number of threads; 0 for one per logical processor.
static WANTED: AtomicUsize = AtomicUsize::new(0);

/// Sets the number of threads; 0 for one per logical processor.
#[pyfunction]
pub(crate) fn set_threads(count: usize) {
    WANTED.store(count, Ordering::Relaxed);
}

#[pyfunction]
pub(crate) fn threads() -> PyResult<usize> {
    pool().map(|pool| pool.current_num_threads())
}

pub(crate) fn install<T: Send>(work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let pool = pool()?;
    Ok(pool.install(work))
}

fn pool() -> PyResult<Arc<ThreadPool>> {
    let (process, wanted) = (std::process::id(), WANTED.load(Ordering::Relaxed));
    let mut made = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(made) = made.as_ref()
        && (made.process, made.wanted) == (process, wanted)
    {
        return Ok(Arc::clone(&made.pool));
    }
    let pool = ThreadPoolBuilder::new()
        .num_threads(wanted)
        .build()
        .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let pool = Arc::new(pool);
    let before = made.replace(Made { process, wanted, pool: Arc::clone(&pool) });
    if before.as_ref().is_some_and(|before| before.process != process) {
        // Dropping the parent's pool would wait for threads that do not exist here.
        std::mem::forget(before);
    }
    Ok(pool)
}
