//! Spiral CPR: every section across a vessel is wound up into one row. So a still picture shows the vessel from all
//! sides, and widths in it represent areas. After the helical CPR of Kanitsar (dissertation, TU Wien 2004): sections
//! as in the straightened CPR, with two spirals of constant pitch from the middle of each. The formulas are ours.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::cpr::{Straightened, View};
use super::layout::{Layout, by_rows, checked_size, curved_by_rows, whole_pixels};
use crate::camera::{MAX_PIXELS, MAX_SIZE};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::Curved;
use crate::limits::Limits;
use crate::math::centerline_path::CenterlinePath;
use crate::math::same_place::ON_PICTURE;
use crate::named::Named;
use crate::stop::Stop;

const LENGTH: Limits = Limits::new(1e-6, 1e4, "mm");

const NEWTON_STEPS: usize = 12;

/// The spacing of the samples of a row on its spirals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// One pixel apart along the spiral, so that every pixel covers the same area.
    Arc,
    /// At equal angles, so that every winding has the same width; one pixel apart on the outermost winding.
    Angle,
}

impl Named for Sampling {
    const NAMES: &'static [(&'static str, Self)] = &[("arc", Self::Arc), ("angle", Self::Angle)];
}

/// The parameters by which the sections of a vessel are wound up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpiralParameters {
    /// The distance between neighbouring windings, counting both spirals (mm).
    pub pitch: f64,
    /// The largest distance of the windings from the vessel (mm).
    pub radius: f64,
    /// The spacing of the samples on the spirals.
    pub sampling: Sampling,
    /// The side of a pixel (mm).
    pub pixel_spacing: f64,
    /// The angle by which sections are turned (radians).
    pub angle: f64,
}

/// A vessel with sections wound up: rows by arc length, columns along two spirals from the middle.
#[derive(Clone)]
pub struct Spiral {
    straightened: Straightened,
    parameters: SpiralParameters,
    /// For each column, the position in its section (mm) and the direction across the spiral.
    columns: Vec<[DVec2; 2]>,
    rows: usize,
}

impl Spiral {
    /// The spiral CPR of a vessel, seen as in [`Straightened`]. Fails with [`ErrorKind::Camera`] for an
    /// invalid view, angle or length, or too many pixels; the error then states a pitch that fits.
    pub fn new(path: Arc<CenterlinePath>, view: &View, parameters: SpiralParameters) -> Result<Self> {
        let SpiralParameters { pitch, radius, pixel_spacing, angle, .. } = parameters;
        for (subject, value) in [
            ("pitch of the spiral CPR", pitch),
            ("radius of the spiral CPR", radius),
            ("pixel_spacing of the spiral CPR", pixel_spacing),
        ] {
            LENGTH.check(subject, value).map_err(|error| Error { kind: ErrorKind::Camera, ..error })?;
        }
        if !angle.is_finite() {
            let found = format!("{angle}");
            return Err(Error::new(ErrorKind::Camera, "angle of the spiral CPR", found, "a finite angle"));
        }
        let rows = whole_pixels(path.length(), pixel_spacing) + 1.0;
        let half = parameters.half();
        let [width, rows] = fitting_size(&parameters, [2.0 * half + 1.0, rows])?;
        let straightened = Straightened::new(path, &View { angle: 0.0, ..*view })?;
        let columns = (0..width).map(|i| parameters.place(i as f64 - half)).collect();
        Ok(Self { straightened, parameters, columns, rows })
    }

    /// The parameters by which the sections are wound up.
    pub fn parameters(&self) -> &SpiralParameters {
        &self.parameters
    }

    fn middle(&self) -> f64 {
        (self.columns.len() - 1) as f64 / 2.0
    }
}

impl SpiralParameters {
    /// Growth of a spiral's radius per radian (mm).
    fn rate(&self) -> f64 {
        self.pitch / PI
    }

    fn half(&self) -> f64 {
        let outermost = self.radius / self.rate();
        let length = match self.sampling {
            Sampling::Arc => self.length(outermost),
            Sampling::Angle => self.radius * outermost,
        };
        whole_pixels(length, self.pixel_spacing)
    }

    fn length(&self, angle: f64) -> f64 {
        self.rate() / 2.0 * (angle * angle.hypot(1.0) + angle.asinh())
    }

    /// The angle up to which the spiral has this length, by Newton's method from a larger angle downwards.
    fn angle_of(&self, length: f64) -> f64 {
        let rate = self.rate();
        (0..NEWTON_STEPS).fold((2.0 * length / rate).sqrt(), |angle, _| {
            angle - (self.length(angle) - length) / (rate * angle.hypot(1.0))
        })
    }

