//! The threads that compute. A forked process inherits its parent's pool without the threads in it and would wait
//! for them forever: it makes a pool of its own.

use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// The pool, and the process that its threads run in.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Runs `work` on the threads of this process.
pub fn install<T: Send>(work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let pool = pool()?;
    Ok(pool.install(work))
}

fn pool() -> PyResult<Arc<ThreadPool>> {
    let process = std::process::id();
    let mut made = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((owner, pool)) = made.as_ref()
        && *owner == process
    {
        return Ok(Arc::clone(pool));
    }
    let pool =
        ThreadPoolBuilder::new().build().map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let pool = Arc::new(pool);
    // Dropping the parent's pool would wait for threads that do not exist here.
    std::mem::forget(made.replace((process, Arc::clone(&pool))));
    Ok(pool)
}
