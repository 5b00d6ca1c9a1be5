//! The values at the cut surface equal those of the CPU.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::geometry::{Curved, Geometry};
use lumencut_core::math::blocks::{Blocks, HUGE};
use lumencut_core::settings::{Settings, Slab, SlabMode};
use lumencut_core::stages::surface::{SurfaceScene, surface};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::trefoil;
use lumencut_scenes::brute_force::by_hierarchy;
use lumencut_scenes::tolerances::SURFACE;
use lumencut_scenes::views::{on_cpu, view_beside_voxels};
use lumencut_scenes::volumes::{ball_and_rod, sheared, volume};

use super::device;
use super::placed::{Placed, finish};
use crate::recording::Recording;
use crate::surface::{Surface, SurfaceImages};

const SLABS: [Option<Slab>; 5] = [
    None,
    Some(Slab { thickness: 0.0, mode: SlabMode::Max }),
    Some(Slab { thickness: 3.3, mode: SlabMode::Max }),
    Some(Slab { thickness: 7.0, mode: SlabMode::Mean }),
    Some(Slab { thickness: 200.0, mode: SlabMode::Min }),
];

/// Depths around the middle of the volume, and some far away.
fn depths(camera: &Camera, volume: &Volume) -> Vec<f32> {
    let reach = volume.longest_way();
    let depth = |p: usize| match p % 97 {
        0 => -1e5,
        1 => 4e5,
        _ => (((p * 7919 % 1009) as f64 / 1009.0 - 0.5) * 0.9 * reach) as f32,
    };
    (0..camera.size()[0] * camera.size()[1]).map(depth).collect()
}

fn on_gpu(stage: &mut Surface, placed: &Placed, slab: Option<Slab>, geometry: &Geometry) -> Vec<f32> {
    let mut recording = Recording::new(placed.device);
    let value = placed.device.image("value", placed.pixels(), 4);
    let depth = placed.device.image("depth", placed.pixels(), 4);
    placed.device.write(&depth, geometry.depth());
    let images = SurfaceImages { size: placed.camera.size(), geometry, depth: &depth, value: &value };
    let volume = (&placed.on_device, placed.volume);
    stage.record(&mut recording, [&placed.view, &placed.grid], volume, slab, images).unwrap();
    finish(recording, &value)
}

/// The positions at these depths on the rays of a camera, as a curved geometry.
fn curved(camera: &Camera, depth: &[f32]) -> Geometry {
    let [width, height] = camera.size();
    let place = |p: usize| {
        let (x, y) = (camera.view_x(p % width), camera.view_y(p / width));
        camera.world_from_view(DVec3::new(x, y, f64::from(depth[p])))
    };
    let directions = vec![camera.direction().as_vec3(); depth.len()];
    Geometry::Curved(Curved::new([width, height], (0..depth.len()).map(place).collect(), directions).unwrap())
}

/// Compares the values; `contrast` is the difference between a volume's extremes.
fn compare(
    volume: &Volume,
    camera: &Camera,
    slabs: &[Option<Slab>],
    depth: &[f32],
    contrast: f32,
    what: &str,
) {
    let Some(device) = device() else { return };
    let placed = Placed::new(device, volume, camera);
    let orthographic = Geometry::Orthographic { camera: *camera, depth: depth.to_vec() };
    let geometries = [orthographic, curved(camera, depth)];
    let mut stage = Surface::new(device);
    let blocks = Blocks::new(volume, &|| false).unwrap();
    let mut most = 0.0f32;
    for (&slab, geometry) in slabs.iter().flat_map(|slab| geometries.iter().map(move |g| (slab, g))) {
        let mut expected = vec![0.0; depth.len()];
        let scene = SurfaceScene { geometry, volume, blocks: Some(&blocks), slab };
        surface(&on_cpu(camera), &scene, &mut expected).unwrap();
        let found = on_gpu(&mut stage, &placed, slab, geometry);
        let mut elsewhere = 0;
        for (found, expected) in found.iter().zip(&expected) {
            assert!(found.is_finite(), "{what}, {slab:?}: {found}");
            if (*found >= HUGE) != expected.is_nan() {
                elsewhere += 1;
            } else if *found < HUGE {
                most = most.max((found - expected).abs() / contrast);
            }
        }
        assert!(
            SURFACE.allows(elsewhere, depth.len()),
            "{what}, {slab:?}: {elsewhere} pixels are outside on one only"
        );
        assert!(most <= SURFACE.apart, "{what}, {slab:?}: {most} of the contrast");
    }
}

