//! Measures a vessel in steps: intensity scale, approximate lumen, levels, and finally each section.

mod read;

use std::sync::OnceLock;

use rayon::prelude::*;

use super::bright_wall::{BrightWall, include_bright};
use super::request::MeasureRequest;
use super::{Profile, TreeFindings};
use crate::measure::along::assumed_spread::AssumedSpread;
use crate::measure::along::calcified::settle;
use crate::measure::along::contradicted::flag_contradicted;
use crate::measure::along::dim_plaque::flag_dim_plaque;
use crate::measure::along::point_spread::{MIN_WIDTH, SharpEdges, SpreadEstimate, estimated};
use crate::measure::along::rings::flag_stents;
use crate::measure::along::struts::flag_struts;
use crate::measure::along::throats::Throats;
use crate::measure::along::{flag_sharp_turns, sharpen};
use crate::measure::beside::branches::{Lumen, meets};
use crate::measure::estimation::Level;
use crate::measure::fit::Fit;
use crate::measure::fit::sections::{Bench, Known, center, noise};
use crate::measure::flap::lumen_pairs;
use crate::measure::model::wall::KnownWall;
use crate::measure::outer::outer_walls;
use crate::measure::section::blur::Blur;
use crate::measure::section::flags::{BRANCH, NO_EDGE, OUTSIDE};
use crate::measure::section::lumen_estimate::LumenEstimate;
use crate::measure::section::measured_part::MeasuredPart;
use crate::measure::section::rays::Rays;
use crate::measure::section::scale::{Scale, in_words};
use crate::measure::section::slab::thickness;
use crate::measure::section::{SectionPlane, Track, known_radius};
use crate::measure::uncertainty::texture::{Pairs, Texture};
use crate::measure::wall::pool::{is_apart, pooled, unpooled_level};
use crate::measure::wall::tree::{PooledWall, wall_beside};
use crate::measure::wall::{BRIGHT_WALL, WallSource, expected, is_airway, is_below_lumen, is_hounsfield};
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::statistics::median;
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::vessel_tree::Vessel;

/// Number of sections that decide whether walls are visible.
const WALL_SECTIONS: usize = 48;

/// Number of sections from which the noise texture is estimated.
const TEXTURE_SECTIONS: usize = 32;

/// Minimum distance of separately fitted sections, in blur widths; closer sections contain the same voxels.
const FIT_SPACING: f64 = 0.7;

/// Minimum radius (mm) around the centerline in which the lumen is searched.
const MIN_SEARCH_MM: f64 = 3.0;

const MAX_RADIUS_MM: f64 = 45.0;

/// Separate fits for one point spread; `hidden` is the possible wall if none is visible.
#[derive(Clone)]
struct FirstFits {
    fwhm: f64,
    hidden: Option<KnownWall>,
    fits: Vec<Option<Fit>>,
    texture: Texture,
}

pub(crate) struct PreparedVessel {
    part: MeasuredPart,
    pub(super) scale: Scale,
    /// The point spread to assume if none is given or found.
    pub(super) assumed: AssumedSpread,
    pub(super) wall: Option<KnownWall>,
    pub(super) wall_source: WallSource,
    places: Vec<SectionPlane>,
    estimates: Vec<Option<LumenEstimate>>,
    /// Separate fits for the assumed point spread, and for the estimated or given one.
    first: [OnceLock<FirstFits>; 2],
}

