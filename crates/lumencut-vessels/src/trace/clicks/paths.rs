//! The paths between clicks through one region, and the centerlines along them. Paths are cached, so a changed click
//! affects only the paths next to it.

use std::collections::HashMap;

use glam::DVec3;

use crate::trace::clicks::Traced;
use crate::trace::clicks::checks::Clicks;
use crate::trace::clicks::flaps::Flaps;
use crate::trace::clicks::gaps::{LONGEST_GAP, Line, no_lumen, no_way};
use crate::trace::clicks::way::{Way, start};
use crate::trace::lines::even_steps::in_even_steps;
use crate::trace::lines::nearest_point;
use crate::trace::lines::smoothing::smoothed_by_gaussian;
use crate::trace::lumen::lumen_model::LumenModel;
use crate::trace::lumen::refine::{STEP, refined};
use crate::trace::lumen::wander::without_wander;
use crate::trace::ways::front::{Found, Front, Reach};
use crate::trace::ways::region::{Region, Stopper, Strictness};
use crate::voxels::Voxels;
use lumencut_core::error::{Error, Result};
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;

/// Maximum number of voxels of a front (7 bytes each), and of a search that only explains why no path exists.
const MOST_VOXELS: usize = 40_000_000;
const MOST_VOXELS_OF_DOUBT: usize = 4_000_000;

/// Standard deviation of the smoothing of a path (mm), and the distance from a guess at which the line is no longer held.
const HELD_SMOOTHING: f64 = 3.0;
const HELD_FADES: f64 = 5.0;

type Ends = [[i32; 3]; 2];

/// A region with the fronts of clicks, and the paths between clicks.
#[derive(Debug)]
pub(crate) struct Paths {
    pub region: Region,
    fronts: HashMap<[i32; 3], Front>,
    ways: HashMap<Ends, Way>,
}

/// The path between two clicks: its points, and whether each lies where no lumen is seen.
struct Part {
    points: Vec<DVec3>,
    is_open: Vec<bool>,
}

pub(crate) struct Search<'a, 'v> {
    pub voxels: &'a Voxels<'v>,
    pub clicks: &'a Clicks,
    /// The clicks in dim lumen.
    pub dim: &'a [DVec3],
    pub stop: Stop<'a>,
    pub progress: Option<&'a Progress>,
}

impl Paths {
    pub(crate) fn new(region: Region) -> Self {
        Self { region, fronts: HashMap::new(), ways: HashMap::new() }
    }

    /// Takes over stoppers; returns whether they differ from those of before.
    pub(crate) fn heed(&mut self, voxels: &Voxels, stoppers: &[Stopper]) -> bool {
        let region = &mut self.region;
        let before = std::mem::replace(&mut region.stoppers, stoppers.to_vec());
        let one_sided = |a: &[Stopper], b: &[Stopper]| -> Vec<Stopper> {
            a.iter().filter(|stopper| !b.contains(stopper)).copied().collect()
        };
        let changed = [one_sided(&before, stoppers), one_sided(stoppers, &before)].concat();
        for stopper in &changed {
            region.forget(voxels, stopper);
            self.fronts.retain(|_, front| !front.touches(voxels, stopper.center, stopper.radius));
        }
        if !changed.is_empty() {
            self.ways.clear();
        }
        !changed.is_empty()
    }

    /// Drops what belongs to none of the `known` clicks.
    pub(crate) fn tidy(&mut self, known: &[[i32; 3]]) {
        self.fronts.retain(|source, _| known.contains(source));
        self.ways.retain(|ends, _| ends.iter().all(|end| known.contains(end)));
    }

    /// The centerline through clicks. Errors: `ErrorKind::Tracing` without lumen between them.
    pub(crate) fn line(&mut self, search: &Search, clicks: &[DVec3]) -> Result<Traced> {
        let mut parts = Vec::with_capacity(clicks.len() - 1);
        for pair in clicks.windows(2) {
            let way = self.way(search, [pair[0], pair[1]])?;
            parts.push(Part { is_open: way.is_open(), points: way.straightened() });
        }
        let traced = centered(search, &self.region.model, clicks, &parts)?;
        let crossing = Line::new(search.voxels, &self.region.model, &traced.line.points).crossing();
        match crossing.filter(|_| !search.clicks.bridge) {
            Some(crossing) => Err(no_lumen(traced.ends, &crossing, &self.region.model)),
            None => Ok(traced),
        }
    }

    /// The centerline through clicks that crosses no flap, and no edge of a lumen however dim; None if there is none.
    pub(crate) fn line_without_flaps(&self, search: &Search, clicks: &[DVec3]) -> Result<Option<Traced>> {
        let mut flaps = Flaps::new(search, self.region.model, clicks);
        let mut parts = Vec::with_capacity(clicks.len() - 1);
        for pair in clicks.windows(2) {
            let Some(steps) = flaps.free_way(search, [pair[0], pair[1]])? else { return Ok(None) };
            let points: Vec<DVec3> = steps.iter().map(|voxel| search.voxels.center(*voxel)).collect();
            let is_open = points.iter().map(|place| flaps.is_dim(search, *place)).collect();
            parts.push(Part { points, is_open });
        }
        Ok(Some(held(centered(search, &flaps.lumen, clicks, &parts)?, &parts)))
    }

