//! Lines that no flap crosses, for vessels with several lumens. Everything a little brighter than tissue counts as lumen,
//! and the path must be free: values neither dip nor change quickly along it.

use glam::DVec3;

use crate::trace::clicks::Traced;
use crate::trace::clicks::gaps::LONGEST_GAP;
use crate::trace::clicks::paths::Search;
use crate::trace::clicks::way::start;
use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::even_steps::in_even_steps;
use crate::trace::lines::nearest_point;
use crate::trace::lines::smoothing::smoothed_by_gaussian;
use crate::trace::lumen::cross_section::Probe;
use crate::trace::lumen::lumen_model::{LumenModel, lower_median};
use crate::trace::lumen::refine::{STEP, refined_by};
use crate::trace::lumen::surroundings::noise;
use crate::trace::lumen::wander::wandering;
use crate::trace::ways::barrier::Valleys;
use crate::trace::ways::front::{Found, Front, Reach};
use crate::trace::ways::region::{Region, Strictness};
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::arc_lengths;

/// Contrast (HU) of the dimmest lumen, such as a false lumen that contrast medium hardly reaches.
const LEAST_CONTRAST_HU: f64 = 20.0;

/// Maximum cost per mm of a free path, in the mean and at each step; in the middle of a lumen it is 1. In a dissection
/// the mean was 1.00 to 1.17 within the false lumen, and 1.23 to 2.7 from tissue outside.
const MOST_IN_MEAN: f64 = 1.2;
const MOST_AT_A_STEP: f64 = 2.5;

/// Lumen is clear if the mean within this distance (voxels) is above this fraction of the contrast, as in sections.
const AROUND: f64 = 1.75;
const LEAST_CLEAR: f64 = 0.35;

/// Around a click in dim lumen, the line is a guess up to this distance at least (mm).
const NEAR_DIM: f64 = 3.0;

/// Fall of values at a flap, a fraction of the contrast: thinner than a voxel, it falls by less than a wall. But it falls
/// by this multiple of the noise at least.
const FALL: f64 = 0.25;
const FALL_NOISES: f64 = 2.5;
const MOST_FALL: f64 = 0.5;

/// Values this fraction of the contrast above the lumen belong to a brighter lumen (a probe asks for four noises).
const MOST_NOISE: f64 = 0.125;

/// Standard deviation of the smoothing of a path (mm); a centred line is at most this much longer than the path.
const PATH_SMOOTHING: f64 = 3.0;
const MOST_LONGER: f64 = 1.15;

/// A line meets flaps if it runs within them for this length (mm), in HU and otherwise. In healthy vessels it was 2.5 mm
/// at most, and 5.5 mm between the struts of a stent in 8-bit values.
const IN_FLAPS_HU: f64 = 3.0;
const IN_FLAPS: f64 = 10.0;

const MOST_VOXELS: usize = 4_000_000;

pub(crate) struct Flaps<'a, 'v> {
    search: &'a Search<'a, 'v>,
    /// The clear lumen, with the noise of its values alone: the spread at a click may be that of two lumens.
    lumen: LumenModel,
}

impl<'a, 'v> Flaps<'a, 'v> {
    pub(crate) fn new(search: &'a Search<'a, 'v>, model: LumenModel, clicks: &[DVec3]) -> Self {
        let clear = clicks.iter().filter(|click| !search.dim.contains(click));
        let noises: Vec<f64> = clear.map(|click| noise(search.voxels, *click)).collect();
        Self { search, lumen: LumenModel { noise: lower_median(noises), ..model } }
    }

    pub(crate) fn met(&self, line: &Centerline) -> Option<Vec<bool>> {
        let marks = self.in_flaps(line);
        let least = if self.lumen.is_hounsfield { IN_FLAPS_HU } else { IN_FLAPS };
        (length_of(line, &marks) >= least).then_some(marks)
    }

    fn in_flaps(&self, line: &Centerline) -> Vec<bool> {
        let voxels = self.search.voxels;
        let valleys = Valleys::new(voxels, &self.lumen);
        let mut last = None;
        let is_in = |place: &DVec3| {
            let voxel = voxels.voxel_at(*place)?;
            let is_in =
                last.filter(|(at, _)| *at == voxel).map_or_else(|| valleys.hold(voxel), |(_, is_in)| is_in);
            last = Some((voxel, is_in));
            Some(is_in)
        };
        line.points.iter().map(is_in).map(|is_in| is_in == Some(true)).collect()
    }

