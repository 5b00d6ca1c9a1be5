//! Finds the walls that rays by pixel meet, on the GPU.

use bytemuck::{Pod, Zeroable};
use lumencut_core::error::Result;
use lumencut_core::geometry::Rays;
use lumencut_core::math::blocks::HUGE;
use lumencut_core::math::tube::Tube;
use lumencut_core::reformations::endoscopy::wall::WallParameters;
use lumencut_core::stop::Stop;
use lumencut_core::volume::Volume;
use wgpu::BindingResource;

use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;
use crate::volume::{DeviceVolume, GridParameters};

/// Has the layout of `WallRay` in `reformations/endoscopy/wall.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct WallRay {
    pub direction: [f32; 3],
    pub start: f32,
    pub end: f32,
    pub padding_0: f32,
    pub padding_1: f32,
    pub padding_2: f32,
}

/// As `reformations::endoscopy::wall::wall` of the core, with samples `step` mm apart in `volume` beyond openings.
pub async fn wall(
    device: &Device,
    volume: &Volume<'_>,
    rays: &Rays,
    (tube, near, step): (&Tube, usize, f32),
    stop: Stop<'_>,
) -> Result<Vec<f32>> {
    let on_device = DeviceVolume::new(device, volume, stop)?;
    let grid = device.uniform::<GridParameters>("grid");
    device.write(&grid, &[on_device.grid(volume, None)]);
    let parameters = device.uniform::<WallParameters>("wall parameters");
    device.write(&parameters, &[WallParameters::new(rays, (tube, near), volume, step)]);
    let (rows, radius) = tube.tables();
    let rows = device.upload("rows of the tube", rows);
    let radius = device.upload("radii of the tube", radius);
    let sent = device.upload("rays", &sent(rays));
    let image = device.image("wall", rays.direction().len(), 4);
    let resources = [
        parameters.as_entire_binding(),
        grid.as_entire_binding(),
        BindingResource::TextureView(&on_device.voxels),
        rows.as_entire_binding(),
        radius.as_entire_binding(),
        sent.as_entire_binding(),
        image.as_entire_binding(),
    ];
    let constants = [("FLOAT_VOXELS", f64::from(u8::from(on_device.is_float())))];
    let stage = Stage::new(device, "reformations/endoscopy/wall", &constants).with_first_binding(1);
    let mut recording = Recording::new(device);
    recording.run(&stage, &resources, groups(rays.size(), [8, 8]));
    recording.read(&image, image.size());
    let found: Vec<f32> = recording.finish(stop).await?.numbers(0);
    Ok(found.into_iter().map(|away| if away >= HUGE { f32::NAN } else { away }).collect())
}

fn sent(rays: &Rays) -> Vec<WallRay> {
    let ray = |(direction, [start, end]): (&glam::Vec3, &[f32; 2])| WallRay {
        direction: direction.to_array(),
        start: *start,
        end: *end,
        ..WallRay::zeroed()
    };
    rays.direction().iter().zip(rays.span()).map(ray).collect()
}
