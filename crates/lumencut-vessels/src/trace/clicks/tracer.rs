//! Traces centerlines between clicks.

use glam::DVec3;

use crate::trace::clicks::Traced;
use crate::trace::clicks::checks::{Clicks, check, check_place};
use crate::trace::clicks::dim::model_beside_dim;
use crate::trace::clicks::flaps::Flaps;
use crate::trace::clicks::junctions::joined;
use crate::trace::clicks::paths::{Paths, Search};
use crate::trace::clicks::preview::{Live, Sought};
use crate::trace::lumen::level_change::level_change;
use crate::trace::lumen::lumen_model::in_words;
use crate::trace::lumen::surroundings::Surroundings;
use crate::trace::lumen::wall_crossing::wall_crossings;
use crate::trace::ways::region::{Region, Strictness};
use crate::voxels::Voxels;
use lumencut_core::error::{Clicked, Error, ErrorKind, Result};
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::volume::Volume;

/// Number of fronts cached for the mouse pointer: one for each neighbour of a dragged point.
const MOST_LIVE: usize = 2;

/// Caches the fronts of clicks, and the paths between clicks, for one volume.
#[derive(Debug, Default)]
pub struct Tracer {
    surroundings: Option<Surroundings>,
    paths: Option<Paths>,
    lines: Vec<(Vec<DVec3>, Traced)>,
    /// Fronts for the pointer, the most recently used one first.
    live: Vec<Live>,
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
        let dim = self.prepare(voxels, surroundings, clicks)?;
        let search = Search { voxels, clicks, dim: &dim, stop, progress };
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
        let region = self.paths.as_ref().map(|paths| &paths.region);
        let begin = || Live::new(voxels, sought, self.surroundings, region);
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
        surroundings.check_first(voxels, taken[0])
    }

    fn surroundings_of(&self, voxels: &Voxels, clicks: &[DVec3]) -> Surroundings {
        self.surroundings.unwrap_or_else(|| Surroundings::of(voxels, clicks))
    }

    fn prepare(
        &mut self,
        voxels: &Voxels,
        surroundings: Surroundings,
        clicks: &Clicks,
    ) -> Result<Vec<DVec3>> {
        let (model, dim) = model_beside_dim(voxels, &surroundings, clicks)?;
        // The surroundings are stored only after the check, because those of rejected clicks would mislead
        // later ones.
        self.surroundings = Some(surroundings);
        let fits = |paths: &Paths| paths.region.model.covers(&model);
        if !self.paths.as_ref().is_some_and(fits) {
            let region = Region::new(voxels.size, model, clicks.stoppers.clone(), Strictness::Lumen);
            *self =
                Self { surroundings: Some(surroundings), paths: Some(Paths::new(region)), ..Self::default() };
        }
        if self.paths.as_mut().is_some_and(|paths| paths.heed(voxels, &clicks.stoppers)) {
            self.lines.clear();
        }
        Ok(dim)
    }

    fn tidy(&mut self, voxels: &Voxels, clicks: &Clicks) {
        let known: Vec<[i32; 3]> =
            clicks.vessels.iter().flatten().filter_map(|click| voxels.voxel_at(*click)).collect();
        if let Some(paths) = &mut self.paths {
            paths.tidy(&known);
        }
    }

    /// The line through clear lumen. Where it is refused, or seems to enter another lumen, the line that crosses no flap
    /// is taken, if there is one. A vessel with a click in dim lumen has no other line.
    fn line(&mut self, search: &Search, clicks: &[DVec3]) -> Result<Traced> {
        let Some(paths) = &mut self.paths else { return Err(Error::interrupted()) };
        let dim = clicks.iter().find(|click| search.dim.contains(click));
        let first = match dim {
            Some(dim) => Err(no_free_way(*dim)),
            None => paths.line(search, clicks),
        };
        let flaps = Flaps::new(search, paths.region.model, clicks);
        match first {
            Ok(traced) if search.clicks.bridge => Ok(traced),
            Ok(traced) => {
                let met = flaps.met(&traced.line);
                let crosses = |traced: &Traced| {
                    let crossings = wall_crossings(search.voxels, &traced.line);
                    crossings.iter().any(|crossing| !traced.bridged[crossing.at])
                };
                let is_doubted = met.is_some() || level_change(search.voxels, &traced.line).is_some();
                if !is_doubted && !crosses(&traced) {
                    return Ok(traced);
                }
                let second = flaps.line(clicks)?.filter(|second| {
                    (met.is_none() || flaps.met(&second.line).is_none()) && (is_doubted || !crosses(second))
                });
                Ok(second.unwrap_or_else(|| {
                    let met = met.unwrap_or_default();
                    let bridged = traced
                        .bridged
                        .iter()
                        .enumerate()
                        .map(|(n, is_guess)| *is_guess || met.get(n) == Some(&true));
                    Traced::new(traced.line, bridged.collect(), clicks)
                }))
            }
            Err(error) if error.kind == ErrorKind::Tracing => flaps.line(clicks)?.ok_or(error),
            Err(error) => Err(error),
        }
    }
}

fn no_free_way(dim: DVec3) -> Error {
    let found = "tissue, or dim lumen without a path to the other points that stays within the same walls";
    let subject = format!("point {}", in_words(dim));
    Error::new(ErrorKind::Tracing, subject, found, "lumen")
        .about(Clicked::Single)
        .mend("click where the lumen is clear")
}

fn all_of(clicks: &Clicks) -> Vec<DVec3> {
    clicks.vessels.iter().flatten().copied().collect()
}

fn snapped(voxels: &Voxels, surroundings: Surroundings, clicks: &Clicks) -> Clicks {
    let mut places = surroundings.snapped(voxels, &all_of(clicks)).into_iter();
    let vessels = clicks.vessels.iter().map(|points| places.by_ref().take(points.len()).collect());
    Clicks { vessels: vessels.collect(), ..clicks.clone() }
}
