//! Samples the volume at the cut surface on the GPU.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::geometry::{Curved, Geometry};
use lumencut_core::math::ray_lines::IndexFromView;
use lumencut_core::settings::Slab;
use lumencut_core::stages::surface::SurfaceParameters;
use lumencut_core::volume::Volume;
use wgpu::{BindingResource, Buffer};

use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;
use crate::volume::DeviceVolume;

/// Has the layout of `CurvedPixel` in `stages/surface.wgsl`: a pixel of a curved geometry in the volume.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct CurvedPixel {
    /// The integer part of the pixel's continuous index.
    pub whole: [f32; 4],
    /// The remainder of the index.
    pub part: [f32; 4],
    /// Change of the index per mm along the slab direction.
    pub per_mm: [f32; 4],
}

impl CurvedPixel {
    /// An index outside every volume.
    const NOWHERE: Self = Self { whole: [-1e6, -1e6, -1e6, 0.0], part: [0.0; 4], per_mm: [0.0; 4] };

    fn of(curved: &Curved, volume: &Volume) -> Vec<Self> {
        let to = volume.index_from_world();
        let place = |(point, direction): (&DVec3, &glam::Vec3)| {
            let index = to.transform_point3(*point);
            let per_mm = to.transform_vector3(direction.as_dvec3());
            // No volume reaches beyond this index, and integers up to it are exact.
            if !index.is_finite() || !per_mm.is_finite() || index.abs().max_element() >= 1e6 {
                return Self::NOWHERE;
            }
            let four = |v: DVec3| v.as_vec3().extend(0.0).to_array();
            Self { whole: four(index.floor()), part: four(index - index.floor()), per_mm: four(per_mm) }
        };
        curved.position().iter().zip(curved.slab_direction()).map(place).collect()
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceImages<'a> {
    pub size: [usize; 2],
    pub geometry: &'a Geometry,
    /// The depth of the cut surface (mm); used only with a camera.
    pub depth: &'a Buffer,
    pub value: &'a Buffer,
}

/// The variants of the stage: for integer and float voxels, for cameras and curved geometries.
#[derive(Debug)]
pub(crate) struct Surface {
    stages: [[Option<Stage>; 2]; 2],
    parameters: Buffer,
    /// Bound in place of a curved geometry and never read.
    nowhere: Buffer,
}

impl Surface {
    pub(crate) fn new(device: &Device) -> Self {
        Self {
            stages: Default::default(),
            parameters: device.uniform::<SurfaceParameters>("surface parameters"),
            nowhere: device.upload("nowhere", &[CurvedPixel::NOWHERE]),
        }
    }

    /// Writes the volume's value at each pixel, HUGE outside the volume. `on_device` is `volume`, placed in the view.
    pub(crate) fn record(
        &mut self,
        recording: &mut Recording,
        [view, grid]: [&Buffer; 2],
        (on_device, volume): (&DeviceVolume, &Volume),
        slab: Option<Slab>,
        images: SurfaceImages,
    ) -> Result<()> {
        let device = recording.device;
        let (sent, is_curved, voxel) = match images.geometry {
            Geometry::Curved(curved) => (Some(send(device, curved, volume)?), true, volume.smallest_side()),
            Geometry::Orthographic { camera, .. } => {
                (None, false, IndexFromView::new(volume, camera).voxel())
            }
        };
        device.write(&self.parameters, &[SurfaceParameters::new(slab, voxel)]);
        let places = sent.as_ref().unwrap_or(&self.nowhere);
        let is_float = on_device.is_float();
        let stage = self.stages[usize::from(is_curved)][usize::from(is_float)].get_or_insert_with(|| {
            let constants = [("FLOAT_VOXELS", is_float), ("CURVED", is_curved)];
            Stage::new(device, "stages/surface", &constants.map(|(name, is)| (name, f64::from(u8::from(is)))))
        });
        let resources = [
            view.as_entire_binding(),
            self.parameters.as_entire_binding(),
            grid.as_entire_binding(),
            BindingResource::TextureView(&on_device.voxels),
            images.depth.as_entire_binding(),
            images.value.as_entire_binding(),
            places.as_entire_binding(),
        ];
        recording.run(stage, &resources, groups(images.size, [8, 8]));
        Ok(())
    }
}

fn send(device: &Device, curved: &Curved, volume: &Volume) -> Result<Buffer> {
    let most = device.limits.max_storage_buffer_binding_size as usize / size_of::<CurvedPixel>();
    if curved.position().len() > most {
        let found = format!("{} pixels", curved.position().len());
        return Err(device.too_large("curved geometry", found, &format!("{most} pixels")));
    }
    Ok(device.upload("curved places", &CurvedPixel::of(curved, volume)))
}
