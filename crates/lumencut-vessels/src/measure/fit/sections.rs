//! Fits the sections of a vessel: first each one separately, then with the values that all of them share.

use glam::DVec3;
use rayon::prelude::*;

use super::Fit;
use crate::measure::beside::blooming;
use crate::measure::beside::bright_side::is_bright_behind;
use crate::measure::beside::flags_of;
use crate::measure::beside::plaque::narrowed;
use crate::measure::estimation::Level;
use crate::measure::model::ThreeLevels;
use crate::measure::model::contour::{ellipse_within, irregularity, points, wall, wall_by_rays};
use crate::measure::model::ellipse::{Boundary, Ellipse, Whitening};
use crate::measure::model::wall::KnownWall;
use crate::measure::section::SectionPlane;
use crate::measure::section::blur::Blur;
use crate::measure::section::contour_check::{encloses_lumen, lumen_shares};
use crate::measure::section::flags::{
    AT_LIMIT, BRANCH, CALCIUM, IRREGULAR, METAL, NEIGHBOR, NO_EDGE, PLAQUE, RECENTERED,
};
use crate::measure::section::lumen_estimate::LumenEstimate;
use crate::measure::section::rays::{Look, Rays, direction};
use crate::measure::uncertainty::Parts;
use crate::measure::uncertainty::texture::Texture;
use lumencut_core::error::Result;
use lumencut_core::math::statistics::median;
use lumencut_core::stop::{Stop, go_on};

/// Values are too bright for lumen if they exceed its level by this fraction of the contrast, or this
/// multiple of the noise if larger. Poorly mixed contrast medium and enhanced edges stay below this limit.
pub(crate) const BRIGHT: (f64, f64) = (0.15, 5.0);

/// A neighbour starts where values rise by this fraction of the contrast, or multiple of the noise if larger.
const RISE: (f64, f64) = (0.2, 4.0);

/// Rays continue this many mm plus this many blur widths beyond the wall.
const RAY_BEYOND: (f64, f64) = (2.0, 1.5);

/// Diameters below this multiple of the point spread get the flag [`AT_LIMIT`].
pub(crate) const LIMIT: f64 = 1.5;

/// Slices cut a vessel lengthwise into too few parts if their spacing exceeds this fraction of its diameter; they are
/// slices if their spacing is at least this multiple of that across.
const SLICES: (f64, f64) = (0.5, 2.0);

/// A contour is irregular if the root mean square of its relative differences from the ellipse exceeds this.
const ROUGH_WALL: f64 = 0.12;

/// Minimum contrast of a lumen, in multiples of the noise.
pub(crate) const LEAST_CONTRAST: f64 = 2.0;

/// Standard deviation of diameters that are measured without a blur model, in blur widths.
pub(crate) const UNMODELLED_WIDTHS: f64 = 0.5;

/// Noise before it is estimated, as a fraction of the contrast.
const FIRST_NOISE: f64 = 0.1;

/// What these flags mean looks like plaque.
const PLAQUE_HIDDEN: u32 = NEIGHBOR | BRANCH | CALCIUM | METAL;

pub(crate) struct Bench<'a, 'v> {
    pub rays: Rays<'a, 'v>,
    pub blur: Blur,
    /// FWHM of the point spread only, without the blur by voxels and interpolation (mm).
    pub fwhm: f64,
    /// The wall's prior; None if walls are not visible.
    pub wall: Option<KnownWall>,
    /// Data for the uncertainties; None if they are not wanted.
    pub doubt: Option<Doubt>,
}

