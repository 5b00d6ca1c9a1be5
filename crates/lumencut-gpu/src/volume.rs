//! A volume on the GPU: its voxels as an integer texture, its blocks, and its grid in a view.

use std::sync::OnceLock;

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::math::blocks::HUGE;
use lumencut_core::math::ray_lines::{IndexFromView, PARALLEL};
use lumencut_core::scene::SharedVolume;
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::volume::{Real, Volume, Voxel, Voxels};
use lumencut_core::with_voxels;
use rayon::prelude::*;
use wgpu::{Extent3d, Origin3d, Texture, TextureFormat, TextureView};

use crate::blocks::DeviceBlocks;
use crate::device::Device;
use crate::view::{power_above, split};

/// Floats whose absolute value exceeds this count as missing.
const LARGEST_FLOAT: f32 = 1e30;
/// The largest number of bytes gathered for one transfer.
const SLAB_BYTES: usize = 64 << 20;
/// The binary digits of an `f32`.
const DIGITS: i32 = 24;

/// Has the layout of `GridParameters` in `math/sampling.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct GridParameters {
    pub last: [f32; 3],
    pub shift: f32,
    pub low: [i32; 3],
    pub depth: f32,
    pub unit: f32,
    pub per_unit: f32,
    pub padding: [f32; 2],
    pub origin: [f32; 4],
    pub origin_rest: [f32; 4],
    pub x: [f32; 4],
    pub x_rest: [f32; 4],
    pub y: [f32; 4],
    pub y_rest: [f32; 4],
    pub z: [f32; 4],
    pub z_rest: [f32; 4],
    pub per_voxel: [f32; 4],
    pub right: [f32; 4],
    pub up: [f32; 4],
}

impl GridParameters {
    /// The grid of `volume` in the view of `camera`; its voxels are stored with `shift` subtracted.
    pub(crate) fn new(volume: &Volume, camera: &Camera, shift: f32) -> Self {
        let to = IndexFromView::new(volume, camera);
        let [width, height] = camera.size().map(|n| n as f64);
        let (x, y) = (to.x * camera.pixel_spacing(), to.y * camera.pixel_spacing());
        let last = volume.size().map(|n| (n - 1) as f64);
        let middle = volume.world_from_index().transform_point3(DVec3::from(last) / 2.0);
        let depth = camera.view_from_world(middle).z.round();
        let origin = to.origin + to.z * depth;
        // A float holds multiples of half `index_unit` exactly, up to `reach`.
        let reach = (origin.abs() + x.abs() * (width / 2.0) + y.abs() * (height / 2.0)).max_element();
        let index_unit = power_above(reach) * 2f64.powi(1 - DIGITS);
        let unit = power_above(volume.longest_way()) * 2f64.powi(1 - DIGITS / 2);
        let (origin, origin_rest) = multiples(origin, index_unit);
        let (x, x_rest) = multiples(x, index_unit);
        let (y, y_rest) = multiples(y, index_unit);
        let z = to.z.to_array().map(|z| split(z, DIGITS / 2));
        let per_voxel = to.z.to_array().map(|z| if z.abs() < PARALLEL { 0.0 } else { (1.0 / z) as f32 });
        Self {
            depth: depth as f32,
            unit: unit as f32,
            per_unit: (1.0 / unit) as f32,
            origin,
            origin_rest,
            x,
            x_rest,
            y,
            y_rest,
            z: four(z.map(|z| z[0])),
            z_rest: four(z.map(|z| z[1])),
            per_voxel: four(per_voxel),
            right: four(to.x.as_vec3().to_array()),
            up: four(to.y.as_vec3().to_array()),
            ..Self::without_view(volume, shift)
        }
    }

    /// The grid of `volume` without a view, for positions that are already indices.
    pub(crate) fn without_view(volume: &Volume, shift: f32) -> Self {
        Self {
            last: volume.size().map(|n| (n - 1) as f32),
            shift,
            low: volume.size().map(|n| n.saturating_sub(2) as i32),
            ..Self::zeroed()
        }
    }
}

fn multiples(vector: DVec3, unit: f64) -> ([f32; 4], [f32; 4]) {
    let coarse = (vector / unit).round() * unit;
    (four(coarse.as_vec3().to_array()), four((vector - coarse).as_vec3().to_array()))
}