impl PreparedVessel {
    pub(crate) fn new(voxels: &Voxels, vessel: &Vessel, request: &MeasureRequest) -> Result<Self> {
        let first = Track::new(vessel, None)?.places(request.step)?;
        let known = known_radius(vessel);
        let part = MeasuredPart::of(voxels, &first, known)?;
        let scale = part.scale;
        let (wall, wall_source) = expected(voxels, &scale, request.wall)?;
        let widest = known.map_or(MAX_RADIUS_MM, |radius| (3.0 * radius + 5.0).min(MAX_RADIUS_MM));
        let search = known.unwrap_or(0.0).max(MIN_SEARCH_MM);
        let is_ct = is_hounsfield(voxels, &scale) || is_airway(voxels, &scale);
        let assumed = AssumedSpread::of(voxels.world_from_index.matrix3, is_ct);
        let bench = bench(voxels, scale, wall, assumed.fwhm[0]);
        let mut estimates = bench.estimates(&first, search, widest, request.stop)?;
        for (estimate, place) in estimates.iter_mut().zip(&first) {
            *estimate = estimate.filter(|_| part.holds(place));
        }
        let mut radii: Vec<f64> = estimates.iter().flatten().map(|one| one.radius).collect();
        let radius = median(&mut radii).ok_or_else(|| no_lumen(&scale))?;
        let places = Track::new(vessel, Some(radius))?.places(request.step)?;
        Ok(Self {
            part,
            scale,
            assumed,
            wall,
            wall_source,
            places,
            estimates: tamed(&estimates),
            first: Default::default(),
        })
    }

    /// Returns the separate fits for a point spread (FWHM, mm), and caches them.
    fn kept_fits(&self, voxels: &Voxels, fwhm: f64, stop: Stop) -> Result<FirstFits> {
        let kept = self.first.iter().filter_map(OnceLock::get).find(|first| first.fwhm == fwhm);
        if let Some(kept) = kept {
            return Ok(kept.clone());
        }
        let found = self.fitted(voxels, fwhm).1.first_fits(voxels, fwhm, stop)?;
        let free = self.first.iter().find(|first| first.get().is_none());
        if let Some(free) = free {
            free.get_or_init(|| found.clone());
        }
        Ok(found)
    }

    /// Separate fits of all sections for a point spread (FWHM, mm). Some sections decide first whether walls
    /// are visible. If walls are as bright as their surroundings, all sections are fitted without a wall.
    fn first_fits(&self, voxels: &Voxels, fwhm: f64, stop: Stop) -> Result<FirstFits> {
        let mut bench = bench(voxels, self.scale, self.wall, fwhm);
        let Some(known) = self.wall else {
            let fits = bench.first_fits(&self.places, &self.estimates, stop)?;
            return self.textured(&bench, None, fits, stop);
        };
        let every = self.places.len().div_ceil(WALL_SECTIONS).max(1);
        let some = self.part(|n| n % every == 0);
        let fits = bench.first_fits(&some.places, &some.estimates, stop)?;
        if let Some(hidden) = some.hidden_wall(&bench, &known, &fits, stop)? {
            bench.wall = None;
            let fits = bench.first_fits(&self.places, &self.estimates, stop)?;
            return self.textured(&bench, Some(hidden), fits, stop);
        }
        let others = self.part(|n| n % every != 0);
        let (mut these, mut those) =
            (fits.into_iter(), bench.first_fits(&others.places, &others.estimates, stop)?.into_iter());
        let merged = (0..self.places.len()).map(|n| if n % every == 0 { these.next() } else { those.next() });
        self.textured(&bench, None, merged.map(Option::flatten).collect(), stop)
    }

    fn textured(
        &self,
        bench: &Bench,
        hidden: Option<KnownWall>,
        fits: Vec<Option<Fit>>,
        stop: Stop,
    ) -> Result<FirstFits> {
        let texture = self.texture(bench, &fits, noise(&fits), stop)?;
        Ok(FirstFits { fwhm: bench.fwhm, hidden, fits, texture })
    }

    fn bench<'a, 'v>(&self, voxels: &'a Voxels<'v>, fwhm: f64, hidden: Option<KnownWall>) -> Bench<'a, 'v> {
        bench(voxels, self.scale, self.wall.filter(|_| hidden.is_none()), fwhm)
    }