    fn along(&self, pixels: f64) -> f64 {
        let length = pixels.abs() * self.pixel_spacing;
        match self.sampling {
            Sampling::Arc => self.angle_of(length),
            Sampling::Angle => length / self.radius,
        }
    }

    fn pixels(&self, along: f64) -> f64 {
        let length = match self.sampling {
            Sampling::Arc => self.length(along),
            Sampling::Angle => along * self.radius,
        };
        length / self.pixel_spacing
    }

    fn place(&self, pixels: f64) -> [DVec2; 2] {
        let along = self.along(pixels);
        let outwards = DVec2::from_angle(along + self.angle);
        let [place, forward] = [outwards * (self.rate() * along), outwards + outwards.perp() * along];
        // The two spirals are one smooth curve through the middle.
        let side = if pixels < 0.0 { -1.0 } else { 1.0 };
        [place * side, -forward.normalize().perp()]
    }

    /// Pixels from the middle to a position: on the nearest winding, or the inner one of two equally near.
    fn pixels_of(&self, place: DVec2) -> f64 {
        let around = place.to_angle() - self.angle;
        let turns = (place.length() / self.rate() - around) / PI;
        // On each ray from the middle, windings of the two spirals alternate.
        let nearest = (turns - 0.5).ceil();
        // A position before the start of the nearest winding is shown in the middle.
        let along = (around + nearest * PI).max(0.0);
        let side = if nearest.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
        side * self.pixels(along)
    }
}

impl Layout for Spiral {
    fn size(&self) -> [usize; 2] {
        [self.columns.len(), self.rows]
    }

    fn pixel_spacing(&self) -> f64 {
        self.parameters.pixel_spacing
    }

    fn curved(&self, stop: Stop) -> Result<Curved> {
        curved_by_rows(self.size(), stop, |j, position, direction| {
            let at = j as f64 * self.parameters.pixel_spacing;
            let middle = self.straightened.world_from_straightened(DVec3::new(0.0, 0.0, at));
            let frame = self.straightened.frame(at);
            let world = |place: DVec2| frame.across * place.x + frame.ahead * place.y;
            for (i, [place, across]) in self.columns.iter().enumerate() {
                position[i] = middle + world(*place);
                direction[i] = world(*across).as_vec3();
            }
        })
    }

    fn arc_length(&self, _: Stop) -> Result<Vec<f64>> {
        Ok((0..self.rows).map(|j| j as f64 * self.parameters.pixel_spacing).collect())
    }

    fn folded(&self, stop: Stop) -> Result<Vec<bool>> {
        by_rows(self.size(), false, stop, |j, row| {
            let at = j as f64 * self.parameters.pixel_spacing;
            for (folded, [place, _]) in row.iter_mut().zip(&self.columns) {
                *folded = self.straightened.advance(at, *place) <= 0.0;
            }
        })
    }

    fn world_from_pixel(&self, pixel: DVec2) -> DVec3 {
        let [place, _] = self.parameters.place(pixel.x - self.middle());
        self.straightened.world_from_straightened(place.extend(pixel.y * self.parameters.pixel_spacing))
    }

    fn pixel_from_world(&self, point: DVec3) -> DVec2 {
        let place = self.straightened.straightened_from_world(point);
        let is_along = (-ON_PICTURE..=self.straightened.length() + ON_PICTURE).contains(&place.z);
        let column = self.parameters.pixels_of(place.truncate()) + self.middle();
        let is_within = (-0.5..=self.columns.len() as f64 - 0.5).contains(&column);
        if !is_along || !is_within {
            return DVec2::NAN;
        }
        DVec2::new(column, place.z / self.parameters.pixel_spacing)
    }
}

/// The size of the image; if too large, the error states a pitch that fits, if there is one.
fn fitting_size(parameters: &SpiralParameters, size: [f64; 2]) -> Result<[usize; 2]> {
    checked_size("size of the spiral CPR", size).map_err(|error| {
        let [width, height] = size;
        let most = (MAX_SIZE as f64).min(MAX_PIXELS as f64 / height);
        // The number of columns is about the area of a section divided by the pitch.
        let fits = parameters.pitch * width / most;
        if height > MAX_SIZE as f64 || fits > 2.0 * parameters.radius {
            return error;
        }
        let pitch = format!("give a pitch of {:.2} mm or more", (fits * 101.0).ceil() / 100.0);
        Error { mended_by: None, ..error }.mend(pitch)
    })
}

#[cfg(test)]
#[path = "tests/spiral.rs"]
mod tests;
