//! Exact distance from lumen voxels to the nearest background voxel, also for voxels with unequal sides. Felzenszwalb
//! and Huttenlocher, "Distance Transforms of Sampled Functions", Theory of Computing 8, 2012,
//! doi:10.4086/toc.2012.v008a019: one pass per axis computes a lower envelope of parabolas. Runs of lumen are
//! independent, so background is never visited.

use crate::trace::skeleton::foreground::{Foreground, LUMEN};
use crate::trace::skeleton::nearest_background::NearestBackground;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Maximum cosine between the axes of a rectangular grid; the error is then 0.001 voxels over 1000 voxels.
const RIGHT_ANGLE: f64 = 1e-6;

const CELLS_BETWEEN_STOPS: usize = 1 << 16;

/// Squared distance (mm²) from each cell of `lumen` (sorted) to the nearest background centre; 0 in
/// background. Sheared grids use a k-d tree, because squared distances along their axes do not add up.
pub fn squared_distances(foreground: &Foreground, lumen: &[u32], stop: Stop) -> Result<Vec<f32>> {
    let mut squares = vec![0.0; foreground.cells.len()];
    if is_sheared(foreground) {
        let nearest = NearestBackground::new(foreground, lumen);
        for (number, &cell) in lumen.iter().enumerate() {
            if number % CELLS_BETWEEN_STOPS == 0 {
                go_on(stop)?;
            }
            squares[cell as usize] = nearest.squared_distance(foreground.position(cell as usize)) as f32;
        }
        return Ok(squares);
    }
    for axis in 0..3 {
        let mut pass = Pass::new(foreground, axis);
        for (number, &cell) in lumen.iter().enumerate() {
            if number % CELLS_BETWEEN_STOPS == 0 {
                go_on(stop)?;
            }
            let cell = cell as usize;
            if foreground.cells[cell - pass.stride] != LUMEN {
                pass.run(foreground, cell, &mut squares);
            }
        }
    }
    Ok(squares)
}

fn is_sheared(foreground: &Foreground) -> bool {
    let axes = foreground.world_from_index.matrix3;
    let [x, y, z] = [axes.x_axis.normalize(), axes.y_axis.normalize(), axes.z_axis.normalize()];
    [x.dot(y), y.dot(z), z.dot(x)].into_iter().any(|cosine| cosine.abs() > RIGHT_ANGLE)
}

struct Pass {
    axis: usize,
    stride: usize,
    /// Voxel side along the axis (mm).
    side: f64,
    /// Results of the previous passes along the run, with a 0 at both ends.
    values: Vec<f64>,
    /// Lower envelope: the position of each parabola, and where it starts to be the lowest one.
    lowest: Vec<usize>,
    from: Vec<f64>,
}

impl Pass {
    fn new(foreground: &Foreground, axis: usize) -> Self {
        let (stride, side) = (foreground.strides()[axis], foreground.sides()[axis]);
        Self { axis, stride, side, values: Vec::new(), lowest: Vec::new(), from: Vec::new() }
    }

    fn run(&mut self, foreground: &Foreground, first: usize, squares: &mut [f32]) {
        let lumen = |n: usize| foreground.cells[first + n * self.stride] == LUMEN;
        let length = (1..).find(|&n| !lumen(n)).unwrap_or(1);
        if self.axis == 0 {
            for n in 0..length {
                let distance = (n + 1).min(length - n) as f64 * self.side;
                squares[first + n] = (distance * distance) as f32;
            }
            return;
        }
        self.values.clear();
        self.values.push(0.0);
        self.values.extend((0..length).map(|n| f64::from(squares[first + n * self.stride])));
        self.values.push(0.0);
        self.envelope();
        let mut piece = 0;
        for n in 1..=length {
            while piece + 1 < self.lowest.len() && self.from[piece + 1] <= n as f64 {
                piece += 1;
            }
            squares[first + (n - 1) * self.stride] = self.at(self.lowest[piece], n) as f32;
        }
    }

    fn at(&self, lowest: usize, n: usize) -> f64 {
        let distance = (n as f64 - lowest as f64) * self.side;
        distance.mul_add(distance, self.values[lowest])
    }

    fn envelope(&mut self) {
        self.lowest.clear();
        self.from.clear();
        for n in 0..self.values.len() {
            let mut from = f64::NEG_INFINITY;
            while let Some(&last) = self.lowest.last() {
                from = self.crossing(last, n);
                if from > self.from[self.lowest.len() - 1] {
                    break;
                }
                self.lowest.pop();
                self.from.pop();
                from = f64::NEG_INFINITY;
            }
            self.lowest.push(n);
            self.from.push(from);
        }
    }

    fn crossing(&self, before: usize, after: usize) -> f64 {
        let [p, q] = [before as f64, after as f64];
        let square = self.side * self.side;
        let [f, g] = [self.values[before] / square, self.values[after] / square];
        (g - f + q * q - p * p) / (2.0 * (q - p))
    }
}
