//! Each stage against the CPU's, and what holds the two together.
#![allow(clippy::unwrap_used)]

pub(crate) mod compare;
mod composite;
mod constants;
mod context;
mod depth_filter;
mod device;
mod failures;
mod frames;
mod imports;
mod layouts;
mod scenes;
mod silhouette;
mod surface;
mod volume;

use std::sync::{Arc, OnceLock};

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::math::blocks::HUGE;
use lumencut_core::math::lanes::Isa;
use lumencut_core::stages::View;
use wgpu::Buffer;

use crate::adapter::Choice;
use crate::device::Device;
use crate::recording::{Recording, Results};
use crate::view;

/// Images that no group of threads fits.
pub(crate) const SIZES: [[usize; 2]; 5] = [[1, 1], [1, 17], [17, 1], [257, 257], [33, 20]];

/// The GPU that all tests share; where there is none, why, and nothing, unless `LUMENCUT_REQUIRE_GPU` is set.
pub(crate) fn device() -> Option<&'static Device> {
    shared().map(Arc::as_ref)
}

/// The same, for renderers.
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

/// A view of `size` pixels of `spacing` mm.
pub(crate) fn camera(size: [usize; 2], spacing: f64) -> Camera {
    Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, size, spacing).unwrap()
}

/// The CPU's view.
pub(crate) fn on_cpu(camera: &Camera) -> View<'_> {
    View { camera, isa: Isa::widest(), stop: &|| false }
}

/// The GPU's view.
pub(crate) fn on_gpu(device: &Device, camera: &Camera) -> Buffer {
    let buffer = device.uniform::<view::View>("view");
    device.write(&buffer, &[view::View::new(camera)]);
    buffer
}

/// Runs everything.
pub(crate) fn finish(recording: Recording) -> Results {
    pollster::block_on(recording.finish(&|| false)).unwrap()
}

/// Numbers that are the same in every run.
pub(crate) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    }

    /// From `low` to `high`.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.bits() >> 40) as f32 / (1 << 24) as f32;
        low + (high - low) * unit
    }

    /// Whether something happens that does once in `n` times.
    pub fn once_in(&mut self, n: u64) -> bool {
        self.bits().is_multiple_of(n)
    }

    /// An image of numbers from `low` to `high`.
    pub fn image(&mut self, pixels: usize, low: f32, high: f32) -> Vec<f32> {
        (0..pixels).map(|_| self.between(low, high)).collect()
    }
}

/// Values as shaders have them: HUGE where there is none.
pub(crate) fn without_holes(values: &[f32]) -> Vec<f32> {
    values.iter().map(|v| if v.is_nan() { HUGE } else { *v }).collect()
}