    /// Interval of the sections that are fitted separately for a point spread (FWHM, mm), and the vessel
    /// reduced to them.
    fn fitted(&self, voxels: &Voxels, fwhm: f64) -> (usize, Self) {
        let blur = Blur::new(fwhm, voxels.world_from_index.matrix3);
        let width = self.places.iter().map(|place| blur.width(place)).fold(f64::INFINITY, f64::min);
        let step = self.places.last().map_or(0.0, |last| last.at) / (self.places.len().max(2) - 1) as f64;
        let every = ((FIT_SPACING * width / step) as usize).max(1);
        (every, self.part(|n| n % every == 0))
    }

    fn part(&self, is_one: impl Fn(usize) -> bool) -> Self {
        let kept = || (0..self.places.len()).filter(|n| is_one(*n));
        Self {
            places: kept().map(|n| self.places[n]).collect(),
            estimates: kept().map(|n| self.estimates[n]).collect(),
            first: Default::default(),
            ..*self
        }
    }

    /// The same vessel as if it had no wall.
    pub(super) fn bare(&self) -> Self {
        Self { wall: None, ..self.part(|_| true) }
    }

    pub(super) fn with_bright_wall(&self) -> Self {
        let wall = Some(KnownWall::of(BRIGHT_WALL, &self.scale));
        Self { wall, wall_source: WallSource::Bright, ..self.part(|_| true) }
    }

    /// A wall that may exist although it is as bright as its surroundings; None if walls are visible.
    fn hidden_wall(
        &self,
        bench: &Bench,
        known: &KnownWall,
        fits: &[Option<Fit>],
        stop: Stop,
    ) -> Result<Option<KnownWall>> {
        let inflation = self.inflation(bench, &self.texture(bench, fits, noise(fits), stop)?);
        let walls = pooled(&self.arc_lengths(), fits, known, known.level, inflation);
        let hidden = walls.first().map(|wall| KnownWall { log_thickness: None, slope: 0.0, ..*wall });
        Ok(hidden.filter(|_| !is_apart(known, &walls, fits)))
    }

    fn arc_lengths(&self) -> Vec<f64> {
        self.places.iter().map(|place| place.at).collect()
    }

    pub(crate) fn point_spread(&self, voxels: &Voxels, stop: Stop) -> Result<SpreadEstimate> {
        let found = self.shown_spread(voxels, MIN_WIDTH, stop)?;
        let SpreadEstimate::Width(with_wall) = found else { return Ok(found) };
        let without_wall = self.spread_without_wall(voxels, stop)?;
        Ok(SpreadEstimate::Width(SharpEdges { without_wall, ..with_wall }))
    }

    /// The point spread that sections at least `min_width` times as wide show.
    pub(super) fn shown_spread(&self, voxels: &Voxels, min_width: f64, stop: Stop) -> Result<SpreadEstimate> {
        let assumed = self.assumed.fwhm[0];
        let (_, fitted) = self.fitted(voxels, assumed);
        let FirstFits { hidden, fits, .. } = self.kept_fits(voxels, assumed, stop)?;
        estimated(&self.bench(voxels, assumed, hidden), min_width, &fitted.places, &fits, stop)
    }

    /// Wall level (in the volume's unit) that the sections show without their prior; None if walls are not visible.
    pub(crate) fn wall_level(&self, voxels: &Voxels, fwhm: f64, stop: Stop) -> Result<Option<Level>> {
        let Some(known) = self.wall else { return Ok(None) };
        let FirstFits { hidden, fits, texture, .. } = self.kept_fits(voxels, fwhm, stop)?;
        if hidden.is_some() {
            return Ok(None);
        }
        let (_, fitted) = self.fitted(voxels, fwhm);
        let inflation = fitted.inflation(&self.bench(voxels, fwhm, None), &texture);
        let level = unpooled_level(&fitted.arc_lengths(), &fits, &known, inflation);
        Ok(level.map(|[mean, deviation]| [self.scale.value(mean), deviation * self.scale.contrast.abs()]))
    }

