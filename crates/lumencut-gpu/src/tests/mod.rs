//! Each stage compared with the CPU's, and checks that the code for GPU and CPU stays consistent.
#![allow(clippy::unwrap_used)]

mod both_sides;
mod composite;
mod constants;
mod context;
mod coverage;
mod depth_filter;
mod device;
mod failures;
mod focus;
mod frames;
mod imports;
mod layouts;
mod leap;
mod placed;
mod silhouette;
mod steady;
mod surface;
mod ties;
mod volume;
mod wall;

use std::sync::{Arc, OnceLock};

use lumencut_core::camera::Camera;
use lumencut_core::math::blocks::HUGE;
use wgpu::Buffer;

use crate::adapter::{Choice, adapters};
use crate::device::Device;
use crate::recording::{Recording, Results};
use crate::view;

/// Image sizes that are not multiples of a workgroup's size.
pub(crate) const SIZES: [[usize; 2]; 5] = [[1, 1], [1, 17], [17, 1], [257, 257], [33, 20]];

/// The GPU that all tests share. Without a GPU, prints the reason and returns `None`, or panics if
/// `LUMENCUT_REQUIRE_GPU` is set.
pub(crate) fn device() -> Option<&'static Device> {
    shared().map(Arc::as_ref)
}

pub(crate) fn shared() -> Option<&'static Arc<Device>> {
    static DEVICE: OnceLock<Option<Arc<Device>>> = OnceLock::new();
    let open = || match pollster::block_on(Device::open(Choice::Any)) {
        Ok(device) => Some(Arc::new(device)),
        Err(error) if std::env::var_os("LUMENCUT_REQUIRE_GPU").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("not tested on a GPU: {error}");
            None
        }
    };
    DEVICE.get_or_init(open).as_ref()
}

/// Every GPU of this machine that meets the limits of the stages, including software.
pub(crate) fn every_device() -> Vec<Arc<Device>> {
    if shared().is_none() {
        return Vec::new();
    }
    let open = |adapter| match pollster::block_on(Device::on(&adapter)) {
        Ok(device) => Some(Arc::new(device)),
        Err(error) => {
            eprintln!("not tested: {error}");
            None
        }
    };
    pollster::block_on(adapters()).into_iter().filter_map(open).collect()
}

pub(crate) fn on_gpu(device: &Device, camera: &Camera) -> Buffer {
    let buffer = device.uniform::<view::ViewParameters>("view");
    device.write(&buffer, &[view::ViewParameters::new(camera)]);
    buffer
}

pub(crate) fn finish(recording: Recording) -> Results {
    pollster::block_on(recording.finish(&|| false)).unwrap()
}

/// Replaces NaN by the marker HUGE, which shaders use.
pub(crate) fn without_holes(values: &[f32]) -> Vec<f32> {
    values.iter().map(|v| if v.is_nan() { HUGE } else { *v }).collect()
}
