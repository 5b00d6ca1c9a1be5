//! Kernels that compute residuals and normal equations of the samples.

use crate::measure::estimation::least_squares::Normal;
use crate::measure::model::{Model, Modelled};
use crate::measure::section::slab::Samples;
use lumencut_core::math::lanes::{FAN, Kernel};

/// Kernel that sums the normal equations over all samples.
pub(crate) struct Sums<'a, M, const N: usize> {
    pub samples: &'a Samples,
    pub kept: &'a [[f32; FAN]],
    pub model: &'a M,
}

impl<M: Model<N>, const N: usize> Kernel for Sums<'_, M, N> {
    type Output = Normal<N>;

    #[inline(always)]
    fn run(self) -> Normal<N> {
        let Self { samples, kept, model } = self;
        let mut cost = [0.0; FAN];
        let mut slope = [[0.0; FAN]; N];
        let mut matrix = [[[0.0; FAN]; N]; N];
        for n in 0..samples.x.len() {
            let Modelled { share, by } = model.modelled(&samples.x[n], &samples.y[n]);
            let mut missing = [0.0; FAN];
            for l in 0..FAN {
                missing[l] = samples.share[n][l] - share[l];
            }
            for l in 0..FAN {
                cost[l] += kept[n][l] * missing[l] * missing[l];
            }
            for a in 0..N {
                let mut weighted = [0.0; FAN];
                for l in 0..FAN {
                    weighted[l] = kept[n][l] * by[a][l];
                    slope[a][l] += weighted[l] * missing[l];
                }
                for b in 0..=a {
                    for l in 0..FAN {
                        matrix[a][b][l] += weighted[l] * by[b][l];
                    }
                }
            }
        }
        let sum = |lanes: &[f32; FAN]| lanes.iter().map(|lane| f64::from(*lane)).sum::<f64>();
        Normal {
            cost: sum(&cost),
            slope: std::array::from_fn(|a| sum(&slope[a])),
            matrix: std::array::from_fn(|a| std::array::from_fn(|b| sum(&matrix[a.max(b)][a.min(b)]))),
        }
    }
}

/// Kernel that computes the residual of each sample.
pub(crate) struct Missing<'a, M, const N: usize> {
    pub samples: &'a Samples,
    pub model: &'a M,
}

impl<M: Model<N>, const N: usize> Kernel for Missing<'_, M, N> {
    type Output = Vec<[f32; FAN]>;

    #[inline(always)]
    fn run(self) -> Vec<[f32; FAN]> {
        let Self { samples, model } = self;
        let mut all = Vec::with_capacity(samples.x.len());
        for n in 0..samples.x.len() {
            let share = model.modelled(&samples.x[n], &samples.y[n]).share;
            all.push(std::array::from_fn(|l| samples.share[n][l] - share[l]));
        }
        all
    }
}

/// Kernel that computes how far each sample shifts a combination of parameters.
pub(crate) struct Moves<'a, M, const N: usize> {
    pub samples: &'a Samples,
    pub kept: &'a [[f32; FAN]],
    pub model: &'a M,
    /// Coefficient of each derivative in the combination.
    pub towards: [f32; N],
}

impl<M: Model<N>, const N: usize> Kernel for Moves<'_, M, N> {
    type Output = Vec<[f32; FAN]>;

    #[inline(always)]
    fn run(self) -> Vec<[f32; FAN]> {
        let Self { samples, kept, model, towards } = self;
        let mut all = Vec::with_capacity(samples.x.len());
        for n in 0..samples.x.len() {
            let by = model.modelled(&samples.x[n], &samples.y[n]).by;
            let mut moves = [0.0; FAN];
            for a in 0..N {
                for l in 0..FAN {
                    moves[l] += towards[a] * by[a][l];
                }
            }
            for l in 0..FAN {
                moves[l] *= kept[n][l];
            }
            all.push(moves);
        }
        all
    }
}
