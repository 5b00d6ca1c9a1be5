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
    /// The last of the first depths and the first of the last ones (mm): between them no ray begins or ends.
    pub inner: [f64; 2],
    /// The largest value so far; beyond all values where there is no ray.
    best: [f32; PIXELS],
    /// The values so far times the length of each (mm), and all lengths; empty where no mean is wanted.
    sums: [Vec<f64>; 2],
}

impl Gathered {
    /// Nothing met yet on the rays of `size` pixels.
    pub fn new(size: [usize; 2], reduction: Reduction, chord: impl Fn([usize; 2]) -> [f64; 2]) -> Self {
        let count = if reduction == Reduction::Mean { PIXELS } else { 0 };
        let sums = [vec![0.0; count], vec![0.0; count]];
        let (chords, best) = ([[0.0; PIXELS], [-1.0; PIXELS]], [HUGE; PIXELS]);
        let [depths, inner] = [[f64::MAX, f64::MIN], [f64::MIN, f64::MAX]];
        let mut gathered = Self { chords, depths, inner, best, sums };
        for j in 0..size[1] {
            for i in 0..size[0] {
                let [near, far] = chord([i, j]);
                gathered.inner = [gathered.inner[0].max(near), gathered.inner[1].min(far)];
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
            Reduction::Mean => self.sums[1][p] > 0.0,
            Reduction::Largest | Reduction::Smallest => self.best[p] > -HUGE && self.best[p] < HUGE,
        };
        match reduction {
            _ if !found => f32::NAN,
            Reduction::Mean => (self.sums[0][p] / self.sums[1][p]) as f32,
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

    /// The largest values of the window at a column and a row so far.
    #[inline(always)]
    pub fn best(&self, window: [usize; 2]) -> [f32; FAN] {
        let mut best = [0.0; FAN];
        for r in 0..WINDOW {
            best[r * WINDOW..][..WINDOW].copy_from_slice(&self.best[place(window, r)..][..WINDOW]);
        }
        best
    }

    /// The first or the last depths of a window's rays, counted from `depth` (mm).
    #[inline(always)]
    pub fn ends(&self, end: usize, window: [usize; 2], depth: f64) -> [f32; FAN] {
        let mut ends = [0.0; FAN];
        for r in 0..WINDOW {
            let chords = &self.chords[end][place(window, r)..][..WINDOW];
            for c in 0..WINDOW {
                ends[r * WINDOW + c] = (chords[c] - depth) as f32;
            }
        }
        ends
    }

    /// Takes the largest values of a window.
    #[inline(always)]
    pub fn set_best(&mut self, window: [usize; 2], best: &[f32; FAN]) {
        for r in 0..WINDOW {
            self.best[place(window, r)..][..WINDOW].copy_from_slice(&best[r * WINDOW..][..WINDOW]);
        }
    }

    /// Adds the values of a window, each as long as its ray takes it (mm); 0 adds nothing.
    #[inline(always)]
    pub fn add(&mut self, window: [usize; 2], mean: &[f32; FAN], length: &[f32; FAN]) {
        for r in 0..WINDOW {
            let first = place(window, r);
            for c in 0..WINDOW {
                let (mean, length) = (mean[r * WINDOW + c], length[r * WINDOW + c]);
                let length = if mean.is_nan() { 0.0 } else { f64::from(length) };
                let mean = if mean.is_nan() { 0.0 } else { f64::from(mean) };
                self.sums[0][first + c] += mean * length;
                self.sums[1][first + c] += length;
            }
        }
    }
}

/// Where a row of a window begins.
#[inline(always)]
fn place([column, row]: [usize; 2], r: usize) -> usize {
    (row + r) * ROW + column
}
