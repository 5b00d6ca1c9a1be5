//! How a vessel is measured: its scale, its lumen by and large, the point spread, the levels, and then each section.

use glam::DVec3;
use rayon::prelude::*;

use super::along::sharpen;
use super::blur::Blur;
use super::branches::{Lumen, meets};
use super::ellipse::Ellipse;
use super::fit::Fit;
use super::flags::{BRANCH, NO_EDGE, OUTSIDE};
use super::levels::lumen_levels;
use super::place::{Place, Track, known_radius};
use super::point_spread::{NARROW, SharpEdges, Told, estimated};
use super::pooled::Level;
use super::profile::{PointSpread, Profile, Source};
use super::rays::Rays;
use super::restless::flag_restless;
use super::rough::Rough;
use super::scale::Scale;
use super::sections::{Bench, Doubt, Known, LEAST_CONTRAST, Section, center, noise};
use super::slab::thickness;
use super::texture::{Pairs, Texture};
use super::wall::KnownWall;
use super::wall_level::{WallRequest, WallSource, expected};
use super::wall_pool::{is_apart, pooled};
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::limits::Limits;
use lumencut_core::math::statistics::median;
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;

/// The distance of sections unless somebody asks for another one (mm), at most.
pub const STEP: f64 = 0.5;

const FWHM: Limits = Limits::new(0.0, 20.0, "mm");

/// Without any other knowledge the point spread is assumed to be this wide (sides of a voxel).
const DEFAULT_FWHM: f64 = 1.2;

/// The standard deviation of a point spread that is assumed, as a share of it.
const ASSUMED: f64 = 0.2;

/// Whether walls are told apart is said by this number of sections.
const WALL_SECTIONS: usize = 48;

/// The texture of the noise is told by this number of sections.
const TEXTURE: usize = 32;

/// How far from its vessel a lumen is looked for (mm), at least.
const SEARCH: f64 = 3.0;

/// The widest lumen (mm from its middle to its wall).
const WIDEST: f64 = 45.0;

/// The point spread is estimated from at most this number of vessels of a tree, the widest ones.
const MOST_ASKED: usize = 8;

/// How a vessel is measured.
#[derive(Clone, Copy)]
pub struct MeasureRequest<'a> {
    /// The distance of sections (mm), at most.
    pub step: f64,
    /// The full width at half maximum of the scanner's point spread (mm), where known.
    pub fwhm: Option<f64>,
    /// The level of walls.
    pub wall: WallRequest,
    /// The vessels of the tree that the vessel is of; it may be one of them.
    pub tree: &'a [Vessel],
    /// Asked whether to stop.
    pub stop: Stop<'a>,
}

/// The profile of a vessel.
///
/// # Errors
/// [`ErrorKind::Measuring`] for a vessel outside the volume or without a lumen, [`ErrorKind::Settings`] for a step or a width of
/// the point spread that is invalid, [`ErrorKind::VesselTree`] for a vessel without length, [`ErrorKind::Interrupted`].
pub fn measure(volume: &Volume, vessel: &Vessel, request: &MeasureRequest) -> Result<Profile> {
    check(request)?;
    let voxels = Voxels::new(volume);
    let looked = Looked::new(&voxels, vessel, request)?;
    let spread = point_spread(&voxels, &looked, request)?;
    looked.profile(&voxels, vessel, request, spread)
}

/// The profile of a vessel under the point spread that [`point_spread_of`] found for its tree: the same as that of [`measure`],
/// which finds it anew.
///
/// # Errors
/// As [`measure`].
pub fn measure_under(
    spread: PointSpread,
    volume: &Volume,
    vessel: &Vessel,
    request: &MeasureRequest,
) -> Result<Profile> {
    let voxels = Voxels::new(volume);
    Looked::new(&voxels, vessel, request)?.profile(&voxels, vessel, request, spread)
}

