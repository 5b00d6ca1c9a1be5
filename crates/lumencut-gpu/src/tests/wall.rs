//! The walls that rays meet inside a vessel are those of the CPU.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3, Vec3};
use lumencut_core::geometry::Rays;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::math::lanes::Isa;
use lumencut_core::math::sampling::Grid;
use lumencut_core::math::tube::Tube;
use lumencut_core::reformations::Wall;
use lumencut_core::reformations::cpr::{Straightened, View};
use lumencut_core::reformations::endoscopy::wall::{Beyond, wall};
use lumencut_core::reformations::endoscopy::{Bounds, tube};
use lumencut_core::stages::Work;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};

use super::device;

const SIDE: usize = 96;
const STEP: f32 = 0.5;
/// Distances may differ by this share of them.
const APART: f32 = 1e-3;

/// A half circle of 30 mm radius whose wall has folds, and is open on one side near its middle.
fn bend() -> (Arc<CenterlinePath>, Tube) {
    let turns = (0..=360).map(|n| PI * f64::from(n) / 360.0);
    let points = turns.map(|t| DVec3::new(t.cos(), 0.0, t.sin()) * 30.0).collect();
    let path = Arc::new(CenterlinePath::new(&Vessel::new(points, None).unwrap(), 0.0).unwrap());
    let view = View { up: DVec3::Z, angle: 0.0, normal: None };
    let straightened = Straightened::new(Arc::clone(&path), &view).unwrap();
    let at: Vec<f64> = (0..=94).map(f64::from).collect();
    let places = at.iter().flat_map(|at| (0..90).map(move |n| (*at, TAU * f64::from(n) / 90.0)));
    let radius = |(at, around): (f64, f64)| 6.0 + (0.5 * at).sin() + 0.5 * (3.0 * around).cos();
    let wall = Wall::new(
        at.clone(),
        places.clone().map(radius).collect(),
        places.map(|(at, around)| (at - 40.0).abs() < 5.0 && around < 1.5).collect(),
    );
    let bounds = Bounds { level: 150.0, calcium: 600.0, is_bright: true };
    let made = tube(&straightened, &wall.unwrap(), |_| bounds);
    (path, made)
}

/// Rays in all directions; some end soon.
fn rays(eye: DVec3, size: [usize; 2]) -> Rays {
    let count = size[0] * size[1];
    let direction = |n: usize| {
        let z = 1.0 - 2.0 * (n as f32 + 0.5) / count as f32;
        let (sine, cosine) = (n as f32 * 2.4).sin_cos();
        let flat = (1.0 - z * z).sqrt();
        Vec3::new(flat * cosine, flat * sine, z)
    };
    let span = |n: usize| [1.5, if n.is_multiple_of(7) { 9.0 } else { 150.0 }];
    Rays::new(size, eye, (0..count).map(direction).collect(), (0..count).map(span).collect()).unwrap()
}

#[test]
fn distances_are_those_of_the_cpu() {
    let Some(device) = device() else { return };
    let (path, tube) = bend();
    let values: Vec<f32> = (0..SIDE * SIDE * SIDE).map(|n| ((n * 7919) % 211) as f32 + 100.0).collect();
    let shorts: Vec<i16> = values.iter().map(|value| *value as i16).collect();
    let affine = DAffine3::from_mat3_translation(DMat3::IDENTITY, DVec3::new(-48.0, -48.0, -30.0));
    for voxels in [Voxels::F32(&values), Voxels::I16(&shorts)] {
        let volume = Volume::new(voxels, [SIDE; 3], [1, SIDE, SIDE * SIDE], affine).unwrap();
        let (grid, to) = (Grid::new(&volume), volume.index_from_world());
        let read = |point| grid.trilinear_single(&values, to.transform_point3(point));
        for (at, size) in [(20.0, [67, 43]), (47.0, [64, 64]), (90.0, [1, 17])] {
            let (rays, near) = (rays(path.at(at), size), tube.row_at(at));
            let work = Work { size, isa: Isa::widest(), stop: &|| false, progress: None };
            let beyond = Beyond { value: &read, step: STEP };
            let expected = wall(&work, &rays, (&tube, near), &beyond).unwrap();
            let found = crate::wall::wall(device, &volume, &rays, (&tube, near, STEP), &|| false);
            let found = pollster::block_on(found).unwrap();
            let differs = |(a, b): (&f32, &f32)| a.is_nan() != b.is_nan() || (a - b).abs() > APART * b.abs();
            let apart = found.iter().zip(&expected).filter(|(a, b)| differs((a, b))).count();
            // At folds and in noise a ray may miss a wall that it touches.
            assert!(apart * 200 <= found.len(), "at {at}: {apart} of {} rays", found.len());
            assert!(expected.iter().any(|away| *away < 0.0) || size[0] == 1);
        }
    }
}
