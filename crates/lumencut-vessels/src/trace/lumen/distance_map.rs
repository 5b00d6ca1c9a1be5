//! Distances from the wall of a wide lumen around a line, in a box of cubic cells, and the path along their ridge.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DVec3, IVec3};
use rayon::prelude::*;

use crate::voxels::Voxels;

/// Cells per radius, unless the voxels are coarser: the wall is blurred over at least one voxel.
const CELLS_PER_RADIUS: f64 = 8.0;

/// Only cells within this many radii of the line are lumen, so that chambers that touch it do not count.
const REACH_RADII: f64 = 1.9;

/// A millimetre of path costs (`LEAST` + d)^-4, where d is the distance from the wall over `FULL` radii, at most 1.
const LEAST: f64 = 0.02;
const FULL: f64 = 1.2;

/// A point of the line, with the radius of its lumen (mm) and the value at its wall; lumen is brighter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LumenPoint {
    pub place: DVec3,
    pub radius: f64,
    pub wall: f64,
}

pub(crate) struct DistanceMap {
    first: DVec3,
    /// Side of a cell (mm).
    side: f64,
    size: IVec3,
    /// Distance from the wall (mm); 0 outside the lumen.
    distances: Vec<f32>,
    /// Radius of the line at its nearest point (mm); 0 beyond the reach.
    radii: Vec<f32>,
}

impl DistanceMap {
    /// The map around the points of a line.
    pub(crate) fn around(voxels: &Voxels, points: &[LumenPoint]) -> Self {
        let widest = points.iter().map(|point| point.radius).fold(0.0, f64::max);
        let side = voxels.mean_side().max(widest / CELLS_PER_RADIUS);
        let margin = DVec3::splat(REACH_RADII * widest + 2.0 * side);
        let low = points.iter().map(|point| point.place).fold(DVec3::MAX, DVec3::min) - margin;
        let high = points.iter().map(|point| point.place).fold(DVec3::MIN, DVec3::max) + margin;
        let size = ((high - low) / side).ceil().as_ivec3() + 1;
        let count = (size.x * size.y * size.z) as usize;
        let mut map = Self { first: low, side, size, distances: Vec::new(), radii: vec![0.0; count] };
        let walls = map.reach(points);
        let squares = |n: usize| {
            let is_lumen = map.radii[n] > 0.0 && voxels.at(map.center(n)) > walls[n];
            if is_lumen { f32::MAX } else { 0.0 }
        };
        let mut squares: Vec<f32> = (0..count).into_par_iter().map(squares).collect();
        let most = (REACH_RADII * widest / side).ceil() as i32;
        for axis in 0..3 {
            squares = map.pass(&squares, axis, most);
        }
        // Half a cell lies between the centre of the nearest cell outside and the wall.
        let distance = |square: f32| (square.sqrt() - 0.5 * side as f32).max(0.0);
        map.distances = squares.into_iter().map(distance).collect();
        map
    }

    /// Stores the radius of the nearest point in all cells within the reach; returns the values at its wall.
    fn reach(&mut self, points: &[LumenPoint]) -> Vec<f32> {
        let mut nearest = vec![f32::MAX; self.radii.len()];
        let mut walls = vec![0.0; self.radii.len()];
        for LumenPoint { place: point, radius, wall } in points {
            let reach = REACH_RADII * radius;
            let low = ((*point - reach - self.first) / self.side).ceil().as_ivec3();
            let high = ((*point + reach - self.first) / self.side).floor().as_ivec3();
            for k in low.z..=high.z {
                for j in low.y..=high.y {
                    for i in low.x..=high.x {
                        let n = self.number(IVec3::new(i, j, k));
                        let away = self.center(n).distance(*point);
                        if away <= reach && (away as f32) < nearest[n] {
                            (nearest[n], self.radii[n], walls[n]) =
                                (away as f32, *radius as f32, *wall as f32);
                        }
                    }
                }
            }
        }
        walls
    }

    /// Squared distances (mm²) after one more axis, to cells at most `most` cells away along it.
    fn pass(&self, squares: &[f32], axis: usize, most: i32) -> Vec<f32> {
        let stride = [1, self.size.x, self.size.x * self.size.y][axis];
        let cell = |n: usize| {
            if squares[n] == 0.0 {
                return 0.0;
            }
            let at = self.cell(n)[axis];
            let steps = -most.min(at)..=most.min(self.size[axis] - 1 - at);
            let square = |step: i32| {
                let away = f64::from(step) * self.side;
                squares[(n as i32 + step * stride) as usize] + (away * away) as f32
            };
            steps.map(square).fold(f32::MAX, f32::min)
        };
        (0..squares.len()).into_par_iter().map(cell).collect()
    }

    fn number(&self, cell: IVec3) -> usize {
        (cell.x + self.size.x * (cell.y + self.size.y * cell.z)) as usize
    }

    fn cell(&self, n: usize) -> IVec3 {
        let (n, x, y) = (n as i32, self.size.x, self.size.y);
        IVec3::new(n % x, n / x % y, n / (x * y))
    }

    fn center(&self, n: usize) -> DVec3 {
        self.first + self.cell(n).as_dvec3() * self.side
    }

    /// Distance from the wall at a position within the box (mm), trilinear.
    pub(crate) fn at(&self, place: DVec3) -> f64 {
        let index = ((place - self.first) / self.side).clamp(DVec3::ZERO, (self.size - 2).as_dvec3());
        let (cell, share) = (index.floor().as_ivec3(), index.fract());
        let corner = |n: i32| {
            let step = IVec3::new(n & 1, n >> 1 & 1, n >> 2);
            let weights = DVec3::select(step.cmpeq(IVec3::ONE), share, 1.0 - share);
            weights.element_product() * f64::from(self.distances[self.number(cell + step)])
        };
        (0..8).map(corner).sum()
    }

    /// The path along the ridge between two positions on the line; None if no path exists.
    pub(crate) fn ridge(&self, ends: [DVec3; 2]) -> Option<Vec<DVec3>> {
        let [from, to] = ends.map(|end| self.number(((end - self.first) / self.side).round().as_ivec3()));
        let price = |n: usize| {
            let share = f64::from(self.distances[n]) / (FULL * f64::from(self.radii[n]));
            (LEAST + share.min(1.0)).powi(-4)
        };
        let mut costs = vec![f64::INFINITY; self.radii.len()];
        let mut before = vec![u32::MAX; self.radii.len()];
        costs[from] = 0.0;
        // The bits of non-negative floats have the same order as their values.
        let mut open = BinaryHeap::from([Reverse((0_u64, from))]);
        while let Some(Reverse((bits, here))) = open.pop() {
            if here == to {
                break;
            }
            if f64::from_bits(bits) > costs[here] {
                continue;
            }
            for step in steps() {
                let next = self.number(self.cell(here) + step);
                if self.radii[next] == 0.0 {
                    continue;
                }
                let length = step.as_dvec3().length() * self.side;
                let cost = costs[here] + length * f64::midpoint(price(here), price(next));
                if cost < costs[next] {
                    (costs[next], before[next]) = (cost, here as u32);
                    open.push(Reverse((cost.to_bits(), next)));
                }
            }
        }
        let back = std::iter::successors(Some(to), |n| (*n != from).then(|| before[*n] as usize));
        let mut path: Vec<DVec3> = costs[to].is_finite().then(|| back.map(|n| self.center(n)).collect())?;
        path.reverse();
        Some(path)
    }
}

fn steps() -> impl Iterator<Item = IVec3> {
    (0..27).filter(|n| *n != 13).map(|n| IVec3::new(n % 3, n / 3 % 3, n / 9) - 1)
}
