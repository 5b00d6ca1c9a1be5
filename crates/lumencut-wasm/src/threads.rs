//! Threads in a browser: workers that share the memory of this module, where the page is cross-origin isolated.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, PoisonError};

use rayon::{ThreadBuilder, ThreadPoolBuilder};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Threads that no worker runs yet.
static WAITING: Mutex<VecDeque<ThreadBuilder>> = Mutex::new(VecDeque::new());
static COME: Condvar = Condvar::new();

/// Lets `count` workers compute from now on. They wait in [`run_thread`] already: this one cannot go on before they do.
///
/// # Errors
/// Where it was called before.
#[wasm_bindgen]
pub fn use_threads(count: usize) -> Result<(), JsError> {
    let pool = ThreadPoolBuilder::new().num_threads(count).spawn_handler(|thread| {
        WAITING.lock().unwrap_or_else(PoisonError::into_inner).push_back(thread);
        COME.notify_one();
        Ok(())
    });
    pool.build_global().map_err(|error| JsError::new(&error.to_string()))
}

/// Runs one of the threads in the worker that calls it, to its end.
#[wasm_bindgen]
pub fn run_thread() {
    let mut waiting = WAITING.lock().unwrap_or_else(PoisonError::into_inner);
    let thread = loop {
        match waiting.pop_front() {
            Some(thread) => break thread,
            None => waiting = COME.wait(waiting).unwrap_or_else(PoisonError::into_inner),
        }
    };
    drop(waiting);
    thread.run();
}
