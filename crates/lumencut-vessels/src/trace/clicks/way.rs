//! The way between two clicks through voxels.

use glam::DVec3;

use crate::trace::clicks::gaps::{Gap, Line};
use crate::trace::ways::region::{FORBIDDEN, Region, THIN, WEAK};
use crate::voxels::Voxels;

/// The way between two clicks through voxels.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// The middles of its voxels (mm, LPS).
    pub points: Vec<DVec3>,
    /// Its stretches without lumen.
    pub gaps: Vec<Gap>,
}

impl Way {
    /// A way through voxels with its gaps.
    pub(crate) fn of(voxels: &Voxels, region: &mut Region, steps: &[[i32; 3]]) -> Self {
        let points: Vec<DVec3> = steps.iter().map(|voxel| voxels.center(*voxel)).collect();
        let codes: Vec<u8> = steps.iter().map(|voxel| region.code_of(voxels, *voxel)).collect();
        let below =
            |limit: f64| codes.iter().map(|code| *code >= region.code_below(limit)).collect::<Vec<_>>();
        let weak = below(WEAK);
        let line = Line::new(voxels, &region.model, &points);
        let mut gaps = line.gaps(&weak);
        for gap in &mut gaps {
            // A way around a stopper through tissue does not count.
            gap.is_open |= region.stoppers.iter().any(|stopper| gap.passes(&points, stopper));
        }
        Self { points, gaps }
    }

    /// Its points, those of gaps put on a straight line: nothing is seen there that could lead it.
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

/// The voxel where the front of a click starts: its own, or where that is at the wall the neighbour that costs least.
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
