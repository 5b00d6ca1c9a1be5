//! Estimates the spatial correlation of image noise. Reconstruction kernels of CT correlate neighbouring voxels, so a
//! mean is less certain than with independent noise.

use glam::{DMat3, DVec3};

use crate::measure::section::slab::Samples;
use lumencut_core::math::lanes::{FAN, Isa, Kernel, dispatch};

/// The noise of voxels at least this far apart counts as independent.
const CORRELATED_VOXELS: usize = 5;

/// Minimum number of voxel pairs for a correlation, and its minimum significance in standard deviations.
const MIN_EVIDENCE: (f64, f64) = (100.0, 2.0);

/// Residuals above this multiple of the typical value are not noise.
const LARGEST: f32 = 4.0;

/// Autocorrelation of the noise, indexed by the absolute offsets along the grid axes.
#[derive(Clone, Debug)]
pub(crate) struct Texture {
    correlation: [[[f32; CORRELATED_VOXELS]; CORRELATED_VOXELS]; CORRELATED_VOXELS],
}

#[derive(Clone, Debug)]
pub(crate) struct Pairs {
    products: [[[f64; CORRELATED_VOXELS]; CORRELATED_VOXELS]; CORRELATED_VOXELS],
    count: [[[f64; CORRELATED_VOXELS]; CORRELATED_VOXELS]; CORRELATED_VOXELS],
    /// Sum and number of the products of distant voxel pairs.
    far: [f64; 2],
}

impl Pairs {
    pub(crate) fn new(samples: &Samples, missing: &[[f32; FAN]], noise: f32) -> Self {
        let mut all = Self { products: Default::default(), count: Default::default(), far: [0.0; 2] };
        let mut each = Vec::with_capacity(samples.count);
        for (n, misses) in missing.iter().enumerate() {
            for (l, miss) in misses.iter().enumerate() {
                if samples.weight[n][l] > 0.0 && miss.abs() < LARGEST * noise {
                    each.push((samples.voxel[n][l], f64::from(*miss)));
                }
            }
        }
        let (mut sum, mut near) = (0.0, [0.0; 2]);
        for (_, miss) in &each {
            sum += miss;
            all.products[0][0][0] += miss * miss;
            all.count[0][0][0] += 1.0;
        }
        let squares = all.products[0][0][0];
        for_near_pairs(&mut each, |[i, j, k], miss, beside| {
            all.products[i][j][k] += miss * beside;
            all.count[i][j][k] += 1.0;
            near = [near[0] + miss * beside, near[1] + 1.0];
        });
        // The products of all pairs sum to half of (squared sum - sum of squares). The sum over near pairs is
        // subtracted.
        let number = each.len() as f64;
        all.far = [(sum * sum - squares) / 2.0 - near[0], number * (number - 1.0) / 2.0 - near[1]];
        all
    }

    #[must_use]
    pub(crate) fn with(mut self, other: &Self) -> Self {
        self.far = [self.far[0] + other.far[0], self.far[1] + other.far[1]];
        for i in 0..CORRELATED_VOXELS {
            for j in 0..CORRELATED_VOXELS {
                for k in 0..CORRELATED_VOXELS {
                    self.products[i][j][k] += other.products[i][j][k];
                    self.count[i][j][k] += other.count[i][j][k];
                }
            }
        }
        self
    }
}

/// Visits each pair of near voxels with their offset. Sorting along the longest axis skips most other pairs.
fn for_near_pairs<T: Copy>(samples: &mut [([i16; 3], T)], mut visit: impl FnMut([usize; 3], T, T)) {
    let axis = put_in_order(samples);
    for (n, (voxel, value)) in samples.iter().enumerate() {
        let after = &samples[n + 1..];
        let near = after
            .partition_point(|(other, _)| usize::from(other[axis].abs_diff(voxel[axis])) < CORRELATED_VOXELS);
        for (other, beside) in &after[..near] {
            if let Some(apart) = apart(*voxel, *other) {
                visit(apart, *value, *beside);
            }
        }
    }
}

