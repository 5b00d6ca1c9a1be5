//! The surface on the GPU.

use bytemuck::{Pod, Zeroable};
use lumencut_core::error::Result;
use lumencut_core::settings::{Slab as SlabSettings, SlabMode};
use lumencut_core::stages::surface::parts;
use lumencut_core::volume::Volume;
use wgpu::{BindingResource, Buffer};

use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;
use crate::volume::DeviceVolume;

/// `Slab` of `stages/surface.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Slab {
    pub part: f32,
    pub beside: u32,
    pub mode: u32,
    pub padding: u32,
}

impl Slab {
    fn new(slab: Option<SlabSettings>, volume: &Volume) -> Result<Self> {
        let (part, beside) = parts(slab, volume)?;
        let mode = match slab.map(|slab| slab.mode) {
            Some(SlabMode::Max) => 1,
            Some(SlabMode::Min) => 2,
            _ => 0,
        };
        Ok(Self { part: part as f32, beside: beside as u32, mode, padding: 0 })
    }
}

/// The stage, for whole numbers and for floats, and its settings.
#[derive(Debug)]
pub(crate) struct Surface {
    stages: [Option<Stage>; 2],
    slab: Buffer,
}

impl Surface {
    /// Nothing compiled yet.
    pub fn new(device: &Device) -> Self {
        Self { stages: [None, None], slab: device.uniform::<Slab>("slab") }
    }

    /// Writes the volume's value at the depth of each of a view's `size` pixels, HUGE outside the volume. `on_device` is
    /// `volume`, placed in that view.
    ///
    /// # Errors
    /// As the stage of the CPU.
    #[allow(clippy::too_many_arguments)]
    pub fn record(
        &mut self,
        recording: &mut Recording,
        (view, size): (&Buffer, [usize; 2]),
        (on_device, volume): (&DeviceVolume, &Volume),
        slab: Option<SlabSettings>,
        depth: &Buffer,
        value: &Buffer,
    ) -> Result<()> {
        let device = recording.device;
        device.write(&self.slab, &[Slab::new(slab, volume)?]);
        let is_float = on_device.is_float();
        let stage = self.stages[usize::from(is_float)].get_or_insert_with(|| {
            Stage::new(device, "stages/surface", &[("FLOAT_VOXELS", f64::from(u8::from(is_float)))])
        });
        let resources = [
            view.as_entire_binding(),
            self.slab.as_entire_binding(),
            on_device.grid.as_entire_binding(),
            BindingResource::TextureView(&on_device.voxels),
            depth.as_entire_binding(),
            value.as_entire_binding(),
        ];
        recording.run(stage, &resources, groups(size, [8, 8]));
        Ok(())
    }
}
