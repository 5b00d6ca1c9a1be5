//! Threads in a browser: workers that share this module's memory, if the page is cross-origin isolated.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, PoisonError};

use rayon::{ThreadBuilder, ThreadPoolBuilder};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Threads that no worker runs yet.
static WAITING: Mutex<VecDeque<ThreadBuilder>> = Mutex::new(VecDeque::new());
static COME: Condvar = Condvar::new();

/// Starts a pool of `count` workers, and blocks until all of them wait in [`run_thread`]. It can be called only once.
#[wasm_bindgen]
pub fn use_threads(count: usize) -> Result<(), JsError> {
    let pool = ThreadPoolBuilder::new().num_threads(count).spawn_handler(|thread| {
        WAITING.lock().unwrap_or_else(PoisonError::into_inner).push_back(thread);
        COME.notify_one();
        Ok(())
    });
    pool.build_global().map_err(|error| JsError::new(&error.to_string()))
}

/// Takes a waiting thread and runs it in the calling worker until it ends.
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