/// Sorts samples along the axis of their largest extent and returns that axis.
fn put_in_order<T: Copy>(samples: &mut [([i16; 3], T)]) -> usize {
    let extent = |axis: usize| {
        let along = || samples.iter().map(move |(voxel, _)| voxel[axis]);
        along().max().unwrap_or(0).abs_diff(along().min().unwrap_or(0))
    };
    let axis = (0..3).max_by_key(|axis| extent(*axis)).unwrap_or(0);
    samples.sort_unstable_by_key(|(voxel, _)| voxel[axis]);
    axis
}

#[inline(always)]
fn apart(a: [i16; 3], b: [i16; 3]) -> Option<[usize; 3]> {
    let apart: [usize; 3] = std::array::from_fn(|n| usize::from(a[n].abs_diff(b[n])));
    (apart[0] < CORRELATED_VOXELS && apart[1] < CORRELATED_VOXELS && apart[2] < CORRELATED_VOXELS)
        .then_some(apart)
}

/// Number of cells of the flattened correlation, padded to a power of two.
const CELLS: usize = 128;

/// The cell used for distant pairs; its value is 0.
const FAR_CELL: i32 = (CORRELATED_VOXELS * CORRELATED_VOXELS * CORRELATED_VOXELS) as i32;

/// Kernel that computes the variance of the noise, Σᵢⱼ wᵢ wⱼ ρ(i - j), over near pairs.
struct NearProducts {
    /// Voxels sorted along the first axis, followed by sixteen distant ones as padding.
    voxel: [Vec<i32>; 3],
    weight: Vec<f32>,
    correlation: [f32; CELLS],
    count: usize,
}

impl NearProducts {
    fn new(
        samples: &mut [([i16; 3], f32)],
        correlation: &[[[f32; CORRELATED_VOXELS]; CORRELATED_VOXELS]; CORRELATED_VOXELS],
    ) -> Self {
        const FAR_INDEX: i32 = 1 << 20;
        let axis = put_in_order(samples);
        let axes = [axis, (axis + 1) % 3, (axis + 2) % 3];
        let behind = || std::iter::repeat_n(FAR_INDEX, FAN);
        let voxel = axes
            .map(|axis| samples.iter().map(|(voxel, _)| i32::from(voxel[axis])).chain(behind()).collect());
        let weight = samples.iter().map(|(_, weight)| *weight).chain([0.0; FAN]).collect();
        let mut cells = [0.0; CELLS];
        for i in 0..CORRELATED_VOXELS {
            for j in 0..CORRELATED_VOXELS {
                for k in 0..CORRELATED_VOXELS {
                    let steps = [i, j, k];
                    cells[axes.iter().fold(0, |cell, axis| cell * CORRELATED_VOXELS + steps[*axis])] =
                        correlation[i][j][k];
                }
            }
        }
        Self { voxel, weight, correlation: cells, count: samples.len() }
    }
}

impl Kernel for NearProducts {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        const LAST_VOXEL: i32 = CORRELATED_VOXELS as i32 - 1;
        let Self { voxel, weight, correlation, count } = self;
        let mut sum = [0.0; FAN];
        for n in 0..count {
            let here = [0, 1, 2].map(|axis| voxel[axis][n]);
            let mut first = n + 1;
            while voxel[0][first] - here[0] <= LAST_VOXEL {
                let mut cell = [0; FAN];
                let mut is_far = [false; FAN];
                for axis in 0..3 {
                    let there = &voxel[axis][first..first + FAN];
                    for l in 0..FAN {
                        let apart = (there[l] - here[axis]).abs();
                        is_far[l] |= apart > LAST_VOXEL;
                        cell[l] = cell[l] * CORRELATED_VOXELS as i32 + apart;
                    }
                }
                let beside = &weight[first..first + FAN];
                for l in 0..FAN {
                    let cell = if is_far[l] { FAR_CELL } else { cell[l] };
                    let alike = correlation[cell as usize % CELLS];
                    sum[l] += f64::from(weight[n] * beside[l] * alike);
                }
                first += FAN;
                if first >= count {
                    break;
                }
            }
        }
        sum.iter().sum()
    }
}

