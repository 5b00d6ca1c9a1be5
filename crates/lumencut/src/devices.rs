//! The GPU of this process, which all its scenes share, and which of the GPUs it may be.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use lumencut_core::error::{Error, ErrorKind, Result};
pub use lumencut_gpu::adapter::{Choice, Description, devices};
pub use lumencut_gpu::device::Device;

/// The environment variable that says what `auto` takes: `hardware` where nothing is said, `any` GPU, or the `cpu`.
pub(crate) const AUTO: &str = "LUMENCUT_AUTO_DEVICE";

/// Whether a search for hardware has found none; it does not appear later.
static IS_BARE: AtomicBool = AtomicBool::new(false);

/// What mends it where a forked process cannot open the GPU that its parent has: some drivers serve the parent alone.
const SPAWN: &str =
    "start processes by 'spawn' instead of 'fork': this driver does not support forked processes";

/// What a scene is to be computed on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// The CPU.
    Cpu,
    /// A GPU, or an error.
    Gpu(Choice),
    /// A GPU, or the CPU.
    Auto(Choice),
}

impl Wanted {
    /// What `auto`, `cpu` or `gpu` stands for; of `auto` the environment variable [`AUTO`] may say more.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for another name, also in the environment variable.
    pub fn named(name: &str) -> Result<Self> {
        Self::told(name, std::env::var(AUTO).ok().as_deref())
    }

    /// What `name` stands for where `auto` stands for what is told: `hardware` where nothing is, `any` GPU, or the `cpu`.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for another name of either.
    pub fn told(name: &str, auto: Option<&str>) -> Result<Self> {
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

/// A GPU, and the process that opened it: a forked process cannot use its parent's.
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

/// The GPU of this process, opened where it is not yet.
///
/// # Errors
/// [`ErrorKind::Device`] where there is none of that kind, or none that can be used.
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

/// Makes a GPU that was just opened the one of this process, unless another thread was quicker: then that one is it.
fn share(device: Arc<Device>, choice: Choice) -> Arc<Device> {
    with_shared(|shared| {
        if let Some(opened) = shared.as_ref().filter(|opened| opened.will_do(choice)) {
            return Arc::clone(&opened.device);
        }
        // Dropping the parent's would wait for a GPU that does not listen to this process.
        std::mem::forget(shared.take_if(|opened| opened.process != process()));
        *shared = Some(Opened { process: process(), device: Arc::clone(&device) });
        device
    })
}

/// The GPU of this process where this machine has one of that kind.
///
/// # Errors
/// [`ErrorKind::Device`] where there is one that cannot be used.
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

/// Lets the next scene open the GPU anew, once this one has failed.
pub fn forget(failed: &Device) {
    with_shared(|shared| {
        drop(shared.take_if(|opened| std::ptr::eq(Arc::as_ptr(&opened.device), failed)));
    });
}

/// The number of this process; a page of a browser is the only one.
pub(crate) fn process() -> u32 {
    if cfg!(target_arch = "wasm32") { 0 } else { std::process::id() }
}

/// Runs `work` on the place of the shared GPU.
#[cfg(not(target_arch = "wasm32"))]
fn with_shared<T>(work: impl FnOnce(&mut Option<Opened>) -> T) -> T {
    use std::sync::{Mutex, PoisonError};

    static SHARED: Mutex<Option<Opened>> = Mutex::new(None);
    work(&mut SHARED.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Runs `work` on the place of the shared GPU; a browser lets no other thread use it.
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
        assert_eq!(Wanted::told("auto", None), Ok(Wanted::Auto(Choice::Hardware)));
        assert_eq!(Wanted::told("auto", Some("")), Ok(Wanted::Auto(Choice::Hardware)));
        assert_eq!(Wanted::told("auto", Some("hardware")), Ok(Wanted::Auto(Choice::Hardware)));
        assert_eq!(Wanted::told("auto", Some("any")), Ok(Wanted::Auto(Choice::Any)));
        assert_eq!(Wanted::told("auto", Some("cpu")), Ok(Wanted::Cpu));
    }

    #[test]
    fn a_device_that_is_named_does_not_ask_the_environment() {
        assert_eq!(Wanted::told("cpu", Some("any")), Ok(Wanted::Cpu));
        assert_eq!(Wanted::told("gpu", Some("cpu")), Ok(Wanted::Gpu(Choice::Any)));
    }

    #[test]
    fn unknown_names_are_refused_with_their_source() {
        let error = Wanted::told("tpu", None).unwrap_err();
        assert_eq!(error.to_string(), "device: found 'tpu'; expected auto, cpu or gpu");
        let error = Wanted::told("auto", Some("fast")).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Settings);
        assert_eq!(
            error.to_string(),
            "environment variable LUMENCUT_AUTO_DEVICE: found 'fast'; expected cpu, hardware or any"
        );
    }
}
