//! Volumes and views that several tests share.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::volume::{Volume, Voxels};

use crate::device::Device;
use crate::recording::Recording;
use crate::view::View;
use crate::volume::DeviceVolume;

/// Voxels that lie i fastest.
pub fn volume(voxels: Voxels<'_>, size: [usize; 3], world_from_index: DAffine3) -> Volume<'_> {
    Volume::new(voxels, size, [1, size[0], size[0] * size[1]], world_from_index).unwrap()
}

/// A sheared, left-handed grid with its middle in the origin.
pub fn sheared(size: [usize; 3]) -> DAffine3 {
    let columns =
        DMat3::from_cols(DVec3::new(0.8, 0.1, 0.0), DVec3::new(0.2, -0.7, 0.1), DVec3::new(0.3, 0.2, 1.9));
    let last = DVec3::from(size.map(|n| (n - 1) as f64));
    DAffine3::from_mat3_translation(columns, -(columns * last / 2.0))
}

/// A bright ball and a bright rod in noise, between 0 and 1000.
pub fn ball_and_rod([ni, nj, nk]: [usize; 3]) -> Vec<i16> {
    let [x, y, z] = [ni, nj, nk].map(|n| n as f64);
    let value = |n: usize| {
        let [i, j, k] = [n % ni, n / ni % nj, n / (ni * nj)].map(|c| c as f64);
        let noise = (n * 7919 % 61) as i16;
        let ball = (i - 0.35 * x).hypot(j - 0.55 * y).hypot(k - 0.4 * z) < 0.2 * x;
        let rod = (i - 0.7 * x).hypot(k - 0.7 * z) < 0.08 * x;
        match (rod, ball) {
            (true, _) => 900 + noise,
            (_, true) => 350 + noise,
            _ => noise,
        }
    };
    (0..ni * nj * nk).map(value).collect()
}

/// A view of the origin.
pub fn camera(direction: [f64; 3], size: [usize; 2], pixel_spacing: f64) -> Camera {
    let direction = DVec3::from_array(direction);
    let up = if direction.cross(DVec3::Z).length() < 1e-3 { DVec3::Y } else { DVec3::Z };
    Camera::new(DVec3::new(0.013, -0.021, 0.017), direction, up, size, pixel_spacing).unwrap()
}

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