    pub(crate) fn profile(
        &self,
        voxels: &Voxels,
        vessel: &Vessel,
        request: &MeasureRequest,
        findings: TreeFindings,
    ) -> Result<Profile> {
        let by_others = self.wall_by_others(&findings, request.tree, vessel);
        let spread = findings.spread;
        let mut read = self.read(voxels, [spread.fwhm, spread.deviation], by_others, request.stop)?;
        self.include_other_spreads(voxels, &mut read.sections, &spread, request.stop)?;
        if !read.is_wall_hidden {
            self.include_thin_walls(voxels, &mut read.sections, &spread, request.stop)?;
        }
        let mut sections = std::mem::take(&mut read.sections);
        let bright = self.bright_wall(voxels, &sections, &spread, request.stop)?;
        if let Some(BrightWall::Shown(bright, spread)) = bright {
            let findings = TreeFindings { spread, walls: Vec::new() };
            return bright.profile(voxels, vessel, request, findings);
        }
        if let Some(BrightWall::Possible(bright)) = &bright {
            include_bright(&mut sections, bright);
        }
        let others = Lumen::of_others(request.tree, vessel);
        for (n, section) in sections.iter_mut().enumerate() {
            section.flags |= self.branch(n, section.fit.as_ref(), &others);
            if voxels.at(self.places[n].origin).is_nan() {
                section.flags |= OUTSIDE;
            }
        }
        if sections.iter().all(|section| section.flags & NO_EDGE > 0) {
            return Err(no_lumen(&self.scale));
        }
        let (bench, noise) = (&read.bench, read.noise);
        let is_in_lung = self.wall.is_some_and(|wall| wall.is_in_lung);
        if is_hounsfield(voxels, &self.scale) && !is_in_lung {
            flag_struts(bench, &self.places, &mut sections);
        }
        if let Some(wall) = bench.wall.as_ref().filter(|wall| !wall.is_airway) {
            flag_dim_plaque(&self.places, &mut sections, &read.lumen, wall.level[0]);
        }
        let variance: Vec<f64> =
            self.places.iter().map(|place| bench.blur.along(place, thickness(voxels, place))).collect();
        sharpen(&mut sections, &self.arc_lengths(), &variance);
        flag_sharp_turns(&self.places, &mut sections);
        settle(&self.places, &mut sections, bench.fwhm);
        if !self.wall.is_some_and(|wall| wall.is_airway) {
            flag_contradicted(bench, &self.places, &mut sections);
        }
        Throats { bench, places: &self.places, lumen: &read.lumen, noise }.limit(&mut sections);
        flag_stents(bench, &self.places, &mut sections);
        let wall_source = match by_others {
            _ if read.is_wall_hidden => WallSource::AsBright,
            _ if bright.is_some() => WallSource::PerhapsBright,
            Some(by_others) => self.wall_source.pooled(by_others),
            None => self.wall_source,
        };
        let noise = noise * self.scale.contrast.abs();
        let profile = Profile::new(&self.places, &sections, &self.scale, noise, spread, wall_source);
        let is_ct = is_hounsfield(voxels, &self.scale);
        let middle = self.wall.filter(|_| is_ct).map(|wall| {
            let [level, deviation] = wall.level;
            [self.scale.value(level), deviation * self.scale.contrast.abs()]
        });
        let found = outer_walls(voxels, (&profile.inner(&self.places), middle), &bench.blur, request.stop)?;
        let profile = profile.with_outer(found);
        let on_line = profile.on_line(&self.places, self.scale.value(1.0));
        let found = lumen_pairs(voxels, (&on_line, middle), (&bench.blur, profile.noise), request.stop)?;
        let profile = profile.with_lumen_pairs(found);
        let line_values = self.places.iter().map(|place| f64::from(voxels.at(place.origin))).collect();
        Ok(Profile { line_values, without_wall: self.part.left_out(&self.places), ..profile })
    }

