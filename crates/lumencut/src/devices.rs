//! The GPU that all scenes of this process share, and the choice among GPUs.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use lumencut_core::error::{Error, ErrorKind, Result};
pub use lumencut_gpu::adapter::{Choice, Description, devices};
pub use lumencut_gpu::device::Device;

/// Environment variable for what `auto` means: `hardware` (a hardware GPU, the default), `any` (any GPU), or `cpu`.
pub(crate) const AUTO: &str = "LUMENCUT_AUTO_DEVICE";

/// Set once a search has found no hardware GPU; the search is then not repeated.
static IS_BARE: AtomicBool = AtomicBool::new(false);

/// Advice if a forked process cannot open its parent's GPU, since some drivers serve only the parent.
const SPAWN: &str =
    "start processes by 'spawn' instead of 'fork': this driver does not support forked processes";

/// The device that the user requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// The CPU.
    Cpu,
    /// A GPU. If there is none, opening fails.
    Gpu(Choice),
    /// A GPU if available, else the CPU.
    Auto(Choice),
}

impl Wanted {
    /// The device named `auto`, `cpu` or `gpu`; the environment variable `AUTO` defines what `auto` means. Fails with
    /// [`ErrorKind::Settings`] for an unknown name or another value of the environment variable.
    pub fn named(name: &str) -> Result<Self> {
        Self::with_auto(name, std::env::var(AUTO).ok().as_deref())
    }

    /// The device for `name`; `auto` is the value of the environment variable `AUTO`. Fails with
    /// [`ErrorKind::Settings`] for an unknown name.
    pub fn with_auto(name: &str, auto: Option<&str>) -> Result<Self> {
        match name {
            "cpu" => Ok(Self::Cpu),
            "gpu" => Ok(Self::Gpu(Choice::Any)),
            "auto" => match auto {
                None | Some("" | "hardware") => Ok(Self::Auto(Choice::Hardware)),
                Some("any") => Ok(Self::Auto(Choice::Any)),
                Some("cpu") => Ok(Self::Cpu),
                Some(other) => {
                    Err(unknown(&format!("environment variable {AUTO}"), other, "cpu, hardware or any"))
                }
            },
            other => Err(unknown("device", other, "auto, cpu or gpu")),
        }
    }
}

fn unknown(subject: &str, found: &str, expected: &str) -> Error {
    Error::new(ErrorKind::Settings, subject, format!("'{found}'"), expected)
}

struct Opened {
    process: u32,
    device: Arc<Device>,
}

impl Opened {
    fn will_do(&self, choice: Choice) -> bool {
        let is_hardware = !self.device.description().is_software;
        self.process == process() && !self.device.is_lost() && (choice == Choice::Any || is_hardware)
    }
}

/// The GPU of this process; it is opened if necessary. Fails with [`ErrorKind::Device`] if there is no GPU of the
/// chosen kind, or it cannot be used.
pub async fn open(choice: Choice) -> Result<Arc<Device>> {
    let (shared, is_forked) = with_shared(|shared| {
        let device =
            shared.as_ref().filter(|opened| opened.will_do(choice)).map(|opened| Arc::clone(&opened.device));
        (device, shared.as_ref().is_some_and(|opened| opened.process != process()))
    });
    match shared {
        Some(device) => Ok(device),
        None => match Device::open(choice).await {
            Err(error) if is_forked => Err(error.mend(SPAWN)),
            opened => Ok(share(Arc::new(opened?), choice)),
        },
    }
}

/// Shares a newly opened GPU. If another thread has shared one meanwhile, returns that GPU.
fn share(device: Arc<Device>, choice: Choice) -> Arc<Device> {
    with_shared(|shared| {
        if let Some(opened) = shared.as_ref().filter(|opened| opened.will_do(choice)) {
            return Arc::clone(&opened.device);
        }
        // Dropping the parent's GPU would block, since it does not respond to this process.
        std::mem::forget(shared.take_if(|opened| opened.process != process()));
        *shared = Some(Opened { process: process(), device: Arc::clone(&device) });
        device
    })
}

pub(crate) async fn open_if_there(choice: Choice) -> Result<Option<Arc<Device>>> {
    if choice == Choice::Hardware && IS_BARE.load(Ordering::Relaxed) {
        return Ok(None);
    }
    match open(choice).await {
        Ok(device) => Ok(Some(device)),
        Err(error) => {
            let found = devices().await;
            if found.iter().any(|device| choice == Choice::Any || !device.is_software) {
                return Err(error);
            }
            IS_BARE.store(choice == Choice::Hardware, Ordering::Relaxed);
            Ok(None)
        }
    }
}

/// Forgets a failed GPU, so that the next scene opens it again.
pub fn forget(failed: &Device) {
    with_shared(|shared| {
        drop(shared.take_if(|opened| std::ptr::eq(Arc::as_ptr(&opened.device), failed)));
    });
}

/// The id of this process; always 0 in a browser.
pub(crate) fn process() -> u32 {
    if cfg!(target_arch = "wasm32") { 0 } else { std::process::id() }
}

#[cfg(not(target_arch = "wasm32"))]
fn with_shared<T>(work: impl FnOnce(&mut Option<Opened>) -> T) -> T {
    use std::sync::{Mutex, PoisonError};

    static SHARED: Mutex<Option<Opened>> = Mutex::new(None);
    work(&mut SHARED.lock().unwrap_or_else(PoisonError::into_inner))
}

#[cfg(target_arch = "wasm32")]
fn with_shared<T>(work: impl FnOnce(&mut Option<Opened>) -> T) -> T {
    use std::cell::RefCell;

    thread_local!(static SHARED: RefCell<Option<Opened>> = const { RefCell::new(None) });
    SHARED.with_borrow_mut(work)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_is_hardware_unless_told_otherwise() {
        assert_eq!(Wanted::with_auto("auto", None), Ok(Wanted::Auto(Choice::Hardware)));
        assert_eq!(Wanted::with_auto("auto", Some("")), Ok(Wanted::Auto(Choice::Hardware)));
        assert_eq!(Wanted::with_auto("auto", Some("hardware")), Ok(Wanted::Auto(Choice::Hardware)));
        assert_eq!(Wanted::with_auto("auto", Some("any")), Ok(Wanted::Auto(Choice::Any)));
        assert_eq!(Wanted::with_auto("auto", Some("cpu")), Ok(Wanted::Cpu));
    }

    #[test]
    fn a_device_that_is_named_does_not_ask_the_environment() {
        assert_eq!(Wanted::with_auto("cpu", Some("any")), Ok(Wanted::Cpu));
        assert_eq!(Wanted::with_auto("gpu", Some("cpu")), Ok(Wanted::Gpu(Choice::Any)));
    }

    #[test]
    fn unknown_names_are_refused_with_their_source() {
        let error = Wanted::with_auto("tpu", None).unwrap_err();
        assert_eq!(error.to_string(), "device: found 'tpu'; expected auto, cpu or gpu");
        let error = Wanted::with_auto("auto", Some("fast")).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Settings);
        assert_eq!(
            error.to_string(),
            "environment variable LUMENCUT_AUTO_DEVICE: found 'fast'; expected cpu, hardware or any"
        );
    }
}
