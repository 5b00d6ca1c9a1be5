//! Largest, smallest and mean values along rays, compared with an independent computation in f64: cubics
//! through four samples, between the sorted crossings of a ray with the planes of the grid.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::math::blocks::{Blocks, HUGE};
use lumencut_core::math::lanes::Isa;
use lumencut_core::math::ray_lines::{IndexFromView, RayGrid};
use lumencut_core::math::reduce::Reduction;
use lumencut_core::stages::Work;
use lumencut_core::stages::along_rays::{AlongRays, ViewRays, along_rays};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::views::view;
use lumencut_scenes::volumes::{ball_and_rod, sheared, volume};

const SIZE: [usize; 3] = [41, 37, 29];

/// The voxels as numbers, i fastest, and their grid.
struct Exact {
    values: Vec<f64>,
    size: [usize; 3],
    index_from_world: DAffine3,
}

impl Exact {
    fn at(&self, index: DVec3) -> f64 {
        let (mut cell, mut weight) = ([0; 3], [0.0; 3]);
        for a in 0..3 {
            let c = index[a].clamp(0.0, (self.size[a] - 1) as f64);
            cell[a] = (c as usize).min(self.size[a].saturating_sub(2));
            weight[a] = c - cell[a] as f64;
        }
        let mut sum = 0.0;
        for n in 0..8 {
            let (mut place, mut share, mut stride) = (0, 1.0, 1);
            for a in 0..3 {
                let far = n >> a & 1;
                place += (cell[a] + far).min(self.size[a] - 1) * stride;
                share *= if far == 1 { weight[a] } else { 1.0 - weight[a] };
                stride *= self.size[a];
            }
            sum += share * self.values[place];
        }
        sum
    }

    /// Smallest, largest and mean value between two depths of a ray; `None` if it misses the volume.
    fn along(&self, origin: DVec3, direction: DVec3, chord: [f64; 2]) -> Option<[f64; 3]> {
        let (from, toward) = (
            self.index_from_world.transform_point3(origin),
            self.index_from_world.transform_vector3(direction),
        );
        let [mut near, mut far] = chord;
        let mut depths = Vec::new();
        for a in 0..3 {
            let last = (self.size[a] - 1) as f64;
            if toward[a].abs() < 1e-9 {
                if from[a] < -0.5 || from[a] > last + 0.5 {
                    return None;
                }
                continue;
            }
            let ends = [-0.5, last + 0.5].map(|plane| (plane - from[a]) / toward[a]);
            near = near.max(ends[0].min(ends[1]));
            far = far.min(ends[0].max(ends[1]));
            depths.extend((0..self.size[a]).map(|n| (n as f64 - from[a]) / toward[a]));
        }
        if near >= far {
            return None;
        }
        depths.retain(|depth| *depth > near && *depth < far);
        depths.extend([near, far]);
        depths.sort_by(f64::total_cmp);
        let at = |depth: f64| self.at(from + toward * depth);
        let (mut low, mut high, mut sum) = (f64::MAX, f64::MIN, 0.0);
        for pair in depths.windows(2) {
            let length = pair[1] - pair[0];
            let f = [0.0, 1.0, 2.0, 3.0].map(|n| at(pair[0] + length * n / 3.0));
            // The cubic a·u³ + b·u² + c·u + d through four equidistant samples.
            let a = 4.5 * (f[3] - 3.0 * f[2] + 3.0 * f[1] - f[0]);
            let b = 9.0 * f[0] - 22.5 * f[1] + 18.0 * f[2] - 4.5 * f[3];
            let c = -5.5 * f[0] + 9.0 * f[1] - 4.5 * f[2] + f[3];
            let root = (b * b - 3.0 * a * c).max(0.0).sqrt();
            let mut places = vec![0.0, 1.0];
            places.extend([(-b - root) / (3.0 * a), (-b + root) / (3.0 * a), -c / (2.0 * b)]);
            for u in places {
                if (0.0..=1.0).contains(&u) {
                    let value = at(pair[0] + length * u);
                    (low, high) = (low.min(value), high.max(value));
                }
            }
            sum += length * (f[0] + 3.0 * f[1] + 3.0 * f[2] + f[3]) / 8.0;
        }
        Some([low, high, sum / (far - near)])
    }
}

