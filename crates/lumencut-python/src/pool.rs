//! The threads that compute. A forked process inherits its parent's pool without the threads in it and would wait
//! for them forever: it makes a pool of its own.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// A pool, how many threads were wanted for it, and the process that they run in.
struct Made {
    process: u32,
    wanted: usize,
    pool: Arc<ThreadPool>,
}

static POOL: Mutex<Option<Made>> = Mutex::new(None);

/// How many threads are wanted; 0 stands for as many as the processor runs at once.
static WANTED: AtomicUsize = AtomicUsize::new(0);

/// From now on this number of threads computes; 0 stands for as many as the processor runs at once.
#[pyfunction]
pub(crate) fn set_threads(count: usize) {
    WANTED.store(count, Ordering::Relaxed);
}

/// How many threads compute.
#[pyfunction]
pub(crate) fn threads() -> PyResult<usize> {
    pool().map(|pool| pool.current_num_threads())
}

/// Runs `work` on the threads of this process.
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