pub(crate) fn independent_variance(weights: &[[f32; FAN]]) -> f64 {
    weights.iter().flatten().map(|weight| f64::from(weight * weight)).sum()
}

impl Texture {
    pub(crate) fn white() -> Self {
        let mut correlation = [[[0.0; CORRELATED_VOXELS]; CORRELATED_VOXELS]; CORRELATED_VOXELS];
        correlation[0][0][0] = 1.0;
        Self { correlation }
    }

    pub(crate) fn of(pairs: &Pairs) -> Self {
        let mut all = Self::white();
        // The fit absorbs the slowest variations of the noise in a section, which lowers all correlations by
        // the same offset. Distant pairs are independent, so they show that offset.
        let taken = -(pairs.far[0] / pairs.far[1].max(1.0)).min(0.0);
        let variance = pairs.products[0][0][0] / pairs.count[0][0][0].max(1.0) + taken;
        for i in 0..CORRELATED_VOXELS {
            for j in 0..CORRELATED_VOXELS {
                for k in 0..CORRELATED_VOXELS {
                    let count = pairs.count[i][j][k];
                    if i + j + k == 0 || count < MIN_EVIDENCE.0 || variance <= 0.0 {
                        continue;
                    }
                    let correlation = (pairs.products[i][j][k] / count + taken) / variance;
                    if correlation.abs() * count.sqrt() >= MIN_EVIDENCE.1 {
                        all.correlation[i][j][k] = correlation.clamp(-1.0, 1.0) as f32;
                    }
                }
            }
        }
        all
    }

    /// Factor by which correlation increases the variance of wall estimates over the width of the blur (mm).
    pub(crate) fn inflation(&self, sides: DMat3, width: f64) -> f64 {
        const SIGNS: [f64; 2] = [1.0, -1.0];
        let mut sum = 0.0;
        for i in 0..CORRELATED_VOXELS {
            for j in 0..CORRELATED_VOXELS {
                for k in 0..CORRELATED_VOXELS {
                    let steps = [i, j, k];
                    // An offset stands for all sign combinations of its nonzero components.
                    let count = steps.iter().filter(|n| **n > 0).count();
                    let far = |signs: [f64; 3]| {
                        (0..3)
                            .map(|a| sides.col(a) * (signs[a] * steps[a] as f64))
                            .sum::<DVec3>()
                            .length_squared()
                    };
                    let near: f64 = SIGNS
                        .iter()
                        .flat_map(|y| SIGNS.map(|z| (-0.5 * far([1.0, *y, z]) / (width * width)).exp()))
                        .sum::<f64>()
                        / 4.0;
                    sum += f64::from(1u32 << count) * near * f64::from(self.correlation[i][j][k]);
                }
            }
        }
        sum.max(1.0)
    }

    /// Variance of a weighted sum of noise of variance 1; at least a tenth of that of independent noise.
    pub(crate) fn variance(&self, samples: &Samples, weights: &[[f32; FAN]]) -> f64 {
        let mut each: Vec<([i16; 3], f32)> = weights
            .iter()
            .zip(&samples.voxel)
            .flat_map(|(weights, voxels)| voxels.iter().copied().zip(weights.iter().copied()))
            .filter(|(_, weight)| *weight != 0.0)
            .collect();
        let own = independent_variance(weights);
        let both = dispatch(Isa::widest(), NearProducts::new(&mut each, &self.correlation));
        (own + 2.0 * both).max(0.1 * own)
    }
}

#[cfg(test)]
#[path = "tests/texture.rs"]
mod tests;
