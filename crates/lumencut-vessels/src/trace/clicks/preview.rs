//! Finds a quick path from a click to the mouse pointer. It is not centred, and not always the cheapest path.

use glam::DVec3;

use crate::trace::clicks::gaps::LONGEST_GAP;
use crate::trace::clicks::way::{Way, start};
use crate::trace::lumen::surroundings::Surroundings;
use crate::trace::ways::front::{Found, Front, Reach};
use crate::trace::ways::region::{FORBIDDEN, Region, Stopper, Strictness, WEAK};
use crate::voxels::Voxels;
use lumencut_core::stop::Stop;

/// Maximum number of voxels of a search front. Fronts are cached while the pointer moves.
const MOST_VOXELS: usize = 4_000_000;

/// Weights of the straight distance to the target: first a fast search, then the exact one if the fast path
/// crosses a wall. With 1.5, a path of 290 mm visits 65,000 voxels instead of 101,000; more saves little.
const PULLS: [f32; 2] = [1.5, 1.0];

/// Number of smoothing rounds, which hide the steps between voxels.
const ROUNDS: usize = 6;

/// The path to find for a preview.
#[derive(Clone, Copy, Debug)]
pub struct Sought<'a> {
    /// Position of the click, and of the mouse pointer (mm, LPS).
    pub between: [DVec3; 2],
    /// Balls that no path may enter.
    pub stoppers: &'a [Stopper],
    /// Whether the path may cross parts without lumen.
    pub bridge: bool,
}

#[derive(Debug)]
pub(crate) struct Live {
    click: DVec3,
    region: Region,
    fronts: [Front; 2],
}

impl Live {
    /// Reuses the known region if its lumen model fits the click; None if the click is not in lumen.
    pub(crate) fn new(
        voxels: &Voxels,
        sought: &Sought,
        surroundings: Option<Surroundings>,
        known: Option<&Region>,
    ) -> Option<Self> {
        let [click, _] = sought.between;
        voxels.voxel_at(click)?;
        let surroundings = surroundings.unwrap_or_else(|| Surroundings::of(voxels, &[click]));
        let taken = surroundings.snapped(voxels, &[click]);
        let model = surroundings.model(voxels, &taken).ok()?;
        let fits = |region: &&Region| region.model.covers(&model) && region.stoppers == sought.stoppers;
        let made = || Region::new(voxels.size, model, sought.stoppers.to_vec(), Strictness::Lumen);
        let mut region = known.filter(fits).cloned().unwrap_or_else(made);
        let source = start(voxels, &mut region, taken[0]);
        let fronts = PULLS.map(|pull| {
            let reach = Reach { longest_gap: Some(LONGEST_GAP), most_voxels: MOST_VOXELS, pull };
            Front::new(voxels, &mut region, source, reach)
        });
        Some(Self { click, region, fronts })
    }

    pub(crate) fn is_from(&self, sought: &Sought) -> bool {
        self.click == sought.between[0] && self.region.stoppers == sought.stoppers
    }

    pub(crate) fn way(&mut self, voxels: &Voxels, sought: &Sought, stop: Stop) -> Option<Vec<DVec3>> {
        let Self { region, fronts, .. } = self;
        voxels.voxel_at(sought.between[1])?;
        let target = start(voxels, region, sought.between[1]);
        let code = region.code_of(voxels, target);
        if code == FORBIDDEN || code >= region.code_below(WEAK) {
            return None;
        }
        for front in fronts {
            // For a preview, any path that already reaches the target is good enough.
            let is_found = front.has_come_to(target)
                || matches!(front.grow(voxels, region, target, stop, &|_| ()), Ok(Found::Target));
            let way = is_found.then(|| Way::of(voxels, region, &front.way_to(target)))?;
            if sought.bridge || way.gaps.iter().all(|gap| !gap.is_open) {
                return Some(eased(&way, sought.between));
            }
        }
        None
    }
}

fn eased(way: &Way, [from, to]: [DVec3; 2]) -> Vec<DVec3> {
    let mut points = way.straightened();
    if points.len() < 2 {
        return vec![from, to];
    }
    let last = points.len() - 1;
    (points[0], points[last]) = (from, to);
    for _ in 0..ROUNDS {
        let before = points.clone();
        for n in 1..last {
            points[n] = (before[n - 1] + 2.0 * before[n] + before[n + 1]) / 4.0;
        }
    }
    points
}
