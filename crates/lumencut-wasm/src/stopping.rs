//! How the page stops work under way, and hears how far it is. The page sets bits of one byte where it shares the memory;
//! nothing else reaches the worker before its work is done.

use std::cell::RefCell;
use std::sync::atomic::{AtomicU8, Ordering};

use js_sys::{Date, Function};
use lumencut::progress::Progress;
use wasm_bindgen::JsValue;

use lumencut::study::failure::Result;
use lumencut::study::tracing::Watch;

/// What the page asked to stop.
static ASKED: AtomicU8 = AtomicU8::new(0);

/// The bit for a view, and that for tracing and measuring: a view gives way to whatever the user waits for, long work to a
/// cancellation alone. That is of all long work that was asked for before, so its bit stays until the worker hears of it.
pub const VIEW: u8 = 1;
pub const LONG: u8 = 2;

/// How often the page hears how far work is (ms).
const TELLING: f64 = 100.0;

/// Who hears of the work under way, and when that was last.
struct Listener {
    told: Function,
    last: f64,
}

thread_local! {
    /// The listener of the engine's own thread; others have none.
    static LISTENER: RefCell<Option<Listener>> = const { RefCell::new(None) };
}

/// Where the byte lies.
pub fn address() -> usize {
    ASKED.as_ptr() as usize
}

/// What was asked of a kind of work is heard, and counts no longer.
pub fn heard(kind: u8) {
    ASKED.fetch_and(!kind, Ordering::Relaxed);
}

/// Whether work of a kind is to stop.
pub fn is_asked(kind: u8) -> bool {
    ASKED.load(Ordering::Relaxed) & kind != 0
}

/// Does work that can be stopped; `told`, where somebody listens, is called now and then with the share that is done.
///
/// # Errors
/// Those of the work.
pub fn watched<T>(told: Option<Function>, work: impl FnOnce(Watch) -> Result<T>) -> Result<T> {
    let progress = Progress::default();
    LISTENER.set(told.map(|told| Listener { told, last: Date::now() }));
    let stop = || {
        tell(&progress);
        is_asked(LONG)
    };
    let result = work(Watch { stop: &stop, progress: &progress });
    LISTENER.set(None);
    result
}

fn tell(progress: &Progress) {
    LISTENER.with_borrow_mut(|listener| {
        let Some(listener) = listener else { return };
        let now = Date::now();
        if now - listener.last >= TELLING {
            listener.last = now;
            // A page that does not listen any more is no reason to stop.
            let _ = listener.told.call1(&JsValue::NULL, &JsValue::from_f64(progress.share()));
        }
    });
}