fn reduced(
    volume: &Volume,
    camera: &Camera,
    reduction: Reduction,
    blocks: Option<&Blocks>,
    isa: Isa,
    chord: &(dyn Fn(usize) -> [f64; 2] + Sync),
) -> Vec<f32> {
    let work = Work { size: camera.size(), isa, stop: &|| false, progress: None };
    let limit = if reduction == Reduction::Smallest { -HUGE } else { HUGE };
    let to = IndexFromView::new(volume, camera);
    let along = AlongRays { size: work.size, volume, blocks, reduction, limit, step: to.voxel() };
    let source = ViewRays { to, rays: RayGrid::fine(camera), chord };
    let mut values = vec![0.0; work.size[0] * work.size[1]];
    along_rays(&work, &along, &source, &mut values).unwrap();
    values
}

fn cameras() -> Vec<Camera> {
    vec![
        view([0.0, 1.0, 0.0], [67, 45], 0.7),
        view([0.5, -0.6, 0.4], [64, 33], 0.9),
        view([0.0, 0.0, 1.0], [40, 40], 1.3),
        view([0.3, 1.0, -0.4], [11, 9], 9.0),
        view([-0.4, 0.2, 0.9], [50, 40], 0.04),
    ]
}

/// Depth ranges through the volume, partly inside it, short, and empty.
fn chord(p: usize) -> [f64; 2] {
    let depth = (p % 37) as f64 - 18.0;
    match p % 6 {
        0 => [1.0, -1.0],
        1 => [depth, 1e9],
        2 => [-1e9, depth],
        3 => [depth, depth + 0.3],
        4 => [depth, depth + 5.0],
        _ => [-1e9, 1e9],
    }
}

const REDUCTIONS: [Reduction; 3] = [Reduction::Smallest, Reduction::Largest, Reduction::Mean];

fn assert_exact(volume: &Volume, exact: &Exact, camera: &Camera, tolerance: f64) {
    let blocks = Blocks::new(volume, &|| false).unwrap();
    for (n, reduction) in REDUCTIONS.into_iter().enumerate() {
        let found = reduced(volume, camera, reduction, Some(&blocks), Isa::widest(), &chord);
        let (mut met, width) = (0, camera.size()[0]);
        for (p, found) in found.iter().enumerate() {
            let (x, y) = (camera.view_x(p % width), camera.view_y(p / width));
            let origin = camera.world_from_view(DVec3::new(x, y, 0.0));
            let [near, far] = chord(p);
            let expected =
                if near > far { None } else { exact.along(origin, camera.direction(), [near, far]) };
            match expected {
                Some(expected) => {
                    met += 1;
                    let difference = (f64::from(*found) - expected[n]).abs();
                    assert!(
                        difference <= tolerance,
                        "{reduction:?} of pixel {p}: {found} for {}",
                        expected[n]
                    );
                }
                None => assert!(found.is_nan(), "{reduction:?} of pixel {p}: {found} for none"),
            }
        }
        assert!(met > found.len() / 20, "{met} of {} rays meet the volume", found.len());
    }
}

#[test]
fn every_value_is_that_of_an_independent_computation() {
    let voxels = ball_and_rod(SIZE);
    let values = voxels.iter().map(|v| f64::from(*v)).collect();
    let volume = volume(Voxels::I16(&voxels), SIZE, sheared(SIZE));
    let exact = Exact { values, size: SIZE, index_from_world: volume.index_from_world() };
    for camera in cameras() {
        // Values are up to 1000.
        assert_exact(&volume, &exact, &camera, 0.02);
    }
}

