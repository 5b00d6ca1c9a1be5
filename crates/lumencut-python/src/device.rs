//! The GPU of this process, which all renderers share, and which of the GPUs it may be.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_gpu::adapter::{self, Choice};
use lumencut_gpu::device::Device;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What `auto` takes: hardware where nothing is said, `any` GPU, or the `cpu`.
const AUTO: &str = "LUMENCUT_AUTO_DEVICE";

/// The GPU, and the process that opened it.
static SHARED: Mutex<Option<(u32, Arc<Device>)>> = Mutex::new(None);

/// Whether a search for hardware has found none; it does not appear later.
static IS_BARE: AtomicBool = AtomicBool::new(false);

/// What a renderer wants to compute on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    Cpu,
    /// A GPU, or an error.
    Gpu(Choice),
    /// A GPU, or the CPU.
    Auto(Choice),
}

impl Wanted {
    /// What `auto`, `cpu` or `gpu` stands for.
    pub fn named(name: &str) -> Result<Self> {
        match name {
            "cpu" => Ok(Self::Cpu),
            "gpu" => Ok(Self::Gpu(Choice::Any)),
            "auto" => match std::env::var(AUTO).as_deref() {
                Err(_) | Ok("" | "hardware") => Ok(Self::Auto(Choice::Hardware)),
                Ok("any") => Ok(Self::Auto(Choice::Any)),
                Ok("cpu") => Ok(Self::Cpu),
                Ok(other) => {
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

/// The GPU of this process, opened where it is not yet. A forked process cannot use its parent's.
pub fn open(choice: Choice) -> Result<Arc<Device>> {
    let process = std::process::id();
    let mut shared = SHARED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((owner, device)) = shared.as_ref()
        && *owner == process
        && (choice == Choice::Any || !device.description().is_software)
    {
        return Ok(Arc::clone(device));
    }
    let device = Arc::new(pollster::block_on(Device::open(choice))?);
    // Dropping the parent's would wait for a GPU that does not listen to this process.
    std::mem::forget(shared.take_if(|(owner, _)| *owner != process));
    *shared = Some((process, Arc::clone(&device)));
    Ok(device)
}

/// The GPU of this process where this machine has one of that kind.
pub fn open_if_there(choice: Choice) -> Result<Option<Arc<Device>>> {
    if choice == Choice::Hardware && IS_BARE.load(Ordering::Relaxed) {
        return Ok(None);
    }
    match open(choice) {
        Ok(device) => Ok(Some(device)),
        Err(error) => {
            let found = pollster::block_on(adapter::devices());
            if found.iter().any(|device| choice == Choice::Any || !device.is_software) {
                return Err(error);
            }
            IS_BARE.store(choice == Choice::Hardware, Ordering::Relaxed);
            Ok(None)
        }
    }
}

/// Lets the next renderer open the GPU anew, once this one has failed.
pub fn forget(failed: &Device) {
    let mut shared = SHARED.lock().unwrap_or_else(PoisonError::into_inner);
    shared.take_if(|(_, device)| std::ptr::eq(Arc::as_ptr(device), failed));
}

/// The GPUs of this machine, the ones to take first in front, as dictionaries.
#[pyfunction]
pub fn devices(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let found = py.detach(|| pollster::block_on(adapter::devices()));
    let described = found.into_iter().map(|device| {
        let fields = PyDict::new(py);
        fields.set_item("name", device.name)?;
        fields.set_item("backend", device.backend)?;
        fields.set_item("driver", device.driver)?;
        fields.set_item("is_software", device.is_software)?;
        fields.set_item("volume_side", device.volume_side)?;
        fields.set_item("buffer_bytes", device.buffer_bytes)?;
        Ok(fields)
    });
    described.collect()
}
