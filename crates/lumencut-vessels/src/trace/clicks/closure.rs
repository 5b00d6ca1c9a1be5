//! Tells dim lumen from other tissue of the same values: a lumen is enclosed, by darker tissue or by brighter lumen.

use glam::DVec3;

use crate::trace::lumen::directions::half_sphere;
use crate::voxels::Voxels;

/// Standard deviation of the smoothing, and length of the rays (voxels).
const SMOOTHING: f64 = 0.8;
const SMOOTHING_REACH: usize = 2;
const RAY: i32 = 10;

/// Number of opposite pairs of rays.
const PAIRS: u32 = 24;

/// A ray ends at values this many noises below the place, or above it.
const FALL: f64 = 1.0;
const RISE: f64 = 2.0;

/// Minimum fraction of the rays that must end. Of dim false lumen 99 % are enclosed, of muscle 7 %, of organs 27 %.
const LEAST_ENDED: f64 = 0.6;

/// Values of a dim lumen (HU): it has some contrast medium, but less than a clear lumen.
pub(crate) const DIM_HU: [f64; 2] = [65.0, 145.0];

/// Whether a place may lie in dim lumen, for the `noise` of clear lumen.
pub(crate) fn is_dim_lumen(voxels: &Voxels, place: DVec3, noise: f64) -> bool {
    let Some(voxel) = voxels.voxel_at(place) else { return false };
    let cube = Cube::around(voxels, voxel);
    (DIM_HU[0]..=DIM_HU[1]).contains(&cube.mean) && cube.ended(noise) >= LEAST_ENDED
}

/// Smoothed values around a voxel.
struct Cube {
    values: Vec<f32>,
    mean: f64,
}

const SIDE: usize = 2 * RAY as usize + 1;

impl Cube {
    fn around(voxels: &Voxels, middle: [i32; 3]) -> Self {
        let side = SIDE + 2 * SMOOTHING_REACH;
        let mut values = vec![0.0; side * side * side];
        voxels.cube(middle.map(|c| c - RAY - SMOOTHING_REACH as i32), side, &mut values);
        let at = |values: &[f32], n: [usize; 3], side: usize| {
            f64::from(values[(n[2] * side + n[1]) * side + n[0]])
        };
        let center = side / 2;
        let near = (0..27).map(|n| at(&values, [n % 3, n / 3 % 3, n / 9].map(|c| center + c - 1), side));
        let near: Vec<f64> = near.filter(|value| value.is_finite()).collect();
        let mean = near.iter().sum::<f64>() / near.len() as f64;
        Self { values: smoothed(&values, side), mean }
    }

    /// Fraction of the rays that end within their length.
    fn ended(&self, noise: f64) -> f64 {
        let ends = |way: DVec3| {
            (1..=RAY).any(|step| {
                let [i, j, k] = (way * f64::from(step)).to_array().map(|c| (c.round() as i32 + RAY) as usize);
                let away = f64::from(self.values[(k * SIDE + j) * SIDE + i]) - self.mean;
                away < -FALL * noise || away > RISE * noise
            })
        };
        let ended = half_sphere(PAIRS).flat_map(|way| [way, -way]).filter(|way| ends(*way)).count();
        ended as f64 / f64::from(2 * PAIRS)
    }
}

/// Values without their border, smoothed along each axis.
fn smoothed(values: &[f32], side: usize) -> Vec<f32> {
    let reach = SMOOTHING_REACH as i32;
    let weight = |x: i32| (-0.5 * (f64::from(x) / SMOOTHING).powi(2)).exp();
    let sum: f64 = (-reach..=reach).map(weight).sum();
    let weights: Vec<f32> = (-reach..=reach).map(|x| (weight(x) / sum) as f32).collect();
    let mut size = [side; 3];
    let mut now = values.to_vec();
    for axis in 0..3 {
        let stride = [1, size[0], size[0] * size[1]][axis];
        let mut shorter = size;
        shorter[axis] -= 2 * SMOOTHING_REACH;
        let from = |n: usize| {
            let [i, j, k] = [n % shorter[0], n / shorter[0] % shorter[1], n / (shorter[0] * shorter[1])];
            (k * size[1] + j) * size[0] + i
        };
        let next = 0..shorter.iter().product();
        now = next
            .map(|n| weights.iter().zip((from(n)..).step_by(stride)).map(|(w, at)| w * now[at]).sum())
            .collect();
        size = shorter;
    }
    now
}
