//! The voxel path between two clicks.

use glam::DVec3;

use crate::trace::clicks::gaps::{Gap, Line};
use crate::trace::ways::region::{FORBIDDEN, Region, THIN, WEAK};
use crate::voxels::Voxels;

#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// Centres of the voxels on the path (mm, LPS).
    pub points: Vec<DVec3>,
    /// Parts of the path without lumen.
    pub gaps: Vec<Gap>,
}

impl Way {
    pub(crate) fn of(voxels: &Voxels, region: &mut Region, steps: &[[i32; 3]]) -> Self {
        let points: Vec<DVec3> = steps.iter().map(|voxel| voxels.center(*voxel)).collect();
        let codes: Vec<u8> = steps.iter().map(|voxel| region.code_of(voxels, *voxel)).collect();
        let below =
            |limit: f64| codes.iter().map(|code| *code >= region.code_below(limit)).collect::<Vec<_>>();
        let weak = below(WEAK);
        let line = Line::new(voxels, &region.model, &points);
        let mut gaps = line.gaps(&weak);
        for gap in &mut gaps {
            // A path must not avoid a stopper (a forbidden ball) by a detour through tissue.
            gap.is_open |= region.stoppers.iter().any(|stopper| gap.passes(&points, stopper));
        }
        Self { points, gaps }
    }

    pub(crate) fn is_open(&self) -> Vec<bool> {
        let mut is_open = vec![false; self.points.len()];
        for gap in self.gaps.iter().filter(|gap| gap.is_open) {
            is_open[gap.points.clone()].fill(true);
        }
        is_open
    }

    /// Points of the path, with straight lines in place of gaps, because no values guide the path there.
    pub(crate) fn straightened(&self) -> Vec<DVec3> {
        let mut points = self.points.clone();
        for gap in &self.gaps {
            let (first, last) = (gap.points.start.saturating_sub(1), gap.points.end.min(points.len() - 1));
            let [from, to] = [points[first], points[last]];
            for i in gap.points.clone() {
                points[i] = from.lerp(to, (i - first) as f64 / (last - first).max(1) as f64);
            }
        }
        points
    }
}

/// Voxel at which the path of a click starts: the click's own voxel or, at a wall, the cheapest neighbour.
pub(crate) fn start(voxels: &Voxels, region: &mut Region, click: DVec3) -> [i32; 3] {
    let middle = voxels.voxel_at(click).unwrap_or([0; 3]);
    let mut best = (region.code_of(voxels, middle), middle);
    if best.0 != FORBIDDEN && best.0 < region.code_below(THIN) {
        return middle;
    }
    for n in 0..27 {
        let step = [n % 3, n / 3 % 3, n / 9].map(|c| c - 1);
        let next: [i32; 3] = std::array::from_fn(|a| middle[a] + step[a]);
        if (0..3).all(|a| next[a] >= 0 && (next[a] as usize) < voxels.size[a]) {
            let code = region.code_of(voxels, next);
            if code != FORBIDDEN && (best.0 == FORBIDDEN || code < best.0) {
                best = (code, next);
            }
        }
    }
    best.1
}