fn four([a, b, c]: [f32; 3]) -> [f32; 4] {
    [a, b, c, 0.0]
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Texel {
    Byte,
    Short,
    /// Floats, stored as their bits.
    Float,
}

impl Texel {
    fn of(voxels: Voxels) -> Self {
        match voxels {
            #[cfg(not(target_arch = "wasm32"))]
            Voxels::I8(_) => Self::Byte,
            Voxels::U8(_) => Self::Byte,
            Voxels::I16(_) | Voxels::U16(_) => Self::Short,
            _ => Self::Float,
        }
    }

    fn bytes(self) -> usize {
        match self {
            Self::Byte => 1,
            Self::Short => 2,
            Self::Float => 4,
        }
    }

    fn format(self) -> TextureFormat {
        match self {
            Self::Byte => TextureFormat::R8Sint,
            Self::Short => TextureFormat::R16Sint,
            Self::Float => TextureFormat::R32Sint,
        }
    }
}

/// A volume that stays on the GPU, for all renderers of its scenes.
#[derive(Debug)]
pub(crate) struct DeviceVolume {
    texel: Texel,
    shift: f32,
    pub voxels: TextureView,
    blocks: OnceLock<DeviceBlocks>,
}

impl DeviceVolume {
    /// Sends the voxels of `volume` to the GPU.
    pub(crate) fn new(device: &Device, volume: &Volume, stop: Stop) -> Result<Self> {
        let (texel, size) = (Texel::of(volume.voxels()), volume.size());
        let side = device.limits.max_texture_dimension_3d;
        if size.iter().any(|n| *n > side as usize) {
            let found = format!("{} × {} × {} voxels", size[0], size[1], size[2]);
            return Err(device.too_large("size of the volume", found, &format!("{side} along each side")));
        }
        let texture = device.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("volume"),
            size: extent(size),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D3,
            format: texel.format(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        device.check()?;
        send(device, &texture, texel, volume, stop)?;
        let shift = match volume.voxels() {
            Voxels::U8(_) => 128.0,
            Voxels::U16(_) => 32_768.0,
            _ => 0.0,
        };
        let voxels = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Self { texel, shift, voxels, blocks: OnceLock::new() })
    }

    pub(crate) fn is_float(&self) -> bool {
        self.texel == Texel::Float
    }

    pub(crate) fn grid(&self, volume: &Volume, camera: Option<&Camera>) -> GridParameters {
        camera.map_or_else(
            || GridParameters::without_view(volume, self.shift),
            |camera| GridParameters::new(volume, camera, self.shift),
        )
    }

    /// The blocks of `shared`, which must be this volume; made and sent at the first call.
    pub(crate) fn blocks(&self, device: &Device, shared: &SharedVolume, stop: Stop) -> Result<&DeviceBlocks> {
        if let Some(blocks) = self.blocks.get() {
            return Ok(blocks);
        }
        let blocks = DeviceBlocks::new(device, shared.blocks(stop)?)?;
        Ok(self.blocks.get_or_init(|| blocks))
    }
}

fn extent(size: [usize; 3]) -> Extent3d {
    let [width, height, depth_or_array_layers] = size.map(|n| n as u32);
    Extent3d { width, height, depth_or_array_layers }
}

/// Sends the voxels slab by slab, so that memory never holds a second copy of the volume.
fn send(device: &Device, texture: &Texture, texel: Texel, volume: &Volume, stop: Stop) -> Result<()> {
    let [ni, nj, nk] = volume.size();
    let slice = ni * nj * texel.bytes();
    let slices = (SLAB_BYTES / slice).clamp(1, nk);
    let mut bytes = vec![0u8; slices * slice];
    for first in (0..nk).step_by(slices) {
        go_on(stop)?;
        let count = slices.min(nk - first);
        let bytes = &mut bytes[..count * slice];
        match volume.voxels() {
            #[cfg(not(target_arch = "wasm32"))]
            Voxels::I8(voxels) => gather(volume, voxels, first, bytes, |v| v),
            Voxels::U8(voxels) => gather(volume, voxels, first, bytes, |v| (v ^ 0x80) as i8),
            Voxels::I16(voxels) => gather(volume, voxels, first, bytes, |v| v),
            Voxels::U16(voxels) => gather(volume, voxels, first, bytes, |v| (v ^ 0x8000) as i16),
            other => with_voxels!(other, voxels => gather(volume, voxels, first, bytes, |v| {
                let value = v.real().to_f32();
                // This comparison is also false for NaN.
                if value.abs() <= LARGEST_FLOAT { value } else { HUGE }
            })),
        }
        let mut copy = texture.as_image_copy();
        copy.origin = Origin3d { x: 0, y: 0, z: first as u32 };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some((ni * texel.bytes()) as u32),
            rows_per_image: Some(nj as u32),
        };
        device.queue.write_texture(copy, bytes, layout, extent([ni, nj, count]));
        // Without a submission, written data would stay in memory.
        device.queue.submit([]);
        device.check()?;
    }
    Ok(())
}

/// Gathers slices from `first` on, i fastest, in the form in which the GPU stores them.
fn gather<T: Voxel, S: Pod + Send>(
    volume: &Volume,
    voxels: &[T],
    first: usize,
    bytes: &mut [u8],
    store: impl Fn(T) -> S + Sync,
) {
    let ([ni, nj, _], strides) = (volume.size(), volume.strides());
    bytes.par_chunks_mut(ni * size_of::<S>()).enumerate().for_each(|(row, bytes)| {
        let line = &voxels[row % nj * strides[1] + (first + row / nj) * strides[2]..];
        let stored = bytes.chunks_exact_mut(size_of::<S>());
        for (stored, voxel) in stored.zip(line.iter().step_by(strides[0].max(1))) {
            stored.copy_from_slice(bytemuck::bytes_of(&store(*voxel)));
        }
    });
}
