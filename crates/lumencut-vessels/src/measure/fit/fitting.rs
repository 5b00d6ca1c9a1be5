//! Prepares the fit of a section: selects the voxels to use, and sets the priors.

use glam::DVec2;

use super::sections::{Bench, Known};
use super::{Expected, Fit, Unsure};
use crate::measure::beside::Obstacles;
use crate::measure::estimation::Level;
use crate::measure::model::ellipse::{Boundary, Ellipse, Whitening};
use crate::measure::model::wall::KnownWall;
use crate::measure::section::SectionPlane;
use crate::measure::section::blur::Blur;
use crate::measure::section::rays::{RAYS, direction};
use crate::measure::section::slab::{Samples, Window};
use crate::measure::uncertainty::texture::Pairs;
use lumencut_core::math::statistics::median;

/// Voxels up to this many blur widths beyond the wall are used.
const BEYOND: f64 = 1.5;

/// Standard deviation of the relative difference between the semi-axes: first for wide lumens, then for narrow ones.
const STRETCH: (f64, f64) = (0.4, 0.06);

/// Minimum fraction of directions in which nothing obstructs the wall.
const LEAST_FREE: f64 = 0.35;

/// Level of the surroundings and its standard deviation (fractions of the contrast): mostly, and around airways, where it
/// is that of lung or of soft tissue.
const AROUND: Level = [0.0, 0.5];
const AROUND_AIRWAY: Level = [0.5, 0.5];

/// The lumen level is read within this fraction of the radius, if blur leaves at least `LEAST_PEAK` of the peak.
const MIDDLE: f64 = 1.0 / 3.0;
const LEAST_PEAK: f64 = 0.95;

/// Two parts of the standard deviation of the lumen level: a fraction of the contrast, and a multiple of the voxel
/// noise.
const SEEN: (f64, f64) = (0.02, 0.33);

/// Voxels of a section, without those affected by obstacles such as calcium.
struct Cleared {
    samples: Samples,
    obstacles: Obstacles,
}

pub(crate) struct Ready {
    place: SectionPlane,
    start: Ellipse,
    cleared: Cleared,
    expected: Expected<'static>,
}

impl Ready {
    pub(crate) fn missed(&self, blur: &Blur) -> Option<f64> {
        let whitening = Whitening::new(blur.of_voxels(&self.place));
        Fit::missed_by(&self.cleared.samples, whitening, &self.start, &self.expected)
    }
}

impl Bench<'_, '_> {
    /// Fits a section; None if obstacles hide too much of the wall or no ellipse fits.
    pub(crate) fn fit(&self, place: &SectionPlane, known: &Known) -> Option<Fit> {
        let ready = self.ready(place, known)?;
        let wider = self.doubt.as_ref().and_then(|doubt| doubt.wider);
        let unsure = self.doubt.as_ref().map(|doubt| Unsure {
            texture: &doubt.texture,
            wider: wider.map(|wider| Whitening::new(wider.of_voxels(place))),
            wall: doubt.wall,
        });
        let expected = Expected { unsure: unsure.as_ref(), ..ready.expected };
        let whitening = Whitening::new(self.blur.of_voxels(place));
        let fit = Fit::new(&ready.cleared.samples, whitening, &known.ellipse, &expected)?;
        Some(Fit { free: ready.cleared.obstacles.free, ..fit })
    }

    pub(crate) fn ready(&self, place: &SectionPlane, known: &Known) -> Option<Ready> {
        let cleared = self.cleared(place, known)?;
        let seen = self.level_seen(place, known, |point| cleared.obstacles.keeps(point));
        let expected = Expected {
            // A smaller, brighter ellipse fits a sharp wall as well, so the level visible in the middle is used.
            lumen: seen.filter(|seen| seen[1] < known.lumen[1]).unwrap_or(known.lumen),
            background: if self.is_airway() { AROUND_AIRWAY } else { AROUND },
            stretch: stretch(2.0 * known.ellipse.mean, self.blur.width(place)),
            noise: known.noise(),
            is_guessed: known.noise.is_none(),
            wall: self.wall_of(known),
            unsure: None,
        };
        Some(Ready { place: *place, start: known.ellipse, cleared, expected })
    }

    pub(crate) fn pairs(&self, place: &SectionPlane, known: &Known, fit: &Fit) -> Option<Pairs> {
        let samples = self.cleared(place, known)?.samples;
        let missing = fit.missing(&samples, Whitening::new(self.blur.of_voxels(place)));
        Some(Pairs::new(&samples, &missing, known.noise() as f32))
    }

    pub(super) fn wall_of(&self, known: &Known) -> Option<KnownWall> {
        self.wall.map(|wall| known.wall.unwrap_or(wall))
    }

    /// Voxels of a section without those affected by obstacles; None if too few directions are unobstructed.
    fn cleared(&self, place: &SectionPlane, known: &Known) -> Option<Cleared> {
        let width = self.blur.width(place);
        let ellipse = &known.ellipse;
        let rays = self.rays.all(place, ellipse.center, &self.look(place, known));
        let obstacles = Obstacles::new(&rays, ellipse.center, width);
        if obstacles.free < LEAST_FREE {
            return None;
        }
        let [short, long] = ellipse.semi_axes();
        let around = self.wall_of(known).map_or(0.0, |wall| wall.log_thickness(ellipse)[0].exp());
        let window = Window {
            center: ellipse.center,
            reach: 1.1 * long + BEYOND * width + 1.5 * around,
            wall: [ellipse.mean + 0.5 * around, 1.3 * width + 0.6 * (long - short) + 0.5 * around],
        };
        let keep = |point| obstacles.keeps(point);
        let samples = Samples::gather(self.rays.voxels, &self.rays.scale, place, &window, keep);
        Some(Cleared { samples, obstacles })
    }

    fn level_seen(&self, place: &SectionPlane, known: &Known, keep: impl Fn(DVec2) -> bool) -> Option<Level> {
        let ellipse = &known.ellipse;
        let peak =
            Boundary::new(ellipse, Whitening::new(self.blur.interpolated(place))).value(ellipse.center);
        if peak < LEAST_PEAK {
            return None;
        }
        let mut values: Vec<f64> = (0..RAYS)
            .map(|n| {
                let share = MIDDLE * ((n % 4) as f64 / 3.0);
                ellipse.center + direction(n) * (share * ellipse.radius_towards(direction(n)))
            })
            .filter(|point| keep(*point))
            .map(|point| self.rays.at(place, point))
            .filter(|value| value.is_finite())
            .collect();
        if values.len() < RAYS / 2 {
            return None;
        }
        let deviation = SEEN.0.hypot(SEEN.1 * known.noise()) + 1.0 - peak;
        median(&mut values).map(|seen| [seen / peak, deviation])
    }
}

fn stretch(diameter: f64, width: f64) -> f64 {
    let seen = ((diameter / width - 1.0) / 1.0).clamp(0.0, 1.0);
    STRETCH.1 + seen * (STRETCH.0 - STRETCH.1)
}
