//! The voxels near the plane of a section, projected onto that plane. A straight vessel looks the same everywhere
//! along its axis, so each voxel shows the blurred section at its own position. Values are not interpolated, so the
//! noise of the voxels stays independent.

use glam::DVec2;

use super::SectionPlane;
use super::scale::Scale;
use crate::voxels::Voxels;
use lumencut_core::math::lanes::FAN;

/// Maximum number of voxels near the wall, and of other voxels.
const MAX_VOXELS: [usize; 2] = [448, 160];

#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// Centre of the window in the plane (mm).
    pub center: DVec2,
    /// Radius of the window (mm).
    pub reach: f64,
    /// Approximate radius of the wall, and the distance from it within which voxels are near the wall (mm).
    pub wall: [f64; 2],
}

/// Voxels in groups of sixteen; the last group is filled up with voxels of weight 0.
#[derive(Clone, Debug, Default)]
pub(crate) struct Samples {
    /// Position of each voxel within the plane (mm).
    pub x: Vec<[f32; FAN]>,
    pub y: Vec<[f32; FAN]>,
    pub share: Vec<[f32; FAN]>,
    /// Weight of each voxel, which falls linearly with its distance from the plane.
    pub weight: Vec<[f32; FAN]>,
    /// Index of each voxel relative to the first voxel of the window.
    pub voxel: Vec<[[i16; 3]; FAN]>,
    pub count: usize,
}

#[derive(Clone, Copy, Default)]
struct Sample {
    numbers: [f32; 4],
    voxel: [i16; 3],
    /// A pseudo-random number of the voxel, which is the same in every window.
    key: u32,
}

impl Samples {
    pub(crate) fn gather(
        voxels: &Voxels,
        scale: &Scale,
        place: &SectionPlane,
        window: &Window,
        keep: impl Fn(DVec2) -> bool,
    ) -> Self {
        let mut found: [Vec<Sample>; 2] = [Vec::new(), Vec::new()];
        let thickness = thickness(voxels, place);
        let middle = place.point(window.center);
        let (first, count) = voxels.around(middle, window.reach.hypot(thickness));
        let side = voxels.world_from_index.matrix3.x_axis;
        let [dx, dy, dz] = place.coordinates(side);
        for k in 0..count[2] {
            for j in 0..count[1] {
                let row = voxels.center([first[0], first[1] + j, first[2] + k]);
                let [x, y, z] = place.coordinates(row - place.origin);
                let Some((low, high)) = within(z, dz, thickness, count[0]) else { continue };
                for i in low..=high {
                    let n = f64::from(i);
                    let point = DVec2::new(x + n * dx, y + n * dy);
                    let length = point.distance(window.center);
                    if length > window.reach || !keep(point) {
                        continue;
                    }
                    let weight = 1.0 - (z + n * dz).abs() / thickness;
                    let value = voxels.voxel([first[0] + i, first[1] + j, first[2] + k]);
                    let share = scale.share(f64::from(value));
                    let is_near = (length - window.wall[0]).abs() <= window.wall[1];
                    let sample = Sample {
                        numbers: [point.x as f32, point.y as f32, share as f32, weight as f32],
                        voxel: [i, j, k].map(|n| n as i16),
                        key: key([first[0] + i, first[1] + j, first[2] + k]),
                    };
                    if weight > 0.0 && share.is_finite() {
                        found[usize::from(!is_near)].push(sample);
                    }
                }
            }
        }
        Self::new(found)
    }

    fn new([near, far]: [Vec<Sample>; 2]) -> Self {
        let mut all = thinned(near, MAX_VOXELS[0]);
        all.append(&mut thinned(far, MAX_VOXELS[1]));
        let count = all.len();
        all.resize(count.next_multiple_of(FAN), Sample::default());
        let column = |part: usize| {
            all.chunks_exact(FAN).map(|c| std::array::from_fn(|l| c[l].numbers[part])).collect()
        };
        let voxel = all.chunks_exact(FAN).map(|c| std::array::from_fn(|l| c[l].voxel)).collect();
        Self { x: column(0), y: column(1), share: column(2), weight: column(3), voxel, count }
    }
}

/// Maximum distance of voxels from the plane (mm): as far as linear interpolation would use voxels.
pub(crate) fn thickness(voxels: &Voxels, place: &SectionPlane) -> f64 {
    let sides = voxels.world_from_index.matrix3;
    [sides.x_axis, sides.y_axis, sides.z_axis].iter().map(|side| side.dot(place.normal).abs()).sum()
}

/// Range of voxels of a row within `thickness` of the plane; the first is `z` mm away, each next one `dz` mm more.
fn within(z: f64, dz: f64, thickness: f64, count: i32) -> Option<(i32, i32)> {
    let last = f64::from(count - 1);
    if dz.abs() < 1e-9 {
        return (z.abs() < thickness).then_some((0, count - 1));
    }
    let [a, b] = [(-thickness - z) / dz, (thickness - z) / dz];
    let (low, high) = (a.min(b).ceil().max(0.0), a.max(b).floor().min(last));
    (low <= high).then_some((low as i32, high as i32))
}

/// Keeps about `most` samples. A slightly different window would keep nearly the same ones.
fn thinned(samples: Vec<Sample>, most: usize) -> Vec<Sample> {
    if samples.len() <= most {
        return samples;
    }
    let limit = (u64::from(u32::MAX) * most as u64 / samples.len() as u64) as u32;
    samples.into_iter().filter(|sample| sample.key <= limit).collect()
}

/// A pseudo-random number per voxel (primes of Teschner et al. 2003, final mix of MurmurHash3).
fn key([i, j, k]: [i32; 3]) -> u32 {
    let [i, j, k] =
        [(i, 73_856_093), (j, 19_349_663), (k, 83_492_791)].map(|(n, by)| (n as u32).wrapping_mul(by));
    let mut mixed = i ^ j ^ k;
    mixed = (mixed ^ (mixed >> 16)).wrapping_mul(0x85eb_ca6b);
    mixed = (mixed ^ (mixed >> 13)).wrapping_mul(0xc2b2_ae35);
    mixed ^ (mixed >> 16)
}
