//! Finds the nearest background voxel by a k-d tree, for sheared grids.

use glam::DVec3;

use crate::trace::skeleton::foreground::{BACKGROUND, Foreground};

const LEAF: usize = 8;

/// Background voxels that touch lumen, in a balanced k-d tree whose nodes split their longest axis.
pub(super) struct NearestBackground {
    points: Vec<DVec3>,
    axes: Vec<u8>,
}

impl NearestBackground {
    pub(super) fn new(foreground: &Foreground, lumen: &[u32]) -> Self {
        let [i, j, k] = foreground.strides().map(|stride| stride as isize);
        let mut cells: Vec<usize> = Vec::new();
        for &cell in lumen {
            for step in 0..27 {
                let offset = (step % 3 - 1) * i + (step / 3 % 3 - 1) * j + (step / 9 - 1) * k;
                let other = cell as usize as isize + offset;
                if foreground.cells[other as usize] == BACKGROUND {
                    cells.push(other as usize);
                }
            }
        }
        cells.sort_unstable();
        cells.dedup();
        let points: Vec<DVec3> = cells.into_iter().map(|cell| foreground.position(cell)).collect();
        let mut tree = Self { axes: vec![0; points.len()], points };
        tree.part(0, tree.points.len());
        tree
    }

    fn part(&mut self, start: usize, end: usize) {
        if end - start <= LEAF {
            return;
        }
        let points = &mut self.points[start..end];
        let low = points.iter().copied().fold(DVec3::MAX, DVec3::min);
        let high = points.iter().copied().fold(DVec3::MIN, DVec3::max);
        let sides = (high - low).to_array();
        let axis = (0..3).max_by(|&a, &b| sides[a].total_cmp(&sides[b])).unwrap_or(0);
        let middle = points.len() / 2;
        points.select_nth_unstable_by(middle, |p, q| p[axis].total_cmp(&q[axis]));
        self.axes[start + middle] = axis as u8;
        self.part(start, start + middle);
        self.part(start + middle + 1, end);
    }

    pub(super) fn squared_distance(&self, point: DVec3) -> f64 {
        let mut best = f64::INFINITY;
        self.search(0, self.points.len(), point, &mut best);
        best
    }

    fn search(&self, start: usize, end: usize, point: DVec3, best: &mut f64) {
        if end - start <= LEAF {
            for other in &self.points[start..end] {
                *best = best.min(point.distance_squared(*other));
            }
            return;
        }
        let middle = start + (end - start) / 2;
        *best = best.min(point.distance_squared(self.points[middle]));
        let axis = self.axes[middle] as usize;
        let beyond = point[axis] - self.points[middle][axis];
        let (near, far) = ((start, middle), (middle + 1, end));
        let (near, far) = if beyond < 0.0 { (near, far) } else { (far, near) };
        self.search(near.0, near.1, point, best);
        if beyond * beyond < *best {
            self.search(far.0, far.1, point, best);
        }
    }
}
