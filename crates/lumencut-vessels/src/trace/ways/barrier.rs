//! The barrier between two lumens that touch, such as those of a dissection. Memberships do not show a flap between
//! lumens of different brightness, so the barrier looks at values: a flap is a valley, and a path costs more where
//! values change. Values of a lumen change least along its axis. The method is our own.

use crate::trace::lumen::lumen_model::LumenModel;
use crate::trace::ways::blocks::{BLOCK, SIDE};
use crate::trace::ways::shape::{HALO, PADDED_SIDE, blurred, eigenvalues, padded};
use crate::voxels::Voxels;

/// Standard deviations of the smoothing (voxels): of the second derivatives, and of the values that are compared.
const VALLEY_SMOOTHING: f64 = 0.8;
const LEVEL_SMOOTHING: f64 = 0.6;

/// The largest second derivative (noises per voxel squared) at which a valley begins, and at which it is clear.
const VALLEY: [f64; 2] = [1.5, 3.0];

/// Cost of a clear valley, relative to the cost of the same membership in no valley.
const CLEAR_VALLEY: f64 = 60.0;

/// Change of values that costs nothing (noises per mm), and the additional cost of a change twice as fast.
const FREE_CHANGE: f64 = 0.4;
const CHANGE: f32 = 12.0;

/// The noise is at least this fraction of the contrast, because smoothed volumes have almost none.
const LEAST_NOISE: f64 = 0.05;

/// Brighter values are capped at this fraction of the contrast above the lumen: the edge of bone must be no valley.
const CAP: f64 = 0.6;

const LEVEL_UNIT: f64 = 0.05;

fn noise(model: &LumenModel) -> f64 {
    model.noise.max(LEAST_NOISE * model.contrast()).max(f64::MIN_POSITIVE)
}

pub(crate) fn change_per_level(length: f32) -> f32 {
    (LEVEL_UNIT / (FREE_CHANGE * f64::from(length))) as f32
}

#[inline]
pub(crate) fn cost_of_change(from: i16, to: i16, per_level: f32) -> f32 {
    let change = (f32::from(from) - f32::from(to)).abs() * per_level;
    CHANGE.mul_add((change - 1.0).max(0.0), 1.0)
}

pub(crate) struct Barrier {
    pub levels: [i16; BLOCK],
    pub valleys: [f32; BLOCK],
}

fn scaled(model: &LumenModel, value: f32) -> f32 {
    let (noise, most) = (noise(model), model.high + CAP * model.contrast());
    let value = if value.is_finite() { f64::from(value) } else { model.tissue };
    ((value.min(most) - model.tissue) / noise) as f32
}

pub(crate) struct Valleys<'a, 'v> {
    voxels: &'a Voxels<'v>,
    model: &'a LumenModel,
    weights: [Vec<f32>; 3],
}

impl<'a, 'v> Valleys<'a, 'v> {
    pub(crate) fn new(voxels: &'a Voxels<'v>, model: &'a LumenModel) -> Self {
        Self { voxels, model, weights: gaussian(VALLEY_SMOOTHING, HALO as i32) }
    }

    pub(crate) fn hold(&self, voxel: [i32; 3]) -> bool {
        const SIDE: usize = 2 * HALO + 1;
        let mut values = [0.0; SIDE * SIDE * SIDE];
        self.voxels.cube(voxel.map(|c| c - HALO as i32), SIDE, &mut values);
        for value in &mut values {
            *value = scaled(self.model, *value);
        }
        let rows = self.weights.each_ref().map(|weights| products::<{ SIDE * SIDE }>(&values, weights));
        let entries = ENTRIES.map(|[i, j, k]| {
            let planes = products::<SIDE>(&rows[i], &self.weights[j]);
            f64::from(products::<1>(&planes, &self.weights[k])[0])
        });
        valley(entries) >= CLEAR_VALLEY as f32
    }
}

fn products<const N: usize>(values: &[f32], weights: &[f32]) -> [f32; N] {
    std::array::from_fn(|n| {
        values[n * weights.len()..].iter().zip(weights).map(|(value, weight)| value * weight).sum()
    })
}

impl Barrier {
    pub(crate) fn new(model: &LumenModel, values: &[f32]) -> Self {
        let scaled: Vec<f32> = values.iter().map(|value| scaled(model, *value)).collect();
        let smooth = blurred(&scaled, &gaussian(LEVEL_SMOOTHING, 2)[0]);
        let levels = std::array::from_fn(|n| (f64::from(smooth[padded(n)]) / LEVEL_UNIT) as i16);
        Self { levels, valleys: valleys(&scaled) }
    }
}

fn gaussian(sigma: f64, reach: i32) -> [Vec<f32>; 3] {
    let at = |x: i32| (-0.5 * (f64::from(x) / sigma).powi(2)).exp();
    let sum: f64 = (-reach..=reach).map(at).sum();
    let square = sigma * sigma;
    let made = |factor: &dyn Fn(f64) -> f64| {
        (-reach..=reach).map(|x| (factor(f64::from(x)) * at(x) / sum) as f32).collect()
    };
    [made(&|_| 1.0), made(&|x| x / square), made(&|x| (x * x / square - 1.0) / square)]
}

const ENTRIES: [[usize; 3]; 6] = [[2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 1, 0], [1, 0, 1], [0, 1, 1]];

fn valleys(values: &[f32]) -> [f32; BLOCK] {
    let weights = gaussian(VALLEY_SMOOTHING, HALO as i32);
    let along_i: [Vec<f32>; 3] =
        std::array::from_fn(|power| filtered(values, [PADDED_SIDE; 3], 0, &weights[power]));
    let entries: [Vec<f32>; 6] = std::array::from_fn(|entry| {
        let [i, j, k] = ENTRIES[entry];
        let along_j = filtered(&along_i[i], [SIDE, PADDED_SIDE, PADDED_SIDE], 1, &weights[j]);
        filtered(&along_j, [SIDE, SIDE, PADDED_SIDE], 2, &weights[k])
    });
    std::array::from_fn(|n| valley(entries.each_ref().map(|entry| f64::from(entry[n]))))
}

fn valley([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> f32 {
    let [from, to] = VALLEY;
    let squares = xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz);
    if squares <= from * from {
        return 1.0;
    }
    let [largest, ..] = eigenvalues([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
    (1.0 + (CLEAR_VALLEY - 1.0) * ((largest - from) / (to - from)).clamp(0.0, 1.0)) as f32
}

fn filtered(values: &[f32], size: [usize; 3], axis: usize, weights: &[f32]) -> Vec<f32> {
    let mut shorter = size;
    shorter[axis] -= weights.len() - 1;
    let stride = [1, size[0], size[0] * size[1]][axis];
    let mut sums = vec![0.0; shorter.iter().product()];
    for (row, sums) in sums.chunks_exact_mut(shorter[0]).enumerate() {
        let first = (row / shorter[1] * size[1] + row % shorter[1]) * size[0];
        for (n, weight) in weights.iter().enumerate() {
            let from = &values[first + n * stride..][..sums.len()];
            for (sum, value) in sums.iter_mut().zip(from) {
                *sum += weight * value;
            }
        }
    }
    sums
}
