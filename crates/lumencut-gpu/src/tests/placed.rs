//! Places volumes on the GPU in a view, for several tests.
#![allow(clippy::unwrap_used)]

use lumencut_core::camera::Camera;
use lumencut_core::math::blocks::Blocks;
use lumencut_core::volume::Volume;
use wgpu::Buffer;

use super::on_gpu;
use crate::blocks::DeviceBlocks;
use crate::device::Device;
use crate::recording::Recording;
use crate::volume::{DeviceVolume, GridParameters};

pub(super) struct Placed<'a> {
    pub device: &'a Device,
    pub camera: &'a Camera,
    pub volume: &'a Volume<'a>,
    pub on_device: DeviceVolume,
    pub view: Buffer,
    pub grid: Buffer,
}

impl<'a> Placed<'a> {
    pub(super) fn new(device: &'a Device, volume: &'a Volume<'a>, camera: &'a Camera) -> Self {
        let on_device = DeviceVolume::new(device, volume, &|| false).unwrap();
        let grid = device.uniform::<GridParameters>("grid");
        device.write(&grid, &[on_device.grid(volume, Some(camera))]);
        Self { device, camera, volume, on_device, view: on_gpu(device, camera), grid }
    }

    pub(super) fn pixels(&self) -> usize {
        self.camera.size()[0] * self.camera.size()[1]
    }

    pub(super) fn image(&self, numbers: &[f32]) -> Buffer {
        let image = self.device.image("image", numbers.len(), 4);
        self.device.write(&image, numbers);
        image
    }

    pub(super) fn blocks(&self) -> DeviceBlocks {
        DeviceBlocks::new(self.device, &Blocks::new(self.volume, &|| false).unwrap()).unwrap()
    }
}

pub(super) fn finish<T: bytemuck::Pod + Send + Sync>(mut recording: Recording, image: &Buffer) -> Vec<T> {
    recording.read(image, image.size());
    super::finish(recording).numbers(0)
}