fn check(request: &MeasureRequest) -> Result<()> {
    request.wall.check()?;
    let Some(fwhm) = request.fwhm else { return Ok(()) };
    FWHM.check("fwhm", fwhm)?;
    if fwhm > 0.0 {
        return Ok(());
    }
    Err(Error::new(ErrorKind::Settings, "fwhm", format!("{fwhm} mm"), "a width above 0 mm, or none"))
}

/// The point spread: as it is given, as the tree tells it for all that is measured in its scan, or, where there is no tree, as the
/// vessel itself tells it.
fn point_spread(voxels: &Voxels, looked: &Looked, request: &MeasureRequest) -> Result<PointSpread> {
    match request.fwhm {
        Some(fwhm) => Ok(given(fwhm)),
        None if !request.tree.is_empty() => of_tree(voxels, request),
        None => Ok(match looked.point_spread(voxels, request.stop)? {
            Told::Width(found) => told(&found, found.on()),
            Told::Nothing(reason) => default(voxels, reason),
        }),
    }
}

/// The point spread of a scan (FWHM, mm), as it is given or as the widest vessels of the tree tell it, and where it is from: the
/// same for all that is measured along the tree, its vessels and paths through several of them.
///
/// # Errors
/// [`ErrorKind::Settings`] for an invalid width, [`ErrorKind::Interrupted`].
pub fn point_spread_of(volume: &Volume, request: &MeasureRequest) -> Result<PointSpread> {
    check(request)?;
    match request.fwhm {
        Some(fwhm) => Ok(given(fwhm)),
        None => of_tree(&Voxels::new(volume), request),
    }
}

fn of_tree(voxels: &Voxels, request: &MeasureRequest) -> Result<PointSpread> {
    let radius = |n: &usize| known_radius(&request.tree[*n]).unwrap_or(0.0);
    let mut order: Vec<usize> = (0..request.tree.len()).collect();
    order.sort_by(|a, b| radius(b).total_cmp(&radius(a)).then(a.cmp(b)));
    let mut why = NARROW;
    for n in order.into_iter().take(MOST_ASKED) {
        go_on(request.stop)?;
        // A vessel that cannot be measured tells nothing.
        let wide = match Looked::new(voxels, &request.tree[n], request) {
            Ok(wide) => wide,
            Err(error) if error.kind == ErrorKind::Interrupted => return Err(error),
            Err(_) => continue,
        };
        match wide.point_spread(voxels, request.stop)? {
            Told::Width(found) => {
                let on = format!("{} of vessel {n} of the tree", found.on());
                return Ok(told(&found, on));
            }
            Told::Nothing(NARROW) => {}
            Told::Nothing(reason) => why = reason,
        }
    }
    Ok(default(voxels, why))
}

fn given(fwhm: f64) -> PointSpread {
    PointSpread { fwhm, deviation: 0.0, source: Source::Given }
}

fn told(found: &SharpEdges, on: String) -> PointSpread {
    PointSpread { fwhm: found.fwhm, deviation: found.deviation, source: Source::Estimated { on } }
}

fn default(voxels: &Voxels, reason: &str) -> PointSpread {
    let from = format!("{DEFAULT_FWHM} sides of a voxel, as {reason}");
    let fwhm = assumed(voxels);
    PointSpread { fwhm, deviation: ASSUMED * fwhm, source: Source::Assumed { from } }
}

/// What the sections of a vessel tell by themselves and together.
struct AllSections {
    fits: Vec<Option<Fit>>,
    noise: f64,
    lumen: Vec<Level>,
    walls: Option<Vec<KnownWall>>,
    texture: Texture,
}

/// A vessel before it is fitted.
struct Looked {
    scale: Scale,
    wall: Option<KnownWall>,
    wall_source: WallSource,
    places: Vec<Place>,
    rough: Vec<Option<Rough>>,
}