pub(crate) struct Doubt {
    pub texture: Texture,
    /// The blur of a point spread that is wider by one standard deviation; None if its width is known exactly.
    pub wider: Option<Blur>,
    /// A wall that may exist, if none is visible.
    pub wall: Option<KnownWall>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Known {
    pub ellipse: Ellipse,
    /// Intensity level of the lumen, as a fraction of the contrast.
    pub lumen: Level,
    /// Noise, as a fraction of the contrast; None before it is estimated.
    pub noise: Option<f64>,
    /// The wall pooled over sections; None if the general prior is used.
    pub wall: Option<KnownWall>,
}

impl Known {
    pub(crate) fn noise(&self) -> f64 {
        self.noise.unwrap_or(FIRST_NOISE)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Section {
    /// The fitted lumen; None if none was found.
    pub(crate) fit: Option<Fit>,
    /// Points of the wall (mm, LPS), one per ray; empty if no lumen was found.
    pub contour: Vec<DVec3>,
    pub flags: u32,
    /// See [`crate::measure::profile::Profile::bounds`].
    pub bounds: [f64; 2],
    /// See [`crate::measure::profile::Profile::at_most`].
    pub at_most: f64,
}

impl Section {
    pub(crate) fn none() -> Self {
        Self { fit: None, contour: Vec::new(), flags: NO_EDGE, bounds: [f64::NAN; 2], at_most: f64::NAN }
    }

    pub(crate) fn scale(&mut self, by: f64) {
        let middle = self.contour.iter().sum::<DVec3>() / self.contour.len().max(1) as f64;
        for point in &mut self.contour {
            *point = middle + (*point - middle) * by;
        }
        if let Some(fit) = &mut self.fit {
            fit.ellipse = fit.ellipse.scaled(by);
            fit.parts = fit.parts.scaled(by);
            fit.uncertainty *= by;
        }
        self.bounds = self.bounds.map(|diameter| diameter * by);
    }
}

impl Bench<'_, '_> {
    pub(super) fn is_airway(&self) -> bool {
        self.wall.is_some_and(|wall| wall.is_airway)
    }

    pub(crate) fn estimates(
        &self,
        places: &[SectionPlane],
        search: f64,
        widest: f64,
        stop: Stop,
    ) -> Result<Vec<Option<LumenEstimate>>> {
        let look = |place: &SectionPlane| {
            go_on(stop).map(|()| LumenEstimate::find(&self.rays, place, search, widest))
        };
        places.par_iter().map(look).collect()
    }

    pub(crate) fn first_fits(
        &self,
        places: &[SectionPlane],
        estimates: &[Option<LumenEstimate>],
        stop: Stop,
    ) -> Result<Vec<Option<Fit>>> {
        let fit = |(place, estimate): (&SectionPlane, &Option<LumenEstimate>)| {
            go_on(stop)?;
            let Some(estimate) = estimate else { return Ok(None) };
            let known = Known {
                ellipse: Ellipse::circle(estimate.center, estimate.radius),
                lumen: [estimate.lumen.max(0.8), 0.5],
                noise: None,
                wall: None,
            };
            Ok(self.stable_fit(place, &known))
        };
        places.par_iter().zip(estimates).map(fit).collect()
    }

    pub(super) fn look(&self, place: &SectionPlane, known: &Known) -> Look {
        let width = self.blur.width(place);
        let noise = known.noise();
        let is_bright_lumen = self.rays.scale.contrast > 0.0;
        let bright = known.lumen[0].max(0.5) + BRIGHT.0.max(BRIGHT.1 * noise);
        Look {
            levels: [known.lumen[0], 0.0],
            // If the lumen is darker than its surroundings, bright values do not mean calcium.
            bright: if is_bright_lumen { bright } else { f64::INFINITY },
            // Beyond the wall of an airway, lung is nearly as dark as its lumen.
            rise: if self.is_airway() { f64::INFINITY } else { RISE.0.max(RISE.1 * noise) },
            reach: known.ellipse.semi_axes()[1] * 2.0 + RAY_BEYOND.0 + RAY_BEYOND.1 * width,
            beyond: RAY_BEYOND.0 + RAY_BEYOND.1 * width,
        }
    }

    /// Measures a section with prior knowledge; `other` is the second solution of its fit ([`Fit::other`]).
    pub(crate) fn section(&self, place: &SectionPlane, known: &Known, other: Option<Ellipse>) -> Section {
        let fitted = self.fit_of_either(place, known, other).map(|fit| self.fitted(place, known, fit));
        match fitted {
            Some(section) if section.flags & METAL == 0 => section,
            _ => self.by_rays(place, known).unwrap_or_else(Section::none),
        }
    }

    fn fitted(&self, place: &SectionPlane, known: &Known, mut fit: Fit) -> Section {
        let (ellipse, width) = (fit.ellipse, self.blur.width(place));
        let boundary = Boundary::new(&ellipse, Whitening::new(self.blur.interpolated(place)));
        // If a lumen is narrower than the blur, its peak is below its level.
        let level = 0.5 * boundary.value(ellipse.center);
        let beside = fit.wall.map_or(fit.background, |wall| wall.level[0]);
        let half = beside + level * (fit.lumen[0] - beside);
        let look = Look { levels: [half; 2], ..self.look(place, &Known { ellipse, ..*known }) };
        let rays = self.rays.all(place, ellipse.center, &look);
        let walls = match fit.wall {
            None => wall(&ellipse, &boundary, &rays, level),
            Some(own) => {
                let levels = [fit.lumen[0], fit.background];
                let model =
                    ThreeLevels::of(&ellipse, &own, levels, Whitening::new(self.blur.interpolated(place)));
                wall(&ellipse, &model, &rays, half)
            }
        };
        let own = |n: usize| ellipse.radius_towards(direction(n));
        let mut flags = flags_of(&rays, own, width);
        let bounds = bounds(flags, &ellipse, || blooming::bounds(&rays, own, width));
        let diameter = ellipse.equivalent_diameter();
        if diameter > 2.0 * width && irregularity(&ellipse, &walls) > ROUGH_WALL {
            flags |= IRREGULAR;
        }
        let around = if self.is_airway() { beside } else { fit.background };
        if fit.lumen[0] - around < LEAST_CONTRAST * known.noise() || fit.uncertainty > 0.5 * diameter {
            flags |= NO_EDGE;
        }
        if let Some(share) = self.narrowed_by_plaque(place, &fit, &walls, flags) {
            flags |= PLAQUE;
            fit.parts.surroundings = fit.parts.surroundings.hypot((1.0 - share) * diameter);
            fit.uncertainty = fit.parts.total();
        } else if self.is_beside_bright(place, &fit, &walls, flags) {
            flags |= NEIGHBOR;
        }
        let shares = lumen_shares(fit.lumen[0], beside);
        if !encloses_lumen(&self.rays, place, ellipse.center, &walls, width, shares) {
            flags |= NO_EDGE;
        }
        let contour = points(place, ellipse.center, &walls);
        Section {
            contour,
            fit: Some(fit),
            flags: flags | self.place_flags(place, &ellipse),
            bounds,
            at_most: f64::NAN,
        }
    }

    /// Factor of the diameter if plaque that is nearly as bright as the lumen is left out; None without such plaque.
    fn narrowed_by_plaque(&self, place: &SectionPlane, fit: &Fit, walls: &[f64], flags: u32) -> Option<f64> {
        let wall = self.wall.filter(|wall| flags & PLAQUE_HIDDEN == 0 && !wall.is_airway);
        let levels = [fit.lumen[0], wall?.level[0]];
        narrowed(&self.rays, (place, fit.ellipse.center), walls, levels, self.blur.width(place))
    }

    fn is_beside_bright(&self, place: &SectionPlane, fit: &Fit, walls: &[f64], flags: u32) -> bool {
        let hidden = self.doubt.as_ref().and_then(|doubt| doubt.wall);
        let is_shown = |wall: &KnownWall| flags & PLAQUE_HIDDEN == 0 && !wall.is_airway;
        self.wall.or(hidden).filter(is_shown).is_some_and(|wall| {
            let levels = [fit.lumen[0], wall.level[0]];
            is_bright_behind(&self.rays, (place, fit.ellipse.center), walls, levels, self.blur.width(place))
        })
    }

    fn by_rays(&self, place: &SectionPlane, known: &Known) -> Option<Section> {
        let width = self.blur.width(place);
        // The edge of the lumen lies halfway to the wall, which is brighter than fat.
        let beside = self.wall_of(known).map_or(0.0, |wall| wall.level[0].max(0.0));
        let look = Look { levels: [known.lumen[0], beside], ..self.look(place, known) };
        let rays = self.rays.all(place, known.ellipse.center, &look);
        let walls = wall_by_rays(&rays, width)?;
        let ellipse = ellipse_within(known.ellipse.center, &walls)?;
        let mut flags = flags_of(&rays, |n| walls[n], width);
        let bounds = bounds(flags, &ellipse, || blooming::bounds(&rays, |n| walls[n], width));
        // Between the struts of a stent, values above the lumen level are accepted.
        let shares = [lumen_shares(known.lumen[0], 0.0)[0], f64::INFINITY];
        let is_lumen = encloses_lumen(&self.rays, place, known.ellipse.center, &walls, width, shares);
        if known.lumen[0] < LEAST_CONTRAST * known.noise() || !is_lumen {
            flags |= NO_EDGE;
        }
        let fit = Fit {
            ellipse,
            lumen: known.lumen,
            background: 0.0,
            wall: None,
            missed: f64::NAN,
            uncertainty: UNMODELLED_WIDTHS * width,
            parts: Parts { point_spread: UNMODELLED_WIDTHS * width, ..Parts::default() },
            free: 0.0,
            other: None,
        };
        let contour = points(place, known.ellipse.center, &walls);
        Some(Section {
            contour,
            fit: Some(fit),
            flags: flags | self.place_flags(place, &ellipse),
            bounds,
            at_most: f64::NAN,
        })
    }

    fn place_flags(&self, place: &SectionPlane, ellipse: &Ellipse) -> u32 {
        let towards = -ellipse.center;
        let reach = towards.try_normalize().map_or(f64::INFINITY, |d| ellipse.radius_towards(d));
        let recentered = if towards.length() > reach { RECENTERED } else { 0 };
        let ([fine, coarse], diameter) = (self.blur.spacing(place), ellipse.equivalent_diameter());
        let is_in_few_slices = coarse > SLICES.0 * diameter && coarse >= SLICES.1 * fine;
        let limit = if diameter < LIMIT * self.fwhm || is_in_few_slices { AT_LIMIT } else { 0 };
        recentered | limit
    }
}

/// Bounds of the diameter (mm); NaN unless calcium or metal is flagged.
fn bounds(flags: u32, ellipse: &Ellipse, factors: impl FnOnce() -> [f64; 2]) -> [f64; 2] {
    if flags & (CALCIUM | METAL) == 0 {
        return [f64::NAN; 2];
    }
    factors().map(|factor| factor * ellipse.equivalent_diameter())
}

pub(crate) fn noise(fits: &[Option<Fit>]) -> f64 {
    let mut missed: Vec<f64> = fits.iter().flatten().map(|fit| fit.missed).collect();
    median(&mut missed).unwrap_or(FIRST_NOISE).max(1e-4)
}

pub(crate) fn center(place: &SectionPlane, fit: &Fit) -> DVec3 {
    place.point(fit.ellipse.center)
}
