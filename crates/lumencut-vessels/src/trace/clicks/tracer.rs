//! Traces centerlines between clicks. Paths are cached, so a changed click affects only the paths next to it.

use std::collections::HashMap;

use glam::DVec3;

use crate::trace::clicks::Traced;
use crate::trace::clicks::checks::{Clicks, check, check_place};
use crate::trace::clicks::gaps::{LONGEST_GAP, Line, no_lumen, no_way};
use crate::trace::clicks::junctions::joined;
use crate::trace::clicks::preview::{Live, Sought};
use crate::trace::clicks::way::{Way, start};
use crate::trace::lines::nearest_point;
use crate::trace::lumen::lumen_model::{LumenModel, in_words};
use crate::trace::lumen::refine::refined;
use crate::trace::lumen::surroundings::Surroundings;
use crate::trace::lumen::wander::without_wander;
use crate::trace::ways::front::{Found, Front, Reach};
use crate::trace::ways::region::{Region, Stopper, Strictness};
use crate::voxels::Voxels;
use lumencut_core::error::{Clicked, Error, Result};
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::volume::Volume;

/// Maximum number of voxels of a front (7 bytes each), and of a search that only explains why no path exists.
const MOST_VOXELS: usize = 40_000_000;
const MOST_VOXELS_OF_DOUBT: usize = 4_000_000;

/// Number of fronts cached for the mouse pointer: one for each neighbour of a dragged point.
const MOST_LIVE: usize = 2;

type Ends = [[i32; 3]; 2];

/// Caches the fronts of clicks, and the paths between clicks, for one volume.
#[derive(Debug, Default)]
pub struct Tracer {
    surroundings: Option<Surroundings>,
    region: Option<Region>,
    fronts: HashMap<[i32; 3], Front>,
    ways: HashMap<Ends, Way>,
    lines: Vec<(Vec<DVec3>, Traced)>,
    /// Fronts for the pointer, the most recently used one first.
    live: Vec<Live>,
}

struct Search<'a, 'v> {
    voxels: &'a Voxels<'v>,
    clicks: &'a Clicks,
    stop: Stop<'a>,
    progress: Option<&'a Progress>,
}

impl Tracer {
    /// Traces all vessels of `clicks`, in order. A later vessel that meets an earlier one ends at a point of
    /// the earlier one. Every call must use the same volume. Errors: `ErrorKind::Tracing` for clicks outside
    /// lumen, or without lumen between them; `ErrorKind::Interrupted`.
    pub fn trace(
        &mut self,
        volume: &Volume,
        clicks: &Clicks,
        stop: Stop,
        progress: Option<&Progress>,
    ) -> Result<Vec<Traced>> {
        let voxels = &Voxels::new(volume);
        check(voxels, clicks)?;
        let surroundings = self.surroundings_of(voxels, &all_of(clicks));
        let clicks = &snapped(voxels, surroundings, clicks);
        self.prepare(voxels, surroundings, clicks)?;
        let search = Search { voxels, clicks, stop, progress };
        if let Some(progress) = progress {
            progress.expect_views(clicks.vessels.iter().map(|points| points.len() - 1).sum());
        }
        let mut lines = Vec::with_capacity(clicks.vessels.len());
        for points in &clicks.vessels {
            let line = match self.lines.iter().find(|(known, _)| known == points) {
                Some((_, line)) => line.clone(),
                None => self.line(&search, points)?,
            };
            lines.push((points.clone(), line));
        }
        self.lines = lines;
        self.tidy(voxels, clicks);
        joined(&clicks.beside, self.lines.iter().map(|(_, line)| line.clone()).collect())
    }

    /// Quick path through the lumen to the pointer. None if `stop` comes first, or if [`Tracer::trace`] would
    /// reject the path. The fronts of the last two clicks are cached. Every call must use the traced volume.
    pub fn preview(&mut self, volume: &Volume, sought: &Sought, stop: Stop) -> Option<Vec<DVec3>> {
        let voxels = &Voxels::new(volume);
        let known = self.live.iter().position(|live| live.is_from(sought));
        let kept = known.map(|number| self.live.remove(number));
        let begin = || Live::new(voxels, sought, self.surroundings, self.region.as_ref());
        let mut live = kept.or_else(begin)?;
        let way = live.way(voxels, sought, stop);
        self.live.truncate(MOST_LIVE - 1);
        self.live.insert(0, live);
        way
    }