fn views() -> Vec<Camera> {
    vec![
        view_beside_voxels([0.0, 1.0, 0.0], [257, 257], 0.2),
        view_beside_voxels([0.5, -0.6, 0.4], [33, 20], 1.3),
        view_beside_voxels([0.0, 0.0, -1.0], [1, 17], 2.1),
        view_beside_voxels([-1.0, 0.2, 0.1], [64, 49], 0.9),
    ]
}

#[test]
fn values_are_those_of_the_cpu() {
    const SIZE: [usize; 3] = [41, 37, 29];
    let shorts = ball_and_rod(SIZE);
    let bytes: Vec<u8> = shorts.iter().map(|v| (v / 4) as u8).collect();
    let signed: Vec<i8> = bytes.iter().map(|v| (i16::from(*v) - 128) as i8).collect();
    let unsigned: Vec<u16> = shorts.iter().map(|v| *v as u16 * 60).collect();
    let longs: Vec<i64> = shorts.iter().map(|v| i64::from(*v) - 300).collect();
    let mut floats: Vec<f32> = shorts.iter().map(|v| f32::from(*v) / 3.0).collect();
    for n in (0..floats.len()).step_by(977) {
        floats[n] = f32::NAN;
    }
    let doubles: Vec<f64> = shorts.iter().map(|v| f64::from(*v) * 1e-9).collect();
    let all = [
        (Voxels::I16(&shorts), 960.0),
        (Voxels::U8(&bytes), 240.0),
        (Voxels::I8(&signed), 240.0),
        (Voxels::U16(&unsigned), 57_600.0),
        (Voxels::I64(&longs), 960.0),
        (Voxels::F32(&floats), 320.0),
        (Voxels::F64(&doubles), 960e-9),
    ];
    for (n, (voxels, contrast)) in all.into_iter().enumerate() {
        let volume = volume(voxels, SIZE, sheared(SIZE));
        for camera in views() {
            let what = format!("type {n} in {:?} along {}", camera.size(), camera.direction());
            compare(&volume, &camera, &SLABS, &depths(&camera, &volume), contrast, &what);
        }
    }
}

#[test]
fn axes_of_one_voxel_and_any_strides() {
    let voxels = ball_and_rod([40, 30, 20]);
    for (size, strides) in [
        ([40, 30, 1], [1, 40, 0]),
        ([1, 30, 20], [0, 40, 1200]),
        ([1, 1, 1], [0; 3]),
        ([20, 30, 40], [1200, 40, 1]),
    ] {
        let volume = Volume::new(Voxels::I16(&voxels), size, strides, sheared(size)).unwrap();
        for camera in views() {
            let depth: Vec<f32> = (0..camera.size()[0] * camera.size()[1])
                .map(|p| (p * 37 % 113) as f32 * 0.02 - 1.1)
                .collect();
            compare(&volume, &camera, &SLABS, &depth, 960.0, &format!("{size:?}"));
        }
    }
}

#[test]
fn a_long_volume_keeps_its_places() {
    // Each value is the index relative to the middle, so it shows errors of positions: at most a 10,000th of a voxel.
    const SIZE: [usize; 3] = [64, 48, 1300];
    let voxels: Vec<i16> = (0..SIZE.iter().product()).map(|n: usize| (n / (64 * 48)) as i16 - 650).collect();
    let middle = DAffine3::from_translation(-DVec3::from(SIZE.map(|n| (n - 1) as f64)) / 2.0);
    let volume = volume(Voxels::I16(&voxels), SIZE, DAffine3::from_scale(DVec3::splat(0.7)) * middle);
    for direction in [[0.02, 0.03, 1.0], [0.3, 1.0, -0.4], [0.0, 1.0, 0.0]] {
        let camera = view_beside_voxels(direction, [131, 1200], 0.8);
        compare(&volume, &camera, &[None], &depths(&camera, &volume), 10.0, "places");
    }
}

#[test]
fn a_cut_surface_is_that_of_the_cpu() {
    let phantom = trefoil().unwrap();
    let camera = view_beside_voxels([0.3, 1.0, -0.2], [257, 257], 0.4);
    let frame = by_hierarchy(&phantom.tree, &camera, &Settings::default());
    compare(&phantom.volume().unwrap(), &camera, &SLABS, frame.depth(), 500.0, "trefoil");
}