    fn wall_by_others(
        &self,
        findings: &TreeFindings,
        tree: &[Vessel],
        vessel: &Vessel,
    ) -> Option<PooledWall> {
        let by_others = wall_beside(&findings.walls, tree, vessel, self.wall_source.expected()?)?;
        is_below_lumen(&by_others, &self.scale).then_some(by_others)
    }

    /// Factor by which the correlation of noise increases the variance of wall estimates.
    fn inflation(&self, bench: &Bench, texture: &Texture) -> f64 {
        let sides = bench.rays.voxels.world_from_index.matrix3;
        self.places.first().map_or(1.0, |place| texture.inflation(sides, bench.blur.width(place)))
    }

    fn texture(&self, bench: &Bench, fits: &[Option<Fit>], noise: f64, stop: Stop) -> Result<Texture> {
        let every = fits.len().div_ceil(TEXTURE_SECTIONS).max(1);
        let some: Vec<usize> = (0..fits.len()).step_by(every).collect();
        let pairs = |n: &usize| {
            go_on(stop)?;
            let Some(fit) = &fits[*n] else { return Ok(None) };
            let known = Known { ellipse: fit.ellipse, lumen: fit.lumen, noise: Some(noise), wall: None };
            Ok(bench.pairs(&self.places[*n], &known, fit))
        };
        let found: Vec<Option<Pairs>> = some.par_iter().map(pairs).collect::<Result<_>>()?;
        let all = found.into_iter().flatten().reduce(|all, pairs| all.with(&pairs));
        Ok(all.map_or_else(Texture::white, |all| Texture::of(&all)))
    }

    fn branch(&self, n: usize, fit: Option<&Fit>, others: &[Lumen]) -> u32 {
        let Some(fit) = fit else { return 0 };
        let place = &self.places[n];
        let is_met = meets(place, center(place, fit), fit.ellipse.mean, others);
        if is_met { BRANCH } else { 0 }
    }
}

fn bench<'a, 'v>(voxels: &'a Voxels<'v>, scale: Scale, wall: Option<KnownWall>, fwhm: f64) -> Bench<'a, 'v> {
    let blur = Blur::new(fwhm, voxels.world_from_index.matrix3);
    Bench { rays: Rays { voxels, scale }, blur, fwhm, wall, doubt: None }
}

fn no_lumen(scale: &Scale) -> Error {
    let [lumen, outside] = [scale.value(1.0), scale.outside];
    let found =
        format!("no wall around it: {} on the vessel and {} next to it", in_words(lumen), in_words(outside));
    let expected = "a lumen around the points of the vessel";
    let mend = "centerlines must lie in the lumen or within one radius of it";
    Error::new(ErrorKind::Measuring, "lumen of the vessel", found, expected).mend(mend)
}

fn too_noisy(scale: &Scale, noise: f64) -> Error {
    let [lumen, outside, noise] =
        [scale.value(1.0), scale.outside, noise * scale.contrast.abs()].map(in_words);
    let found =
        format!("no wall around it: {lumen} on the vessel and {outside} next to it, with noise of {noise}");
    let expected = "a lumen that differs from its surroundings by twice the noise";
    let mend = "smooth the volume, and check that the centerlines lie in the lumen";
    Error::new(ErrorKind::Measuring, "lumen of the vessel", found, expected).mend(mend)
}

/// Limits radii much larger than those of their neighbours, because rays escape where a branch starts.
fn tamed(estimates: &[Option<LumenEstimate>]) -> Vec<Option<LumenEstimate>> {
    /// Number of neighbours on each side, and the maximum ratio of a radius to their median.
    const AROUND: (usize, f64) = (6, 1.5);
    (0..estimates.len())
        .map(|n| {
            let around = &estimates[n.saturating_sub(AROUND.0)..(n + AROUND.0 + 1).min(estimates.len())];
            let mut radii: Vec<f64> = around.iter().flatten().map(|one| one.radius).collect();
            let middle = median(&mut radii)?;
            estimates[n].map(|one| LumenEstimate { radius: one.radius.min(AROUND.1 * middle), ..one })
        })
        .collect()
}