    /// The line through clicks that crosses no flap, and no edge of a lumen however dim; None if there is none.
    pub(crate) fn line(&self, clicks: &[DVec3]) -> Result<Option<Traced>> {
        let voxels = self.search.voxels;
        let mut region = self.region();
        let mut path = vec![voxels.center(start(voxels, &mut region, clicks[0]))];
        for pair in clicks.windows(2) {
            let Some(steps) = self.free_way(&mut region, [pair[0], pair[1]])? else { return Ok(None) };
            path.extend(steps[1..].iter().map(|voxel| voxels.center(*voxel)));
        }
        let line = self.line_along(&path)?;
        let bridged = line.points.iter().map(|place| self.is_dim(*place)).collect();
        Ok(Some(Traced::new(line, bridged, clicks)))
    }

    fn region(&self) -> Region {
        let LumenModel { low, tissue, is_hounsfield, .. } = self.lumen;
        let low = if is_hounsfield { low.min(tissue + LEAST_CONTRAST_HU) } else { low };
        let stoppers = self.search.clicks.stoppers.clone();
        Region::new(self.search.voxels.size, LumenModel { low, ..self.lumen }, stoppers, Strictness::Flaps)
    }

    fn line_along(&self, path: &[DVec3]) -> Result<Centerline> {
        let contrast = self.lumen.contrast();
        let model = LumenModel { noise: self.lumen.noise.min(MOST_NOISE * contrast), ..self.lumen };
        let fall = FALL.max(FALL_NOISES * self.lumen.noise / contrast).min(MOST_FALL);
        let probe = Probe { voxels: self.search.voxels, model: &model, rays: 0, fall };
        let centred = refined_by(&probe, path, self.search.stop)?;
        let smooth = smoothed_by_gaussian(path, &vec![PATH_SMOOTHING; path.len()], false);
        let points = in_even_steps(&smooth, STEP);
        let nearest: Vec<usize> = points.iter().map(|place| nearest_point(&centred.points, *place)).collect();
        let of = |values: &[f64]| nearest.iter().map(|n| values[*n]).collect();
        let plain = Centerline { radius: of(&centred.radius), confidence: of(&centred.confidence), points };
        let length = |line: &Centerline| arc_lengths(&line.points)[line.points.len() - 1];
        let is_calm =
            length(&centred) <= MOST_LONGER * length(&plain) && !wandering(&centred).contains(&true);
        let is_better = is_calm
            && !plain.points.iter().any(|place| self.is_dim(*place))
            && length_of(&centred, &self.in_flaps(&centred)) <= length_of(&plain, &self.in_flaps(&plain));
        Ok(if is_better { centred } else { plain })
    }

    fn is_dim(&self, place: DVec3) -> bool {
        let near = self.search.voxels.ball(place, AROUND * self.search.voxels.smallest_side);
        let mean = near.iter().map(|(_, value)| f64::from(*value)).sum::<f64>() / near.len() as f64;
        let is_clear = mean > self.lumen.tissue + LEAST_CLEAR * self.lumen.contrast();
        !is_clear || self.search.dim.iter().any(|dim| dim.distance(place) < NEAR_DIM)
    }

    fn free_way(&self, region: &mut Region, between: [DVec3; 2]) -> Result<Option<Vec<[i32; 3]>>> {
        let voxels = self.search.voxels;
        let [source, target] = between.map(|click| start(voxels, region, click));
        let reach = Reach { longest_gap: Some(LONGEST_GAP), most_voxels: MOST_VOXELS, pull: 1.0 };
        let mut front = Front::new(voxels, region, source, reach);
        if front.grow(voxels, region, target, self.search.stop, &|_| ())? != Found::Target {
            return Ok(None);
        }
        let steps = front.way_to(target);
        let length = |step: &[[i32; 3]]| voxels.center(step[0]).distance(voxels.center(step[1]));
        let whole: f64 = steps.windows(2).map(length).sum();
        let is_free = front.cost_between(source, target) <= MOST_IN_MEAN * whole
            && steps
                .windows(2)
                .all(|step| front.cost_between(step[0], step[1]) <= MOST_AT_A_STEP * length(step));
        Ok(is_free.then_some(steps))
    }
}

fn length_of(line: &Centerline, marks: &[bool]) -> f64 {
    let steps = line.points.windows(2).zip(marks).filter(|(_, is_marked)| **is_marked);
    steps.map(|(step, _)| step[0].distance(step[1])).sum()
}