#[test]
fn flat_volumes_and_rays_along_faces_have_exact_values() {
    // Rays exactly along voxel centres and along the faces between them.
    for size in [[1, 1, 1], [2, 1, 3], [1, 6, 5], [9, 2, 4], [5, 4, 8]] {
        let voxels: Vec<i16> = (0..size.iter().product()).map(|n| (n * 7919 % 1001) as i16).collect();
        let last = DVec3::from(size.map(|n: usize| (n - 1) as f64));
        let volume = volume(Voxels::I16(&voxels), size, DAffine3::from_translation(-last / 2.0));
        let values = voxels.iter().map(|v| f64::from(*v)).collect();
        let exact = Exact { values, size, index_from_world: volume.index_from_world() };
        for toward in [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]] {
            let blocks = Blocks::new(&volume, &|| false).unwrap();
            let camera = view(toward, [33, 33], 0.25);
            for (n, reduction) in REDUCTIONS.into_iter().enumerate() {
                let whole = |_: usize| [-1e9, 1e9];
                let found = reduced(&volume, &camera, reduction, Some(&blocks), Isa::widest(), &whole);
                for (p, found) in found.iter().enumerate() {
                    let (x, y) = (camera.view_x(p % 33), camera.view_y(p / 33));
                    let origin = camera.world_from_view(DVec3::new(x, y, 0.0));
                    let Some(expected) = exact.along(origin, camera.direction(), whole(p)) else {
                        // Exactly on the border of the volume, rounding decides.
                        continue;
                    };
                    let difference = (f64::from(*found) - expected[n]).abs();
                    assert!(
                        difference <= 0.02,
                        "{size:?} {toward:?} {reduction:?} pixel {p}: {found}, {expected:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn neither_blocks_nor_instruction_sets_nor_threads_change_a_bit() {
    let integers = ball_and_rod(SIZE);
    let mut floats: Vec<f32> = integers.iter().map(|v| f32::from(*v)).collect();
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30];
    for n in (0..floats.len()).step_by(977) {
        floats[n] = odd[n % odd.len()];
    }
    floats[..2000].fill(f32::NAN);
    let doubles: Vec<f64> = integers.iter().map(|v| f64::from(*v) / 3.0).collect();
    for voxels in [Voxels::I16(&integers), Voxels::F32(&floats), Voxels::F64(&doubles)] {
        let volume = volume(voxels, SIZE, sheared(SIZE));
        let blocks = Blocks::new(&volume, &|| false).unwrap();
        for camera in cameras() {
            for reduction in REDUCTIONS {
                let run = |blocks, isa| {
                    let values = reduced(&volume, &camera, reduction, blocks, isa, &chord);
                    values.into_iter().map(f32::to_bits).collect::<Vec<_>>()
                };
                let whole = run(None, Isa::widest());
                for isa in Isa::available() {
                    assert!(run(Some(&blocks), isa) == whole, "{reduction:?} {isa:?}");
                }
                let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
                assert!(alone.install(|| run(Some(&blocks), Isa::widest())) == whole, "{reduction:?}");
            }
        }
    }
}

#[test]
fn a_cell_without_a_number_is_left_out() {
    let mut floats = vec![1.0f32; 5 * 5 * 5];
    floats[2 + 5 * 2 + 25 * 2] = f32::NAN;
    floats[2 + 5 * 2 + 25 * 4] = 3.0;
    let volume = volume(Voxels::F32(&floats), [5; 3], DAffine3::from_translation(DVec3::splat(-2.0)));
    let camera = view([0.0, 0.0, 1.0], [3, 3], 0.2);
    let whole = |_: usize| [-1e9, 1e9];
    let run = |reduction| reduced(&volume, &camera, reduction, None, Isa::widest(), &whole)[4];
    assert_eq!(run(Reduction::Largest), 3.0);
    assert_eq!(run(Reduction::Smallest), 1.0);
    // Along k: half a voxel of 1, one of 1, two of NaN, one that rises from 1 to 3, half a voxel of 3.
    let mean = (0.5 + 1.0 + 2.0 + 1.5) / 3.0;
    assert!((f64::from(run(Reduction::Mean)) - mean).abs() < 1e-5, "{}", run(Reduction::Mean));
}
