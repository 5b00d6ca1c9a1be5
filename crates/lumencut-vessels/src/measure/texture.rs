//! The noise of a scan: how alike it is in voxels near each other.
//!
//! Every kernel of a CT correlates the noise of neighbours. A mean of correlated values is less sure than one of independent
//! values: what a diameter is unsure by is the sum over all pairs of samples, by how much each of them moves it.

use glam::{DMat3, DVec3};

use super::slab::Samples;
use lumencut_core::math::lanes::FAN;

/// Noise is taken as independent from this number of voxels on.
const FAR: usize = 5;

/// A correlation is told by at least this number of pairs, and counts from this number of its standard deviations on.
const LEAST: (f64, f64) = (100.0, 2.0);

/// What misses by more than this multiple of the typical value is not noise.
const LARGEST: f32 = 4.0;

/// The autocorrelation of the noise by the distances of two voxels along the axes of the grid, whatever their signs.
#[derive(Clone, Debug)]
pub struct Texture {
    correlation: [[[f32; FAR]; FAR]; FAR],
}

/// The products of what pairs of samples miss, by their distances.
#[derive(Clone, Debug)]
pub struct Pairs {
    products: [[[f64; FAR]; FAR]; FAR],
    count: [[[f64; FAR]; FAR]; FAR],
    /// The sum of the products of those that are far apart, and their number.
    far: [f64; 2],
}

impl Pairs {
    /// The pairs of a section whose samples miss by this much, with a noise of about `noise`.
    pub fn new(samples: &Samples, missing: &[[f32; FAN]], noise: f32) -> Self {
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
        // All pairs of two are half of what the square of the sum has beyond the squares; those that are not near are far.
        let number = each.len() as f64;
        all.far = [(sum * sum - squares) / 2.0 - near[0], number * (number - 1.0) / 2.0 - near[1]];
        all
    }

    /// With the pairs of another section.
    #[must_use]
    pub fn with(mut self, other: &Self) -> Self {
        self.far = [self.far[0] + other.far[0], self.far[1] + other.far[1]];
        for i in 0..FAR {
            for j in 0..FAR {
                for k in 0..FAR {
                    self.products[i][j][k] += other.products[i][j][k];
                    self.count[i][j][k] += other.count[i][j][k];
                }
            }
        }
        self
    }
}

/// Visits every two of some samples in voxels that are not far apart, each pair once: how far they are apart along each axis, and
/// what belongs to either. Along the axis on which they lie farthest apart the samples are put in order, so that most of those
/// that are far apart are never looked at.
fn for_near_pairs<T: Copy>(samples: &mut [([i16; 3], T)], mut visit: impl FnMut([usize; 3], T, T)) {
    let extent = |axis: usize| {
        let along = || samples.iter().map(move |(voxel, _)| voxel[axis]);
        along().max().unwrap_or(0).abs_diff(along().min().unwrap_or(0))
    };
    let axis = (0..3).max_by_key(|axis| extent(*axis)).unwrap_or(0);
    samples.sort_unstable_by_key(|(voxel, _)| voxel[axis]);
    for (n, (voxel, value)) in samples.iter().enumerate() {
        let after = &samples[n + 1..];
        let near = after.partition_point(|(other, _)| usize::from(other[axis].abs_diff(voxel[axis])) < FAR);
        for (other, beside) in &after[..near] {
            if let Some(apart) = apart(*voxel, *other) {
                visit(apart, *value, *beside);
            }
        }
    }
}

/// How far two voxels are apart along each axis; None where that is far.
#[inline(always)]
fn apart(a: [i16; 3], b: [i16; 3]) -> Option<[usize; 3]> {
    let apart: [usize; 3] = std::array::from_fn(|n| usize::from(a[n].abs_diff(b[n])));
    (apart[0] < FAR && apart[1] < FAR && apart[2] < FAR).then_some(apart)
}

/// The variance of the sum of independent noise of variance 1, each sample weighed by `weights`.
pub fn independent_variance(weights: &[[f32; FAN]]) -> f64 {
    weights.iter().flatten().map(|weight| f64::from(weight * weight)).sum()
}

impl Texture {
    /// Noise that is independent in all voxels.
    pub fn white() -> Self {
        let mut correlation = [[[0.0; FAR]; FAR]; FAR];
        correlation[0][0][0] = 1.0;
        Self { correlation }
    }

    /// The texture that pairs tell.
    pub fn of(pairs: &Pairs) -> Self {
        let mut all = Self::white();
        // The fit takes the slowest part of the noise for the section, so that what is left is too low by this everywhere. Far apart
        // noise is independent: what is seen there is that alone.
        let taken = -(pairs.far[0] / pairs.far[1].max(1.0)).min(0.0);
        let variance = pairs.products[0][0][0] / pairs.count[0][0][0].max(1.0) + taken;
        for i in 0..FAR {
            for j in 0..FAR {
                for k in 0..FAR {
                    let count = pairs.count[i][j][k];
                    if i + j + k == 0 || count < LEAST.0 || variance <= 0.0 {
                        continue;
                    }
                    let told = (pairs.products[i][j][k] / count + taken) / variance;
                    if told.abs() * count.sqrt() >= LEAST.1 {
                        all.correlation[i][j][k] = told.clamp(-1.0, 1.0) as f32;
                    }
                }
            }
        }
        all
    }

    /// By how much the variance of what walls tell is larger than with independent noise: a wall is seen over the width of the
    /// blur (mm) in voxels with these sides.
    pub fn inflation(&self, sides: DMat3, width: f64) -> f64 {
        const SIGNS: [f64; 2] = [1.0, -1.0];
        let mut sum = 0.0;
        for i in 0..FAR {
            for j in 0..FAR {
                for k in 0..FAR {
                    let steps = [i, j, k];
                    // Each distance stands for both signs along each axis; along an axis without distance there is one.
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

    /// The variance of the sum of noise of variance 1, each sample weighed by `weights`; at least that of independent noise
    /// times a tenth.
    pub fn variance(&self, samples: &Samples, weights: &[[f32; FAN]]) -> f64 {
        let mut each: Vec<([i16; 3], f32)> = weights
            .iter()
            .zip(&samples.voxel)
            .flat_map(|(weights, voxels)| voxels.iter().copied().zip(weights.iter().copied()))
            .filter(|(_, weight)| *weight != 0.0)
            .collect();
        let own = independent_variance(weights);
        let mut both = 0.0;
        for_near_pairs(&mut each, |[i, j, k], weight, beside| {
            both += f64::from(weight * beside * self.correlation[i][j][k]);
        });
        (own + 2.0 * both).max(0.1 * own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_pairs_are_those_of_a_search_of_all() {
        let mut state = 7u32;
        let mut next = |most: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) % most
        };
        for extent in [[1, 1, 1], [3, 40, 9], [25, 4, 2], [12, 12, 60]] {
            let mut samples: Vec<([i16; 3], u32)> =
                (0..300).map(|n| (extent.map(|most| next(most) as i16 - 7), n)).collect();
            let mut expected = Vec::new();
            for (n, (voxel, a)) in samples.iter().enumerate() {
                for (other, b) in &samples[n + 1..] {
                    expected.extend(apart(*voxel, *other).map(|apart| (*a.min(b), *a.max(b), apart)));
                }
            }
            let mut found = Vec::new();
            for_near_pairs(&mut samples, |apart, a, b| found.push((a.min(b), a.max(b), apart)));
            expected.sort_unstable();
            found.sort_unstable();
            assert!(!expected.is_empty());
            assert_eq!(found, expected, "{extent:?}");
        }
    }
}
