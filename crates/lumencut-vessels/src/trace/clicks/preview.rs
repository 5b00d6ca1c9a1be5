//! The way that a vessel would take to where a pointer is: quick enough to follow it, and neither in the middle of the lumen
//! yet nor always the cheapest one.

use glam::DVec3;

use crate::trace::clicks::gaps::LONGEST_GAP;
use crate::trace::clicks::way::{Way, start};
use crate::trace::lumen::surroundings::Surroundings;
use crate::trace::ways::front::{Found, Front, Reach};
use crate::trace::ways::region::{FORBIDDEN, Region, Stopper, Strictness, WEAK};
use crate::voxels::Voxels;
use lumencut_core::stop::Stop;

/// How many voxels a front may come to: it is kept while the pointer moves.
const MOST_VOXELS: usize = 4_000_000;

/// How much the fronts are pulled to the pointer. The first one hurries; where it comes through the wall of a vessel instead of
/// around, the second one says what the cheapest way is.
const PULLS: [f32; 2] = [1.5, 1.0];

/// How often each point moves to the middle of its neighbours, so that no step from voxel to voxel is seen.
const ROUNDS: usize = 6;

/// A way that is looked for.
#[derive(Clone, Copy, Debug)]
pub struct Sought<'a> {
    /// From a click to where the pointer is (mm, LPS).
    pub between: [DVec3; 2],
    /// Places that no way may pass.
    pub stoppers: &'a [Stopper],
    /// Whether a way over a stretch without lumen counts too.
    pub bridge: bool,
}

/// The fronts of a click from which ways are looked for.
#[derive(Debug)]
pub struct Live {
    click: DVec3,
    region: Region,
    fronts: [Front; 2],
}

impl Live {
    /// The fronts of the click from which a way is sought, with what is known of the volume already where that fits the
    /// click; none where the click lies in no lumen.
    pub fn new(
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

    /// Whether they are the fronts of the click from which a way is sought.
    pub fn is_from(&self, sought: &Sought) -> bool {
        self.click == sought.between[0] && self.region.stoppers == sought.stoppers
    }

    /// The way that is sought, where there is one before `stop` says so.
    pub fn way(&mut self, voxels: &Voxels, sought: &Sought, stop: Stop) -> Option<Vec<DVec3>> {
        let Self { region, fronts, .. } = self;
        voxels.voxel_at(sought.between[1])?;
        let target = start(voxels, region, sought.between[1]);
        let code = region.code_of(voxels, target);
        if code == FORBIDDEN || code >= region.code_below(WEAK) {
            return None;
        }
        for front in fronts {
            // A way that the front has come to already is as good to look at as the cheapest one.
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

/// The points of a way between two places, each moved towards its neighbours.
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