    fn way(&mut self, search: &Search, between: [DVec3; 2]) -> Result<Way> {
        let region = &mut self.region;
        let ends = between.map(|click| start(search.voxels, region, click));
        if let Some(way) = self.ways.get(&ends) {
            return Ok(way.clone());
        }
        let backwards = !self.fronts.contains_key(&ends[0]) && self.fronts.contains_key(&ends[1]);
        let [source, target] = if backwards { [ends[1], ends[0]] } else { ends };
        let reach = Reach { longest_gap: Some(LONGEST_GAP), most_voxels: MOST_VOXELS, pull: 1.0 };
        let front =
            self.fronts.entry(source).or_insert_with(|| Front::new(search.voxels, region, source, reach));
        let found = search.grow(front, region, target)?;
        let mut way = None;
        if found == Found::Target {
            let mut steps = front.way_to(target);
            if backwards {
                steps.reverse();
            }
            way = Some(Way::of(search.voxels, region, &steps));
        }
        let whole = match way {
            Some(way) if way.gaps.iter().all(|gap| !gap.is_open) => way,
            Some(way) if search.clicks.bridge => way,
            Some(way) => return Err(refusal(between, &way, &region.model)),
            None => search.bridge(region, between, ends)?,
        };
        self.ways.insert(ends, whole.clone());
        Ok(whole)
    }
}

impl Search<'_, '_> {
    fn grow(&self, front: &mut Front, region: &mut Region, target: [i32; 3]) -> Result<Found> {
        let whole = self.voxels.center(front.source()).distance(self.voxels.center(target)).max(1.0);
        if let Some(progress) = self.progress {
            progress.begin_view(std::iter::once(1), PARTS);
            progress.begin_stage(1);
        }
        let reported = std::cell::Cell::new(0);
        let found = front.grow(self.voxels, region, target, self.stop, &|left| {
            let parts = ((1.0 - left / whole).clamp(0.0, 1.0) * PARTS as f64) as usize;
            if let Some(progress) = self.progress {
                progress.begin_pixels(parts.saturating_sub(reported.replace(parts.max(reported.get()))));
            }
        });
        if let Some(progress) = self.progress {
            progress.end_view();
        }
        found
    }

    /// Bridges parts without lumen if requested; otherwise returns an error that states where they are.
    fn bridge(&self, region: &Region, between: [DVec3; 2], ends: Ends) -> Result<Way> {
        let model = region.model;
        let stoppers = self.clicks.stoppers.clone();
        let mut lenient = Region::new(self.voxels.size, model, stoppers, Strictness::Bridge);
        let most_voxels = if self.clicks.bridge { MOST_VOXELS } else { MOST_VOXELS_OF_DOUBT };
        let reach = Reach { longest_gap: None, most_voxels, pull: 1.0 };
        let mut front = Front::new(self.voxels, &mut lenient, ends[0], reach);
        if front.grow(self.voxels, &mut lenient, ends[1], self.stop, &|_| ())? != Found::Target {
            return Err(no_way(between, &model));
        }
        let way = Way::of(self.voxels, &mut lenient, &front.way_to(ends[1]));
        if self.clicks.bridge { Ok(way) } else { Err(refusal(between, &way, &model)) }
    }
}

const PARTS: usize = 1000;

fn refusal(between: [DVec3; 2], way: &Way, model: &LumenModel) -> Error {
    let longest = way.gaps.iter().max_by(|a, b| a.length.total_cmp(&b.length));
    longest.map_or_else(|| no_way(between, model), |gap| no_lumen(between, gap, model))
}

fn centered(search: &Search, model: &LumenModel, clicks: &[DVec3], parts: &[Part]) -> Result<Traced> {
    let first = |part: usize| usize::from(part > 0);
    let points: Vec<DVec3> =
        parts.iter().enumerate().flat_map(|(n, part)| &part.points[first(n)..]).copied().collect();
    let open: Vec<bool> =
        parts.iter().enumerate().flat_map(|(n, part)| &part.is_open[first(n)..]).copied().collect();
    let line = refined(search.voxels, model, &points, search.stop)?;
    let mut line = without_wander(search.voxels, model, line, search.stop)?;
    let bridged: Vec<bool> = line.points.iter().map(|point| open[nearest_point(&points, *point)]).collect();
    for (confidence, is_bridged) in line.confidence.iter_mut().zip(&bridged) {
        if *is_bridged {
            *confidence = 0.0;
        }
    }
    Ok(Traced { line, bridged, ends: [clicks[0], clicks[clicks.len() - 1]] })
}

/// The line with its guesses on the path itself, because sections beside them must not pull them. The path is smoothed.
fn held(traced: Traced, parts: &[Part]) -> Traced {
    if !traced.bridged.contains(&true) {
        return traced;
    }
    let path: Vec<DVec3> = parts.iter().flat_map(|part| part.points.iter().copied()).collect();
    let path = in_even_steps(&smoothed_by_gaussian(&path, &vec![HELD_SMOOTHING; path.len()], false), STEP);
    let Traced { mut line, bridged, ends } = traced;
    let lengths = arc_lengths(&line.points);
    let guesses: Vec<f64> = (0..bridged.len()).filter(|n| bridged[*n]).map(|n| lengths[n]).collect();
    for (point, length) in line.points.iter_mut().zip(&lengths) {
        let away = guesses.iter().map(|guess| (guess - length).abs()).fold(f64::MAX, f64::min);
        let share = (1.0 - away / HELD_FADES).max(0.0);
        *point = point.lerp(path[nearest_point(&path, *point)], share);
    }
    Traced { line, bridged, ends }.in_even_steps()
}
