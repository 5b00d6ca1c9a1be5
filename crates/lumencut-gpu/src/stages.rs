//! All stages, compiled, and what they read of a view.

use wgpu::Buffer;

use crate::composite::Composite;
use crate::context::ContextStage;
use crate::cut_surface::CutSurfaceStages;
use crate::depth_filter::DepthFilter;
use crate::device::Device;
use crate::silhouette::Silhouette;
use crate::surface::Surface;
use crate::view::View;

/// The stages in the order of the pipeline. Those whose shaders depend on the settings are compiled once needed.
#[derive(Debug)]
pub(crate) struct Stages {
    pub view: Buffer,
    pub cut_surface: CutSurfaceStages,
    pub depth_filter: DepthFilter,
    pub surface: Surface,
    pub silhouette: Silhouette,
    pub context: ContextStage,
    pub composite: Composite,
}

impl Stages {
    /// The stages on a GPU.
    pub fn new(device: &Device) -> Self {
        Self {
            view: device.uniform::<View>("view"),
            cut_surface: CutSurfaceStages::new(device),
            depth_filter: DepthFilter::new(device),
            surface: Surface::new(device),
            silhouette: Silhouette::new(device),
            context: ContextStage::new(device),
            composite: Composite::new(device),
        }
    }
}

/// The stages that the CPU can do in place of the GPU, to find where a difference begins. In a browser it does none:
/// its kernels would be most of what is loaded.
pub const STAGES: [&str; 7] =
    ["distance", "depth", "depth_filter", "surface", "silhouette", "context", "composite"];

/// Which stages the CPU does.
#[cfg_attr(target_arch = "wasm32", allow(dead_code))]
#[derive(Clone, Debug, Default)]
pub(crate) struct OnCpu(pub Vec<String>);

#[cfg(not(target_arch = "wasm32"))]
impl OnCpu {
    pub fn has(&self, stage: &str) -> bool {
        self.0.iter().any(|name| name == stage)
    }
}
