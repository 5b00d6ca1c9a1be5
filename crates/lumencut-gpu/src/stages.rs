//! All compiled stages, and the grid of the volume that they read.

use lumencut_core::geometry::Geometry;
use lumencut_core::volume::Volume;
use wgpu::Buffer;

use crate::body::BodyStage;
use crate::composite::Composite;
use crate::context::ContextStage;
use crate::cut_surface::CutSurfaceStages;
use crate::depth_filter::DepthFilter;
use crate::device::Device;
use crate::far_rim::FarRim;
use crate::leap::Leap;
use crate::occlusion::Occlusion;
use crate::rim::Rim;
use crate::silhouette::Silhouette;
use crate::steady::Steady;
use crate::surface::Surface;
use crate::view::ViewParameters;
use crate::volume::{DeviceVolume, GridParameters};

/// The stages in the order of the pipeline. Those whose shaders depend on the settings are compiled when needed.
#[derive(Debug)]
pub(crate) struct Stages {
    pub view: Buffer,
    pub grid: Buffer,
    pub cut_surface: CutSurfaceStages,
    pub steady: Steady,
    pub leap: Leap,
    pub depth_filter: DepthFilter,
    pub occlusion: Occlusion,
    pub far_rim: FarRim,
    pub rim: Rim,
    pub surface: Surface,
    pub silhouette: Silhouette,
    pub context: ContextStage,
    pub body: BodyStage,
    pub composite: Composite,
}

impl Stages {
    pub(crate) fn new(device: &Device) -> Self {
        Self {
            view: device.uniform::<ViewParameters>("view"),
            grid: device.uniform::<GridParameters>("grid"),
            cut_surface: CutSurfaceStages::new(device),
            steady: Steady::new(device),
            leap: Leap::new(device),
            depth_filter: DepthFilter::new(device),
            occlusion: Occlusion::new(device),
            far_rim: FarRim::new(device),
            rim: Rim::new(device),
            surface: Surface::new(device),
            silhouette: Silhouette::new(device),
            context: ContextStage::new(device),
            body: BodyStage::new(device),
            composite: Composite::new(device),
        }
    }

    /// Writes the position of a volume in the view. The pixels of a curved geometry are given as voxel
    /// indices and need no view.
    pub(crate) fn place(
        &self,
        device: &Device,
        on_device: &DeviceVolume,
        volume: &Volume,
        geometry: &Geometry,
    ) {
        device.write(&self.grid, &[on_device.grid(volume, geometry.camera())]);
    }
}