impl Looked {
    fn new(voxels: &Voxels, vessel: &Vessel, request: &MeasureRequest) -> Result<Self> {
        let first = Track::new(vessel, None)?.places(request.step)?;
        let known = known_radius(vessel);
        let scale = Scale::of(voxels, &first, known)?;
        let (wall, wall_source) = expected(voxels, &scale, request.wall)?;
        let widest = known.map_or(WIDEST, |radius| (3.0 * radius + 5.0).min(WIDEST));
        let search = known.unwrap_or(0.0).max(SEARCH);
        let bench = bench(voxels, scale, wall, assumed(voxels));
        let rough = bench.rough(&first, search, widest, request.stop)?;
        let mut radii: Vec<f64> = rough.iter().flatten().map(|rough| rough.radius).collect();
        let radius = median(&mut radii).ok_or_else(|| no_lumen(&scale))?;
        let places = Track::new(vessel, Some(radius))?.places(request.step)?;
        Ok(Self { scale, wall, wall_source, places, rough: tamed(&rough) })
    }

    /// The wall that may be there where it is not told apart, as it is as bright as its surroundings: some of the sections say so
    /// under a point spread (FWHM, mm).
    fn hidden_wall(&self, voxels: &Voxels, fwhm: f64, stop: Stop) -> Result<Option<KnownWall>> {
        let Some(known) = self.wall else { return Ok(None) };
        let every = self.places.len().div_ceil(WALL_SECTIONS).max(1);
        let places: Vec<Place> = self.places.iter().copied().step_by(every).collect();
        let rough: Vec<Option<Rough>> = self.rough.iter().copied().step_by(every).collect();
        let some = Self { places, rough, ..*self };
        let bench = bench(voxels, self.scale, self.wall, fwhm);
        let fits = bench.first_fits(&some.places, &some.rough, stop)?;
        let inflation = some.inflation(&bench, &some.texture(&bench, &fits, noise(&fits), stop)?);
        let at: Vec<f64> = some.places.iter().map(|place| place.at).collect();
        let told = pooled(&at, &fits, &known, inflation);
        let hidden = told.first().map(|wall| KnownWall { log_thickness: None, slope: 0.0, ..*wall });
        Ok(hidden.filter(|_| !is_apart(&known, &told, &fits)))
    }

    fn point_spread(&self, voxels: &Voxels, stop: Stop) -> Result<Told> {
        let hidden = self.hidden_wall(voxels, assumed(voxels), stop)?;
        let wall = self.wall.filter(|_| hidden.is_none());
        let bench = bench(voxels, self.scale, wall, assumed(voxels));
        let fits = bench.first_fits(&self.places, &self.rough, stop)?;
        estimated(&bench, voxels.world_from_index.matrix3, &self.places, &fits, stop)
    }

    fn profile(
        &self,
        voxels: &Voxels,
        vessel: &Vessel,
        request: &MeasureRequest,
        spread: PointSpread,
    ) -> Result<Profile> {
        let stop = request.stop;
        let hidden = self.hidden_wall(voxels, spread.fwhm, stop)?;
        let wall_source = if hidden.is_some() { WallSource::AsBright } else { self.wall_source };
        let wall = self.wall.filter(|_| hidden.is_none());
        let mut bench = bench(voxels, self.scale, wall, spread.fwhm);
        let all = self.all_sections(&bench, stop)?;
        let wider = (spread.deviation > 0.0)
            .then(|| Blur::new(spread.fwhm + spread.deviation, voxels.world_from_index.matrix3));
        let AllSections { fits, noise, lumen, walls, texture } = all;
        bench.doubt = Some(Doubt { texture, wider, wall: hidden });
        let others = Lumen::of_others(request.tree, vessel);
        let section = |n: usize| {
            go_on(stop)?;
            let place = &self.places[n];
            let rough = self.rough[n].map(|rough| Ellipse::circle(rough.center, rough.radius));
            let mut section = match fits[n].map(|fit| fit.ellipse).or(rough) {
                Some(ellipse) => {
                    let wall = walls.as_ref().map(|walls| walls[n]);
                    bench.section(place, &Known { ellipse, lumen: lumen[n], noise: Some(noise), wall })
                }
                None => Section::none(),
            };
            section.flags |= self.branch(n, section.fit.as_ref(), &others);
            if voxels.at(place.origin).is_nan() {
                section.flags |= OUTSIDE;
            }
            Ok(section)
        };
        let mut sections: Vec<Section> =
            (0..self.places.len()).into_par_iter().map(section).collect::<Result<_>>()?;
        if sections.iter().all(|section| section.flags & NO_EDGE > 0) {
            return Err(no_lumen(&self.scale));
        }
        let at: Vec<f64> = self.places.iter().map(|place| place.at).collect();
        let variance: Vec<f64> =
            self.places.iter().map(|place| bench.blur.along(place, thickness(voxels, place))).collect();
        sharpen(&mut sections, &at, &variance);
        flag_restless(&self.places, &mut sections);
        let noise = noise * self.scale.contrast.abs();
        Ok(Profile::new(&self.places, &sections, &self.scale, noise, spread, wall_source))
    }

