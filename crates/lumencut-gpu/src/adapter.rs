//! The GPUs of this machine, and the choice between them.

use lumencut_core::error::{Error, ErrorKind, Mend, Result};
use wgpu::{Adapter, Backends, DeviceType, Instance, InstanceDescriptor};

/// The kinds of GPU that are acceptable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Only hardware: a software rasteriser is slower than our computation on the CPU.
    Hardware,
    /// Hardware, or else software.
    Any,
}

/// A GPU as its driver describes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Description {
    /// The name of the GPU.
    pub name: String,
    /// The graphics API, such as vulkan.
    pub backend: String,
    /// The driver and its version.
    pub driver: String,
    /// Whether it is a software rasteriser.
    pub is_software: bool,
    /// The largest number of voxels along each side of a volume.
    pub volume_side: u32,
    /// The largest buffer that a stage can read (bytes).
    pub buffer_bytes: u64,
}

impl Description {
    /// The description of an adapter.
    pub fn of(adapter: &Adapter) -> Self {
        let (info, limits) = (adapter.get_info(), adapter.limits());
        Self {
            name: info.name,
            backend: info.backend.to_string(),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            is_software: info.device_type == DeviceType::Cpu,
            volume_side: limits.max_texture_dimension_3d,
            buffer_bytes: limits.max_storage_buffer_binding_size,
        }
    }
}

/// The adapters of this machine, preferred ones first.
pub(crate) async fn adapters() -> Vec<Adapter> {
    let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
    let mut adapters = instance.enumerate_adapters(Backends::PRIMARY).await;
    // A browser lists no adapters but returns the one it prefers.
    if adapters.is_empty()
        && let Ok(adapter) = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await
    {
        adapters.push(adapter);
    }
    adapters.sort_by_key(|adapter| match adapter.get_info().device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    });
    adapters
}

/// The GPUs of this machine, preferred ones first.
pub async fn devices() -> Vec<Description> {
    adapters().await.iter().map(Description::of).collect()
}

pub(crate) async fn choose(choice: Choice) -> Result<Adapter> {
    let is_wanted =
        |adapter: &Adapter| choice == Choice::Any || adapter.get_info().device_type != DeviceType::Cpu;
    let adapters = adapters().await;
    let found = match adapters.len() {
        0 => "no GPU with a driver for Vulkan, Metal, DirectX 12 or WebGPU".to_owned(),
        _ => "software only".to_owned(),
    };
    adapters.into_iter().find(is_wanted).ok_or_else(|| {
        Error::new(ErrorKind::Device, "device", found, "a GPU")
            .mend("install its driver")
            .mended_by(Mend::Cpu)
    })
}
