//! Volumes on the GPU in a view, which several tests share.
#![allow(clippy::unwrap_used)]

use lumencut_core::camera::Camera;
use lumencut_core::volume::Volume;

use crate::device::Device;
use crate::recording::Recording;
use crate::view::View;
use crate::volume::DeviceVolume;

/// A volume in a view on the GPU.
pub struct Placed<'a> {
    pub device: &'a Device,
    pub camera: &'a Camera,
    pub volume: &'a Volume<'a>,
    pub on_device: DeviceVolume,
    pub view: wgpu::Buffer,
}

impl<'a> Placed<'a> {
    pub fn new(device: &'a Device, volume: &'a Volume<'a>, camera: &'a Camera) -> Self {
        let on_device = DeviceVolume::new(device, volume, &|| false).unwrap();
        on_device.place(device, volume, camera);
        let view = device.uniform::<View>("view");
        device.write(&view, &[View::new(camera)]);
        Self { device, camera, volume, on_device, view }
    }

    pub fn pixels(&self) -> usize {
        self.camera.size()[0] * self.camera.size()[1]
    }

    /// An image of these numbers.
    pub fn image(&self, numbers: &[f32]) -> wgpu::Buffer {
        let image = self.device.image("image", numbers.len(), 4);
        self.device.write(&image, numbers);
        image
    }
}

/// Runs a recording and gives an image of it.
pub fn finish<T: bytemuck::Pod>(mut recording: Recording, image: &wgpu::Buffer) -> Vec<T> {
    recording.read(image, image.size());
    let results = pollster::block_on(recording.finish(&|| false)).unwrap();
    bytemuck::pod_collect_to_vec(&results.bytes[0])
}