    /// The sections by themselves, and what they tell together.
    fn all_sections(&self, bench: &Bench, stop: Stop) -> Result<AllSections> {
        let fits = bench.first_fits(&self.places, &self.rough, stop)?;
        let noise = noise(&fits);
        if LEAST_CONTRAST * noise > 1.0 {
            return Err(no_lumen(&self.scale));
        }
        let lumen = lumen_levels(bench, &self.places, &fits, stop)?;
        let texture = self.texture(bench, &fits, noise, stop)?;
        let inflation = self.inflation(bench, &texture);
        let at: Vec<f64> = self.places.iter().map(|place| place.at).collect();
        let walls = bench.wall.map(|known| pooled(&at, &fits, &known, inflation));
        Ok(AllSections { fits, noise, lumen, walls, texture })
    }

    /// By how much what walls tell varies more than with independent noise.
    fn inflation(&self, bench: &Bench, texture: &Texture) -> f64 {
        let sides = bench.rays.voxels.world_from_index.matrix3;
        self.places.first().map_or(1.0, |place| texture.inflation(sides, bench.blur.width(place)))
    }

    /// The texture of the noise, from what fits miss.
    fn texture(&self, bench: &Bench, fits: &[Option<Fit>], noise: f64, stop: Stop) -> Result<Texture> {
        let every = fits.len().div_ceil(TEXTURE).max(1);
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

    /// The flag of a section within the lumen of another vessel.
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

/// The point spread where nothing is known of it (FWHM, mm): by the middle one of the three sides of a voxel.
fn assumed(voxels: &Voxels) -> f64 {
    let sides = voxels.world_from_index.matrix3;
    let mut lengths = [sides.x_axis, sides.y_axis, sides.z_axis].map(DVec3::length);
    DEFAULT_FWHM * median(&mut lengths).unwrap_or_default()
}

fn no_lumen(scale: &Scale) -> Error {
    let [lumen, outside] = [scale.value(1.0), scale.outside];
    let found = format!("no wall around it: {lumen:.4} on the vessel and {outside:.4} beside it");
    let expected = "a lumen around the points of the vessel";
    let mend = "centerlines must lie in the lumen, or within its radius of it";
    Error::new(ErrorKind::Measuring, "lumen of the vessel", found, expected).mend(mend)
}

/// Rough lumens that are far wider than those around them are given their radius: rays leave the lumen where a branch begins.
fn tamed(rough: &[Option<Rough>]) -> Vec<Option<Rough>> {
    /// Sections to both sides, and how much wider than them is far wider.
    const AROUND: (usize, f64) = (6, 1.5);
    (0..rough.len())
        .map(|n| {
            let around = &rough[n.saturating_sub(AROUND.0)..(n + AROUND.0 + 1).min(rough.len())];
            let mut radii: Vec<f64> = around.iter().flatten().map(|one| one.radius).collect();
            let middle = median(&mut radii)?;
            rough[n].map(|one| Rough { radius: one.radius.min(AROUND.1 * middle), ..one })
        })
        .collect()
}
