//! Contours that a reader draws in place of automatic ones: by pulling at an outline, which stays smooth and never crosses itself.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use crate::measure::model::contour::{ellipse_within, inscribed, points};
use crate::measure::model::ellipse::Ellipse;
use crate::measure::profile::{Profile, half_axes_of};
use crate::measure::section::SectionPlane;
use crate::measure::section::flags::{
    BRANCH, BY_HAND, IRREGULAR, LINE_BY_HAND, NO_EDGE, RECENTERED, RESTLESS_LINE,
};
use crate::measure::section::rays::{RAYS, direction};
use crate::measure::uncertainty::Parts;

/// Flags that doubt the automatic contour or its plane, which the reader has decided by drawing one.
const DECIDED: u32 = NO_EDGE | RECENTERED | IRREGULAR | BRANCH | RESTLESS_LINE;

/// Smallest and largest radius (mm) of a contour.
pub const RADII_MM: [f64; 2] = [0.2, 80.0];

/// Radius (mm) of the circle that is offered if no section has a diameter.
const FIRST_RADIUS_MM: f64 = 3.0;

/// Half width (radians) of the stretch of an outline that follows a pull.
const PULLED: f64 = PI / 4.0;

/// Standard deviation of a diameter drawn by hand, in voxel sides: both edges lie anywhere within a voxel, and err alike.
const DRAWN: f64 = 0.577;

/// A closed contour in the plane of a section.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Arc length of the section (mm).
    pub at: f64,
    /// Centre, in the axes of the section (mm).
    pub center: DVec2,
    /// Distance (mm) of the contour from the centre on each ray.
    pub radii: [f64; RAYS],
}

impl Outline {
    /// The outline through the points of a contour, seen from `center`.
    fn through(place: &SectionPlane, center: DVec3, contour: &[DVec3]) -> Option<Self> {
        let within = |point: DVec3| {
            let [x, y, _] = place.coordinates(point - place.origin);
            DVec2::new(x, y)
        };
        let center = within(center);
        let corners: Vec<DVec2> = contour.iter().map(|point| within(*point) - center).collect();
        let mut radii = [0.0; RAYS];
        for (n, radius) in radii.iter_mut().enumerate() {
            *radius = farthest(&corners, direction(n))?.clamp(RADII_MM[0], RADII_MM[1]);
        }
        Some(Self { at: place.at, center, radii })
    }

    /// The outline after a pull that makes it pass through a point (mm, LPS); its neighbours follow smoothly.
    #[must_use]
    pub fn pulled(&self, place: &SectionPlane, to: DVec3) -> Self {
        let [x, y, _] = place.coordinates(to - place.origin);
        let to = DVec2::new(x, y) - self.center;
        if !to.is_finite() || to.length() == 0.0 {
            return self.clone();
        }
        let place = to.to_angle().rem_euclid(TAU) / TAU * RAYS as f64;
        let (before, share) = (place.floor(), place.fract());
        let [a, b] = [0, 1].map(|n| self.radii[(before as usize + n) % RAYS]);
        let change = to.length() - (a + share * (b - a));
        let radii = std::array::from_fn(|n| {
            let away = (n as f64 - place + 1.5 * RAYS as f64) % RAYS as f64 - 0.5 * RAYS as f64;
            let away = (away.abs() / RAYS as f64 * TAU / PULLED).min(1.0);
            let weight = (FRAC_PI_2 * away).cos().powi(2);
            (self.radii[n] + weight * change).clamp(RADII_MM[0], RADII_MM[1])
        });
        Self { radii, ..*self }
    }

    /// The ellipse with the area, centre and axes of the contour.
    pub fn ellipse(&self) -> Ellipse {
        let mean = self.radii.iter().sum::<f64>() / RAYS as f64;
        // All radii are positive, so the contour always has an area.
        ellipse_within(self.center, &self.radii).unwrap_or_else(|| Ellipse::circle(self.center, mean))
    }

    /// The points of the contour (mm, LPS), one per ray.
    pub fn points(&self, place: &SectionPlane) -> Vec<DVec3> {
        points(place, self.center, &self.radii)
    }
}

/// Distance at which a ray from the origin last crosses a polygon.
fn farthest(corners: &[DVec2], ray: DVec2) -> Option<f64> {
    let crossing = |n: usize| {
        let (a, b) = (corners[n], corners[(n + 1) % corners.len()]);
        let [beside_a, beside_b] = [ray.perp_dot(a), ray.perp_dot(b)];
        let share = if beside_a == beside_b { 0.0 } else { beside_a / (beside_a - beside_b) };
        let at = ray.dot(a + share * (b - a));
        // A corner on the ray may be missed by rounding on both of its sides.
        ((-1e-9..=1.0 + 1e-9).contains(&share) && at > 0.0).then_some(at)
    };
    (0..corners.len()).filter_map(crossing).reduce(f64::max)
}

impl Profile {
    /// The contour of section `n` as an outline to pull at: a circle as wide as the vessel nearby if there is none.
    pub fn outline(&self, n: usize) -> Outline {
        let place = self.place(n);
        Outline::through(&place, self.center[n], &self.contour[n]).unwrap_or_else(|| {
            let known = (0..self.len()).filter(|m| self.area[*m].is_finite());
            let nearest = known.min_by_key(|m| m.abs_diff(n));
            let radius = nearest.map_or(FIRST_RADIUS_MM, |m| (self.area[m] / PI).sqrt());
            let radius = radius.clamp(RADII_MM[0], RADII_MM[1]);
            Outline { at: place.at, center: DVec2::ZERO, radii: [radius; RAYS] }
        })
    }

    /// The profile with contours that were drawn by hand; `side` is that of a voxel (mm).
    #[must_use]
    pub fn drawn(&self, outlines: &[Outline], side: f64) -> Self {
        let mut profile = self.clone();
        for outline in outlines {
            profile.draw(outline, side);
        }
        profile.inscribed_radius = inscribed(&profile.arc_length, &profile.center, &profile.contour);
        profile
    }

    /// The profile of a line that the reader moved between these arc lengths (mm).
    #[must_use]
    pub fn with_line_by_hand(mut self, stretches: &[[f64; 2]]) -> Self {
        for [from, to] in stretches {
            for n in self.nearest_section(*from)..=self.nearest_section(*to) {
                self.flags[n] |= LINE_BY_HAND;
            }
        }
        self
    }

    fn draw(&mut self, outline: &Outline, side: f64) {
        let n = self.nearest_section(outline.at);
        let place = self.place(n);
        let ellipse = outline.ellipse();
        let [shortest, longest] = ellipse.semi_axes();
        (self.diameter_min[n], self.diameter_max[n]) = (2.0 * shortest, 2.0 * longest);
        self.area[n] = ellipse.area();
        self.center[n] = place.point(ellipse.center);
        self.half_axes[n] = half_axes_of(&place, &ellipse);
        self.contour[n] = outline.points(&place);
        self.flags[n] = (self.flags[n] & !DECIDED) | BY_HAND;
        (self.wall[n], self.bounds[n], self.at_most[n]) = ([f64::NAN; 2], [f64::NAN; 2], f64::NAN);
        if self.outer_contour[n].is_empty() {
            self.diameter_outer[n] = [f64::NAN; 2];
        }
        let drawn = DRAWN * side;
        if self.uncertainty[n].is_nan() || self.uncertainty[n] < drawn {
            self.uncertainty[n] = drawn;
            self.uncertainty_parts[n] = Parts { surroundings: drawn, ..Parts::default() };
        }
    }
}

#[cfg(test)]
#[path = "tests/by_hand.rs"]
mod tests;
