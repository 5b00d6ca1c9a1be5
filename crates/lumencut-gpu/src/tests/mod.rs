//! The stages against those of the CPU, on any GPU that there is.

mod context;
mod scenes;
mod surface;
mod volume;

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use crate::adapter::Choice;
use crate::device::Device;

/// The one GPU of all tests, for one of them at a time: to open it takes long, and to wait for it from two threads at
/// once makes wgpu panic now and then.
fn device() -> Option<MutexGuard<'static, Device>> {
    static DEVICE: OnceLock<Option<Mutex<Device>>> = OnceLock::new();
    let open = || match pollster::block_on(Device::open(Choice::Any)) {
        Ok(device) => Some(Mutex::new(device)),
        Err(error) if std::env::var_os("LUMENCUT_REQUIRE_GPU").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("not tested: {error}");
            None
        }
    };
    let device = DEVICE.get_or_init(open).as_ref()?;
    Some(device.lock().unwrap_or_else(PoisonError::into_inner))
}
