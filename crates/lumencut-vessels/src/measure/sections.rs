//! The sections of a vessel: looked at, fitted, and fitted again with what all of them tell of each other.

use glam::DVec3;
use rayon::prelude::*;

use super::believed::{encloses_lumen, lumen_shares};
use super::blooming;
use super::blur::Blur;
use super::contour::{ellipse_within, irregularity, points, wall, wall_by_rays};
use super::ellipse::{Boundary, Ellipse, Whitening};
use super::fit::Fit;
use super::flags::{AT_LIMIT, CALCIUM, IRREGULAR, METAL, NO_EDGE, RECENTERED};
use super::model::ThreeLevels;
use super::obstacles::flags_of;
use super::parts::Parts;
use super::place::Place;
use super::pooled::Level;
use super::rays::{Look, Rays, direction};
use super::rough::Rough;
use super::texture::Texture;
use super::wall::KnownWall;
use lumencut_core::error::Result;
use lumencut_core::math::statistics::median;
use lumencut_core::stop::{Stop, go_on};

/// What is brighter than lumen by this share of the contrast, and by this multiple of the noise, is not lumen.
pub const BRIGHT: (f64, f64) = (0.15, 5.0);

/// Values rise by this share of the contrast, and by this multiple of the noise, where a neighbour begins.
const RISE: (f64, f64) = (0.2, 4.0);

/// How far beyond the wall rays are followed (mm, and widths of the blur).
const RAY_BEYOND: (f64, f64) = (2.0, 1.5);

/// Diameters below this multiple of the point spread are at the limit.
pub const LIMIT: f64 = 1.5;

/// Walls that lie off the ellipse by this share are irregular.
const ROUGH_WALL: f64 = 0.12;

/// Below this multiple of the noise there is no contrast.
pub const LEAST_CONTRAST: f64 = 2.0;

/// Where the blur is not taken into account diameters are unsure by this share of its width.
const UNSURE: f64 = 0.5;

/// The noise before it is known, as a share.
const FIRST_NOISE: f64 = 0.1;

/// What sections are looked at with.
pub struct Bench<'a, 'v> {
    /// The volume along rays.
    pub rays: Rays<'a, 'v>,
    /// Its blur.
    pub blur: Blur,
    /// The point spread alone (FWHM, mm).
    pub fwhm: f64,
    /// The wall, where it is told apart from the surroundings.
    pub wall: Option<KnownWall>,
    /// What makes diameters unsure besides what sections tell themselves, where that is asked.
    pub doubt: Option<Doubt>,
}

/// What makes all diameters of a scan unsure.
pub struct Doubt {
    /// The texture of its noise.
    pub texture: Texture,
    /// Its blur with a point spread that is wider by its standard deviation; None where it is known.
    pub wider: Option<Blur>,
    /// The wall that may be there where it is not told apart from the surroundings.
    pub wall: Option<KnownWall>,
}

/// What is known of a section before it is fitted.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// About where the lumen is.
    pub ellipse: Ellipse,
    /// The level of the lumen and its standard deviation, as shares.
    pub lumen: Level,
    /// The noise of a voxel, as a share, where it is known.
    pub noise: Option<f64>,
    /// The wall, where the other sections tell more of it than is known of all walls.
    pub wall: Option<KnownWall>,
}

impl Known {
    /// The noise of a voxel, as a share, or what it is taken for.
    pub fn noise(&self) -> f64 {
        self.noise.unwrap_or(FIRST_NOISE)
    }
}

/// A section as it was measured.
#[derive(Clone, Debug)]
pub struct Section {
    /// The fit; None where no lumen was found.
    pub fit: Option<Fit>,
    /// The points of the wall (mm, LPS), one for each ray; none where no lumen was found.
    pub contour: Vec<DVec3>,
    /// What there is to know of it.
    pub flags: u32,
    /// The diameter (mm) if what is brighter than lumen at its wall is none, and if it is; NaN where nothing is.
    pub bounds: [f64; 2],
}

impl Section {
    /// A section without lumen.
    pub fn none() -> Self {
        Self { fit: None, contour: Vec::new(), flags: NO_EDGE, bounds: [f64::NAN; 2] }
    }

    /// Makes the lumen wider by a factor.
    pub fn scale(&mut self, by: f64) {
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
    /// About where the lumen is at each place.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub fn rough(
        &self,
        places: &[Place],
        search: f64,
        widest: f64,
        stop: Stop,
    ) -> Result<Vec<Option<Rough>>> {
        let look = |place: &Place| go_on(stop).map(|()| Rough::find(&self.rays, place, search, widest));
        places.par_iter().map(look).collect()
    }

