//! The paths between clicks through one region, and the centerlines along them. Paths are cached, so a changed click
//! affects only the paths next to it.

use std::collections::HashMap;

use glam::DVec3;

use crate::trace::clicks::Traced;
use crate::trace::clicks::checks::Clicks;
use crate::trace::clicks::gaps::{LONGEST_GAP, Line, no_lumen, no_way};
use crate::trace::clicks::way::{Way, start};
use crate::trace::lines::nearest_point;
use crate::trace::lumen::lumen_model::LumenModel;
use crate::trace::lumen::refine::refined;
use crate::trace::lumen::wander::without_wander;
use crate::trace::ways::front::{Found, Front, Reach};
use crate::trace::ways::region::{Region, Stopper, Strictness};
use crate::voxels::Voxels;
use lumencut_core::error::{Error, Result};
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;

/// Maximum number of voxels of a front (7 bytes each), and of a search that only explains why no path exists.
const MOST_VOXELS: usize = 40_000_000;
const MOST_VOXELS_OF_DOUBT: usize = 4_000_000;

type Ends = [[i32; 3]; 2];

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
    let line = without_wander(search.voxels, model, line, search.stop)?;
    let bridged = line.points.iter().map(|point| open[nearest_point(&points, *point)]).collect();
    Ok(Traced::new(line, bridged, clicks))
}
