//! The stages against those of the CPU, on any GPU that there is.

mod scenes;
mod surface;

use std::sync::OnceLock;

use crate::adapter::Choice;
use crate::device::Device;

/// The one GPU of all tests: to open it takes long.
fn device() -> Option<&'static Device> {
    static DEVICE: OnceLock<Option<Device>> = OnceLock::new();
    let open = || match pollster::block_on(Device::open(Choice::Any)) {
        Ok(device) => Some(device),
        Err(error) if std::env::var_os("LUMENCUT_REQUIRE_GPU").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("not tested: {error}");
            None
        }
    };
    DEVICE.get_or_init(open).as_ref()
}