    /// The fits of sections by themselves, from where their lumens are about.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub fn first_fits(
        &self,
        places: &[Place],
        rough: &[Option<Rough>],
        stop: Stop,
    ) -> Result<Vec<Option<Fit>>> {
        let fit = |(place, rough): (&Place, &Option<Rough>)| {
            go_on(stop)?;
            let Some(rough) = rough else { return Ok(None) };
            let known = Known {
                ellipse: Ellipse::circle(rough.center, rough.radius),
                lumen: [rough.lumen.max(0.8), 0.5],
                noise: None,
                wall: None,
            };
            Ok(self.settled(place, &known))
        };
        places.par_iter().zip(rough).map(fit).collect()
    }

    pub(super) fn look(&self, place: &Place, known: &Known) -> Look {
        let width = self.blur.width(place);
        let noise = known.noise();
        let is_bright_lumen = self.rays.scale.contrast > 0.0;
        let bright = known.lumen[0].max(0.5) + BRIGHT.0.max(BRIGHT.1 * noise);
        Look {
            levels: [known.lumen[0], 0.0],
            // What is darker than a dark lumen is no calcium.
            bright: if is_bright_lumen { bright } else { f64::INFINITY },
            rise: RISE.0.max(RISE.1 * noise),
            reach: known.ellipse.semi_axes()[1] * 2.0 + RAY_BEYOND.0 + RAY_BEYOND.1 * width,
            beyond: RAY_BEYOND.0 + RAY_BEYOND.1 * width,
        }
    }

    /// A section measured with what is known of it from all sections; `other` is where else its lumen may be, see [`Fit::other`].
    pub fn section(&self, place: &Place, known: &Known, other: Option<Ellipse>) -> Section {
        let fitted = self.fit_of_either(place, known, other).map(|fit| self.fitted(place, known, fit));
        match fitted {
            Some(section) if section.flags & METAL == 0 => section,
            _ => self.by_rays(place, known).unwrap_or_else(Section::none),
        }
    }

    /// A section with the wall along rays, and what there is to know of it.
    fn fitted(&self, place: &Place, known: &Known, fit: Fit) -> Section {
        let (ellipse, width) = (fit.ellipse, self.blur.width(place));
        let boundary = Boundary::new(&ellipse, Whitening::new(self.blur.interpolated(place)));
        // Where the lumen is narrow its peak is lower than its level.
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
        if fit.lumen[0] - fit.background < LEAST_CONTRAST * known.noise() || fit.uncertainty > 0.5 * diameter
        {
            flags |= NO_EDGE;
        }
        let shares = lumen_shares(fit.lumen[0], beside);
        if !encloses_lumen(&self.rays, place, ellipse.center, &walls, width, shares) {
            flags |= NO_EDGE;
        }
        let contour = points(place, ellipse.center, &walls);
        Section { contour, fit: Some(fit), flags: flags | self.place_flags(&ellipse), bounds }
    }

    /// A section whose wall is where rays end, as within a stent.
    fn by_rays(&self, place: &Place, known: &Known) -> Option<Section> {
        let width = self.blur.width(place);
        let rays = self.rays.all(place, known.ellipse.center, &self.look(place, known));
        let walls = wall_by_rays(&rays, width)?;
        let ellipse = ellipse_within(known.ellipse.center, &walls)?;
        let mut flags = flags_of(&rays, |n| walls[n], width);
        let bounds = bounds(flags, &ellipse, || blooming::bounds(&rays, |n| walls[n], width));
        // Struts within may be as bright as they are.
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
            uncertainty: UNSURE * width,
            parts: Parts { point_spread: UNSURE * width, ..Parts::default() },
            free: 0.0,
            other: None,
        };
        let contour = points(place, known.ellipse.center, &walls);
        Some(Section { contour, fit: Some(fit), flags: flags | self.place_flags(&ellipse), bounds })
    }

    /// What the place and the size of a lumen say.
    fn place_flags(&self, ellipse: &Ellipse) -> u32 {
        let towards = -ellipse.center;
        let reach = towards.try_normalize().map_or(f64::INFINITY, |d| ellipse.radius_towards(d));
        let recentered = if towards.length() > reach { RECENTERED } else { 0 };
        let limit = if ellipse.equivalent_diameter() < LIMIT * self.fwhm { AT_LIMIT } else { 0 };
        recentered | limit
    }
}

/// The bounds of the diameter of a lumen (mm) by factors of it, where the flags of its section ask for them.
fn bounds(flags: u32, ellipse: &Ellipse, factors: impl FnOnce() -> [f64; 2]) -> [f64; 2] {
    if flags & (CALCIUM | METAL) == 0 {
        return [f64::NAN; 2];
    }
    factors().map(|factor| factor * ellipse.equivalent_diameter())
}

/// The noise of a voxel as a share: the median of what fits miss.
pub fn noise(fits: &[Option<Fit>]) -> f64 {
    let mut missed: Vec<f64> = fits.iter().flatten().map(|fit| fit.missed).collect();
    median(&mut missed).unwrap_or(FIRST_NOISE).max(1e-4)
}

/// The middle of a section (mm, LPS).
pub fn center(place: &Place, fit: &Fit) -> DVec3 {
    place.point(fit.ellipse.center)
}
