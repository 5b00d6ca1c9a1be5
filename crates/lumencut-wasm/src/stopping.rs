//! Stops work in progress, and reports its progress. A busy worker receives no messages, so the page sets bits in shared memory.

use std::cell::RefCell;
use std::sync::atomic::{AtomicU8, Ordering};

use js_sys::{Date, Function};
use lumencut::progress::Progress;
use wasm_bindgen::JsValue;

use lumencut::study::failure::Result;
use lumencut::study::tracing::Watch;

/// The stop bits set by the page.
static ASKED: AtomicU8 = AtomicU8::new(0);

/// The stop bits of views, and of tracing and measuring. A cancellation ends all long work that was requested before it, so its bit
/// stays set until the worker receives the cancellation.
pub const VIEW: u8 = 1;
pub const LONG: u8 = 2;

/// Time between two progress reports (ms).
const PROGRESS_INTERVAL_MS: f64 = 100.0;

struct Listener {
    on_progress: Function,
    last: f64,
}

thread_local! {
    /// Only set on the engine's own thread.
    static LISTENER: RefCell<Option<Listener>> = const { RefCell::new(None) };
}

pub fn address() -> usize {
    ASKED.as_ptr() as usize
}

/// Clears a stop bit: [`VIEW`] or [`LONG`].
pub fn heard(kind: u8) {
    ASKED.fetch_and(!kind, Ordering::Relaxed);
}

pub fn is_asked(kind: u8) -> bool {
    ASKED.load(Ordering::Relaxed) & kind != 0
}

/// Runs work that can be stopped, and reports the fraction that is done.
pub fn with_progress<T>(on_progress: Option<Function>, work: impl FnOnce(Watch) -> Result<T>) -> Result<T> {
    let progress = Progress::default();
    LISTENER.set(on_progress.map(|on_progress| Listener { on_progress, last: Date::now() }));
    let stop = || {
        report(&progress);
        is_asked(LONG)
    };
    let result = work(Watch { stop: &stop, progress: &progress });
    LISTENER.set(None);
    result
}

fn report(progress: &Progress) {
    LISTENER.with_borrow_mut(|listener| {
        let Some(listener) = listener else { return };
        let now = Date::now();
        if now - listener.last >= PROGRESS_INTERVAL_MS {
            listener.last = now;
            // If the listener fails, the work continues.
            let _ = listener.on_progress.call1(&JsValue::NULL, &JsValue::from_f64(progress.share()));
        }
    });
}
