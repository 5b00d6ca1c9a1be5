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
use super::point_spread::{NARROW, Told, estimated};
use super::profile::{Profile, Source};
use super::rays::Rays;
use super::rough::Rough;
use super::scale::Scale;
use super::sections::{Bench, Known, LEAST_CONTRAST, Section, center, noise};
use super::slab::thickness;
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
    check(request.fwhm)?;
    let voxels = Voxels::new(volume);
    let looked = Looked::new(&voxels, vessel, request)?;
    let fwhm = point_spread(&voxels, &looked, request)?;
    looked.profile(&voxels, vessel, request, fwhm)
}

/// The profile of a vessel under the point spread that [`point_spread_of`] found for its tree: the same as that of [`measure`],
/// which finds it anew.
///
/// # Errors
/// As [`measure`].
pub fn measure_under(
    (fwhm, source): (f64, Source),
    volume: &Volume,
    vessel: &Vessel,
    request: &MeasureRequest,
) -> Result<Profile> {
    let voxels = Voxels::new(volume);
    Looked::new(&voxels, vessel, request)?.profile(&voxels, vessel, request, (fwhm, source))
}

fn check(fwhm: Option<f64>) -> Result<()> {
    let Some(fwhm) = fwhm else { return Ok(()) };
    FWHM.check("fwhm", fwhm)?;
    if fwhm > 0.0 {
        return Ok(());
    }
    Err(Error::new(ErrorKind::Settings, "fwhm", format!("{fwhm} mm"), "a width above 0 mm, or none"))
}

/// The point spread: as it is given, as the tree tells it for all that is measured in its scan, or, where there is no tree, as the
/// vessel itself tells it.
fn point_spread(voxels: &Voxels, looked: &Looked, request: &MeasureRequest) -> Result<(f64, Source)> {
    match request.fwhm {
        Some(fwhm) => Ok((fwhm, Source::Given)),
        None if !request.tree.is_empty() => of_tree(voxels, request),
        None => Ok(match looked.point_spread(voxels, request.stop)? {
            Told::Width(found) => (found.fwhm, Source::Estimated { on: found.on() }),
            Told::Nothing(reason) => default(voxels, reason),
        }),
    }
}

/// The point spread of a scan (FWHM, mm), as it is given or as the widest vessels of the tree tell it, and where it is from: the
/// same for all that is measured along the tree, its vessels and paths through several of them.
///
/// # Errors
/// [`ErrorKind::Settings`] for an invalid width, [`ErrorKind::Interrupted`].
pub fn point_spread_of(volume: &Volume, request: &MeasureRequest) -> Result<(f64, Source)> {
    check(request.fwhm)?;
    match request.fwhm {
        Some(fwhm) => Ok((fwhm, Source::Given)),
        None => of_tree(&Voxels::new(volume), request),
    }
}

fn of_tree(voxels: &Voxels, request: &MeasureRequest) -> Result<(f64, Source)> {
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
                return Ok((found.fwhm, Source::Estimated { on }));
            }
            Told::Nothing(NARROW) => {}
            Told::Nothing(reason) => why = reason,
        }
    }
    Ok(default(voxels, why))
}

fn default(voxels: &Voxels, reason: &str) -> (f64, Source) {
    let from = format!("{DEFAULT_FWHM} sides of a voxel, as {reason}");
    (assumed(voxels), Source::Assumed { from })
}

/// A vessel before it is fitted.
struct Looked {
    scale: Scale,
    places: Vec<Place>,
    rough: Vec<Option<Rough>>,
}

impl Looked {
    fn new(voxels: &Voxels, vessel: &Vessel, request: &MeasureRequest) -> Result<Self> {
        let first = Track::new(vessel, None)?.places(request.step)?;
        let known = known_radius(vessel);
        let scale = Scale::of(voxels, &first, known)?;
        let widest = known.map_or(WIDEST, |radius| (3.0 * radius + 5.0).min(WIDEST));
        let search = known.unwrap_or(0.0).max(SEARCH);
        let bench = bench(voxels, scale, assumed(voxels));
        let rough = bench.rough(&first, search, widest, request.stop)?;
        let mut radii: Vec<f64> = rough.iter().flatten().map(|rough| rough.radius).collect();
        let radius = median(&mut radii).ok_or_else(|| no_lumen(&scale))?;
        let places = Track::new(vessel, Some(radius))?.places(request.step)?;
        Ok(Self { scale, places, rough: tamed(&rough) })
    }

    fn point_spread(&self, voxels: &Voxels, stop: Stop) -> Result<Told> {
        let bench = bench(voxels, self.scale, assumed(voxels));
        let fits = bench.first_fits(&self.places, &self.rough, stop)?;
        estimated(&bench, voxels.world_from_index.matrix3, &self.places, &fits, stop)
    }

    fn profile(
        &self,
        voxels: &Voxels,
        vessel: &Vessel,
        request: &MeasureRequest,
        fwhm: (f64, Source),
    ) -> Result<Profile> {
        let stop = request.stop;
        let bench = bench(voxels, self.scale, fwhm.0);
        let fits = bench.first_fits(&self.places, &self.rough, stop)?;
        let noise = noise(&fits);
        if LEAST_CONTRAST * noise > 1.0 {
            return Err(no_lumen(&self.scale));
        }
        let lumen = lumen_levels(&bench, &self.places, &fits, stop)?;
        let others = Lumen::of_others(request.tree, vessel);
        let section = |n: usize| {
            go_on(stop)?;
            let place = &self.places[n];
            let rough = self.rough[n].map(|rough| Ellipse::circle(rough.center, rough.radius));
            let mut section = match fits[n].map(|fit| fit.ellipse).or(rough) {
                Some(ellipse) => {
                    bench.section(place, &Known { ellipse, lumen: lumen[n], noise: Some(noise) })
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
        let noise = noise * self.scale.contrast.abs();
        Ok(Profile::new(&self.places, &sections, &self.scale, noise, fwhm))
    }

    /// The flag of a section within the lumen of another vessel.
    fn branch(&self, n: usize, fit: Option<&Fit>, others: &[Lumen]) -> u32 {
        let Some(fit) = fit else { return 0 };
        let place = &self.places[n];
        let is_met = meets(place, center(place, fit), fit.ellipse.mean, others);
        if is_met { BRANCH } else { 0 }
    }
}

fn bench<'a, 'v>(voxels: &'a Voxels<'v>, scale: Scale, fwhm: f64) -> Bench<'a, 'v> {
    let blur = Blur::new(fwhm, voxels.world_from_index.matrix3);
    Bench { rays: Rays { voxels, scale }, blur, fwhm }
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