    /// Checks a single first click as [`Tracer::trace`] would in the same volume. Errors:
    /// `ErrorKind::Tracing` for a click outside the volume, or with a value that cannot be lumen.
    pub fn check_click(&self, volume: &Volume, click: DVec3) -> Result<()> {
        let voxels = &Voxels::new(volume);
        check_place(voxels, click, || (format!("point {}", in_words(click)), Clicked::Single))?;
        let surroundings = self.surroundings_of(voxels, &[click]);
        let taken = surroundings.snapped(voxels, &[click]);
        surroundings.check_alone(voxels, taken[0])
    }

    fn surroundings_of(&self, voxels: &Voxels, clicks: &[DVec3]) -> Surroundings {
        self.surroundings.unwrap_or_else(|| Surroundings::of(voxels, clicks))
    }

    /// Fits the lumen model to the clicks, and drops caches that were made with a different model.
    fn prepare(&mut self, voxels: &Voxels, surroundings: Surroundings, clicks: &Clicks) -> Result<()> {
        let model = surroundings.model(voxels, &all_of(clicks))?;
        // The surroundings are stored only after the check, because those of rejected clicks would mislead
        // later ones.
        self.surroundings = Some(surroundings);
        let fits = |region: &Region| region.model.covers(&model);
        if !self.region.as_ref().is_some_and(fits) {
            *self = Self { surroundings: Some(surroundings), ..Self::default() };
            self.region = Some(Region::new(voxels.size, model, clicks.stoppers.clone(), Strictness::Lumen));
        }
        self.heed(voxels, &clicks.stoppers);
        Ok(())
    }

    fn heed(&mut self, voxels: &Voxels, stoppers: &[Stopper]) {
        let Some(region) = &mut self.region else { return };
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
            self.lines.clear();
        }
    }

    fn tidy(&mut self, voxels: &Voxels, clicks: &Clicks) {
        let known: Vec<[i32; 3]> =
            clicks.vessels.iter().flatten().filter_map(|click| voxels.voxel_at(*click)).collect();
        self.fronts.retain(|source, _| known.contains(source));
        self.ways.retain(|ends, _| ends.iter().all(|end| known.contains(end)));
    }

    fn line(&mut self, search: &Search, clicks: &[DVec3]) -> Result<Traced> {
        let mut points: Vec<DVec3> = Vec::new();
        let mut open: Vec<bool> = Vec::new();
        for pair in clicks.windows(2) {
            let way = self.way(search, [pair[0], pair[1]])?;
            let mut is_open = vec![false; way.points.len()];
            for gap in way.gaps.iter().filter(|gap| gap.is_open) {
                is_open[gap.points.clone()].fill(true);
            }
            let skip = usize::from(!points.is_empty());
            points.extend(&way.straightened()[skip..]);
            open.extend(&is_open[skip..]);
        }
        let Some(region) = &self.region else { return Err(Error::interrupted()) };
        let line = refined(search.voxels, &region.model, &points, search.stop)?;
        let mut line = without_wander(search.voxels, &region.model, line, search.stop)?;
        let bridged: Vec<bool> =
            line.points.iter().map(|point| open[nearest_point(&points, *point)]).collect();
        for (confidence, is_bridged) in line.confidence.iter_mut().zip(&bridged) {
            if *is_bridged {
                *confidence = 0.0;
            }
        }
        let ends = [clicks[0], clicks[clicks.len() - 1]];
        let crossing = Line::new(search.voxels, &region.model, &line.points).crossing();
        if let Some(crossing) = crossing.filter(|_| !search.clicks.bridge) {
            return Err(no_lumen(ends, &crossing, &region.model));
        }
        Ok(Traced { line, bridged, ends })
    }

    fn way(&mut self, search: &Search, between: [DVec3; 2]) -> Result<Way> {
        let Some(region) = &mut self.region else { return Err(Error::interrupted()) };
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

fn all_of(clicks: &Clicks) -> Vec<DVec3> {
    clicks.vessels.iter().flatten().copied().collect()
}

fn snapped(voxels: &Voxels, surroundings: Surroundings, clicks: &Clicks) -> Clicks {
    let mut places = surroundings.snapped(voxels, &all_of(clicks)).into_iter();
    let vessels = clicks.vessels.iter().map(|points| places.by_ref().take(points.len()).collect());
    Clicks { vessels: vessels.collect(), ..clicks.clone() }
}
