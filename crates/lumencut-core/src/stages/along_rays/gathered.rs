//! What the rays of a tile have met.

use super::Reduction;
use crate::math::blocks::HUGE;
use crate::math::lanes::{FAN, smaller, smallest};

/// The size of a tile (pixels).
pub(super) const TILE: [usize; 2] = [32, 16];
/// The side of the square of pixels whose rays are followed together.
pub(super) const WINDOW: usize = 4;
/// From a row of a tile to the next: a window may stand over the border, where no ray asks for anything.
const ROW: usize = TILE[0] + FAN;
/// The pixels of a tile, and of what stands over its border.
const PIXELS: usize = ROW * (TILE[1] + WINDOW);

/// The chords of a tile's rays and what they have met so far.
#[derive(Clone, Debug)]
pub(super) struct Gathered {
    /// The first and the last depth of each ray (mm).
    chords: [[f64; PIXELS]; 2],
    /// The first and the last depth of all (mm).
    pub depths: [f64; 2],
    /// The largest value so far; beyond all values where there is no ray.
    best: [f32; PIXELS],
    /// The values so far times the length of each (mm), and all lengths; empty where no mean is wanted.
    sums: Vec<[f64; 2]>,
}

impl Gathered {
    /// Nothing met yet on the rays of `size` pixels.
    pub fn new(size: [usize; 2], reduction: Reduction, chord: impl Fn([usize; 2]) -> [f64; 2]) -> Self {
        let sums = if reduction == Reduction::Mean { vec![[0.0; 2]; PIXELS] } else { Vec::new() };
        let (chords, best) = ([[0.0; PIXELS], [-1.0; PIXELS]], [HUGE; PIXELS]);
        let mut gathered = Self { chords, depths: [f64::MAX, f64::MIN], best, sums };
        for j in 0..size[1] {
            for i in 0..size[0] {
                let [near, far] = chord([i, j]);
                if near > far {
                    continue;
                }
                let p = j * ROW + i;
                (gathered.chords[0][p], gathered.chords[1][p]) = (near, far);
                gathered.best[p] = -HUGE;
                gathered.depths = [gathered.depths[0].min(near), gathered.depths[1].max(far)];
            }
        }
        gathered
    }

    /// Whether there is no ray at all.
    pub fn is_empty(&self) -> bool {
        self.depths[0] > self.depths[1]
    }

    /// The value of a ray; NaN where it has met none.
    pub fn value(&self, [i, j]: [usize; 2], reduction: Reduction, sign: f32) -> f32 {
        let p = j * ROW + i;
        let found = match reduction {
            Reduction::Mean => self.sums[p][1] > 0.0,
            Reduction::Largest | Reduction::Smallest => self.best[p] > -HUGE && self.best[p] < HUGE,
        };
        match reduction {
            _ if !found => f32::NAN,
            Reduction::Mean => (self.sums[p][0] / self.sums[p][1]) as f32,
            Reduction::Largest | Reduction::Smallest => self.best[p] * sign,
        }
    }

    /// The smallest of the largest values in some columns and rows, or a smaller one.
    #[inline(always)]
    pub fn smallest_best(&self, columns: [usize; 2], rows: [usize; 2]) -> f32 {
        let mut least = [HUGE; FAN];
        for j in rows[0]..=rows[1] {
            for i in (columns[0]..=columns[1]).step_by(FAN) {
                let best: &[f32; FAN] = self.best[j * ROW + i..][..FAN].try_into().unwrap_or(&[-HUGE; FAN]);
                for l in 0..FAN {
                    least[l] = smaller(least[l], best[l]);
                }
            }
        }
        smallest(&least)
    }

    /// The pixels of the window at a column and a row.
    #[inline(always)]
    pub fn window([column, row]: [usize; 2]) -> [usize; FAN] {
        std::array::from_fn(|l| (row + l / WINDOW) * ROW + column + l % WINDOW)
    }

    /// The largest values of a window so far.
    #[inline(always)]
    pub fn best(&self, window: &[usize; FAN]) -> [f32; FAN] {
        window.map(|p| self.best[p])
    }

    /// The first and the last depth of a window's rays, counted from `depth` (mm).
    #[inline(always)]
    pub fn chords(&self, window: &[usize; FAN], depth: f64) -> [[f32; FAN]; 2] {
        [0, 1].map(|end: usize| window.map(|p| (self.chords[end][p] - depth) as f32))
    }

    /// Takes the largest values of a window.
    #[inline(always)]
    pub fn set_best(&mut self, window: &[usize; FAN], best: &[f32; FAN]) {
        for l in 0..FAN {
            self.best[window[l]] = best[l];
        }
    }

    /// Adds the values of a window, each as long as its ray takes it (mm); 0 adds nothing. Neighbouring windows that
    /// overlap leave `columns` and `rows` to each other.
    #[inline(always)]
    pub fn add(&mut self, window: &[usize; FAN], mean: &[f32; FAN], length: &[f32; FAN]) {
        for l in 0..FAN {
            if length[l] > 0.0 && !mean[l].is_nan() {
                let sum = &mut self.sums[window[l]];
                *sum = [sum[0] + f64::from(mean[l]) * f64::from(length[l]), sum[1] + f64::from(length[l])];
            }
        }
    }
}
