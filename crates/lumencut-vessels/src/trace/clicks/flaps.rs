//! Paths that no flap crosses, for vessels with two lumens. Everything a little brighter than tissue counts as lumen, and
//! the path must be free: values neither dip nor change quickly along it.

use glam::DVec3;

use crate::trace::clicks::gaps::LONGEST_GAP;
use crate::trace::clicks::paths::Search;
use crate::trace::clicks::way::start;
use crate::trace::lumen::lumen_model::{LumenModel, lower_median};
use crate::trace::lumen::surroundings::noise;
use crate::trace::ways::front::{Found, Front, Reach};
use crate::trace::ways::region::{Region, Strictness};
use lumencut_core::error::Result;

/// Contrast (HU) of the dimmest lumen, such as a false lumen that contrast medium hardly reaches.
const LEAST_CONTRAST_HU: f64 = 20.0;

/// Maximum cost per mm of a free path, in the mean and at each step; in the middle of a lumen it is 1. In a dissection
/// the mean was 1.00 to 1.17 within the false lumen, and 1.23 to 2.7 from tissue outside.
const MOST_IN_MEAN: f64 = 1.2;
const MOST_AT_A_STEP: f64 = 4.0;

/// Lumen is clear if the mean within this distance (voxels) is above this fraction of the contrast, as in sections.
const AROUND: f64 = 1.75;
const LEAST_CLEAR: f64 = 0.35;

/// Around a click in dim lumen, the line is a guess up to this distance at least (mm).
const NEAR_DIM: f64 = 3.0;

/// Maximum number of voxels of a front.
const MOST_VOXELS: usize = 4_000_000;

/// The region of one vessel in which flaps are barriers.
pub(crate) struct Flaps {
    region: Region,
    /// The clear lumen, with the noise of its values alone: the spread at a click may be that of two lumens.
    pub lumen: LumenModel,
}

impl Flaps {
    /// `model` describes the clear lumen.
    pub(crate) fn new(search: &Search, model: LumenModel, clicks: &[DVec3]) -> Self {
        let clear = clicks.iter().filter(|click| !search.dim.contains(click));
        let noises: Vec<f64> = clear.map(|click| noise(search.voxels, *click)).collect();
        let lumen = LumenModel { noise: lower_median(noises), ..model };
        let low =
            if lumen.is_hounsfield { lumen.low.min(lumen.tissue + LEAST_CONTRAST_HU) } else { lumen.low };
        let dim = LumenModel { low, ..lumen };
        let lumen = LumenModel { noise: lumen.noise.min(lumen.contrast() / 8.0), ..lumen };
        let stoppers = search.clicks.stoppers.clone();
        Self { region: Region::new(search.voxels.size, dim, stoppers, Strictness::Flaps), lumen }
    }

    /// Whether the mean value around a place is too low for clear lumen.
    pub(crate) fn is_dim(&self, search: &Search, place: DVec3) -> bool {
        let near = search.voxels.ball(place, AROUND * search.voxels.smallest_side);
        let mean = near.iter().map(|(_, value)| f64::from(*value)).sum::<f64>() / near.len() as f64;
        let is_clear = mean > self.lumen.tissue + LEAST_CLEAR * self.lumen.contrast();
        !is_clear || search.dim.iter().any(|dim| dim.distance(place) < NEAR_DIM)
    }

    /// Voxels of the cheapest path between two clicks; None if it is not free.
    pub(crate) fn free_way(&mut self, search: &Search, between: [DVec3; 2]) -> Result<Option<Vec<[i32; 3]>>> {
        let (voxels, region) = (search.voxels, &mut self.region);
        let [source, target] = between.map(|click| start(voxels, region, click));
        let reach = Reach { longest_gap: Some(LONGEST_GAP), most_voxels: MOST_VOXELS, pull: 1.0 };
        let mut front = Front::new(voxels, region, source, reach);
        if front.grow(voxels, region, target, search.stop, &|_| ())? != Found::Target {
            return Ok(None);
        }
        let steps = front.way_to(target);
        let is_free = |from: [i32; 3], to: [i32; 3], most: f64| {
            front.cost_between(from, to) <= most * voxels.center(from).distance(voxels.center(to))
        };
        let length: f64 =
            steps.windows(2).map(|step| voxels.center(step[0]).distance(voxels.center(step[1]))).sum();
        let is_free = front.cost_between(source, target) <= MOST_IN_MEAN * length
            && steps.windows(2).all(|step| is_free(step[0], step[1], MOST_AT_A_STEP));
        Ok(is_free.then_some(steps))
    }
}
