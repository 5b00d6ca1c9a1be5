//! Endoscopy: the wall of a vessel as an eye on its centerline sees it. The definition is ours.

mod lens;
mod tube;
pub mod wall;

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};

pub use lens::{Eye, Lens, LensImage};
pub use tube::{Bounds, tube};
use wall::{Beyond, wall};

use super::layout::{Layout, by_rows, curved_by_rows};
use crate::error::Result;
use crate::geometry::{Curved, Rays};
use crate::math::tube::{Tube, TubePlace};
use crate::stages::Work;
use crate::stop::{Stop, go_on};

/// Rays start at this share of the radius, so that noise at the eye hides nothing.
const START: f64 = 0.3;
/// Rays end here (mm).
const END_MM: f32 = 150.0;
/// Points farther behind the wall (mm) are not shown.
const HIDDEN_MM: f64 = 1.0;
/// Distances of neighbouring pixels that differ by a larger share belong to different walls.
const SAME_WALL: f64 = 0.1;
/// The slope of the wall is that over this distance to each side (mm).
const SLOPE_MM: f32 = 2.0;
/// The light of the eye falls to 1/e after this distance (mm).
const LIGHT_MM: f64 = 50.0;

/// The inside of a vessel from an eye: a distance and a place for each pixel.
#[derive(Clone)]
pub struct Endoscopy {
    eye: Eye,
    image: LensImage,
    tube: Arc<Tube>,
    rays: Arc<Rays>,
    wall: Arc<Vec<f32>>,
    behind: f64,
}

impl Endoscopy {
    /// The view from an eye in a tube, which continues in the volume beyond openings. Fails with
    /// [`crate::error::ErrorKind::Interrupted`].
    pub fn new(tube: Arc<Tube>, eye: Eye, image: LensImage, (beyond, stop): (&Beyond, Stop)) -> Result<Self> {
        let rays = rays(&eye, &image, stop)?;
        let work = Work { size: image.size(), isa: crate::math::lanes::Isa::widest(), stop, progress: None };
        let wall = wall(&work, &rays, (&tube, tube.row_at(eye.at)), beyond)?;
        Ok(Self { eye, image, tube, rays: Arc::new(rays), wall: Arc::new(wall), behind: 0.0 })
    }

    /// The same view, whose positions lie this far behind the wall (mm).
    #[must_use]
    pub fn behind(&self, behind: f64) -> Self {
        Self { behind, ..self.clone() }
    }

    /// The eye.
    pub fn eye(&self) -> &Eye {
        &self.eye
    }

    /// Distance from the eye to the wall (mm) of each pixel; NaN without a wall.
    pub fn depth(&self) -> Vec<f32> {
        self.wall.iter().map(|away| away.abs()).collect()
    }

    /// Whether each pixel looks through an opening of the wall or beyond an end of the vessel.
    pub fn open(&self) -> Vec<bool> {
        self.wall.iter().map(|away| *away < 0.0).collect()
    }

    /// Distance of the wall from the centerline (mm) of each pixel; NaN where no wall of the vessel is seen.
    pub fn radius(&self, stop: Stop) -> Result<Vec<f64>> {
        self.on_vessel(stop, 1)
    }

    /// Brightness of the wall (0 to 1) in the light of the eye; NaN without a wall. `beyond` finds the slope of walls beyond
    /// openings.
    pub fn shades(&self, beyond: &Beyond, stop: Stop) -> Result<Vec<f32>> {
        let reach = beyond.step * 2.0;
        let [width, _] = self.image.size();
        by_rows(self.image.size(), f32::NAN, stop, |row, pixels| {
            for (i, pixel) in pixels.iter_mut().enumerate() {
                let n = row * width + i;
                let (ray, away) = (self.rays.direction()[n], self.wall[n]);
                let point = self.point(n);
                let normal = if away < 0.0 {
                    slope(beyond, point, f64::from(reach))
                } else {
                    self.tube.normal(&self.place(point), SLOPE_MM)
                };
                let light = (-f64::from(away.abs()) / LIGHT_MM).exp() as f32;
                *pixel = if away.is_nan() { f32::NAN } else { normal.dot(ray).abs() * light };
            }
        })
    }

    /// The place in the tube of a pixel's wall point.
    fn place(&self, point: DVec3) -> TubePlace {
        // The search starts where the point would be along a straight vessel.
        let along = (point - self.eye.position).dot(self.tube.tangent(self.eye.at));
        self.tube.place_of(point, self.tube.row_at(self.eye.at + along))
    }

    /// The wall point of a pixel (mm, LPS); NaN without a wall.
    fn point(&self, n: usize) -> DVec3 {
        let width = self.image.size()[0];
        let seen = self.image.direction(DVec2::new((n % width) as f64, (n / width) as f64));
        let away = f64::from(self.wall[n].abs());
        seen.map_or(DVec3::NAN, |seen| self.eye.position + self.eye.world(seen) * away)
    }

    /// Arc length (0) or distance from the centerline (1) of each pixel's wall (mm).
    fn on_vessel(&self, stop: Stop, which: usize) -> Result<Vec<f64>> {
        let [width, _] = self.image.size();
        by_rows(self.image.size(), f64::NAN, stop, |row, pixels| {
            for (i, pixel) in pixels.iter_mut().enumerate() {
                let n = row * width + i;
                if self.wall[n] > 0.0 {
                    let place = self.place(self.point(n));
                    *pixel = f64::from(self.tube.arc_length_and_distance(&place)[which]);
                }
            }
        })
    }

    /// Distance of the wall (mm) at an image position: between pixels of one wall in proportion, else that of the nearest pixel.
    fn away(&self, pixel: DVec2) -> f64 {
        let [width, height] = self.image.size();
        let last = DVec2::new(width as f64 - 1.0, height as f64 - 1.0);
        let place = pixel.clamp(DVec2::ZERO, last);
        let (low, part) = (place.floor(), place - place.floor());
        let at = |x: f64, y: f64| f64::from(self.wall[y as usize * width + x as usize].abs());
        let high = (low + 1.0).min(last);
        let corners = [at(low.x, low.y), at(high.x, low.y), at(low.x, high.y), at(high.x, high.y)];
        let [least, most] =
            corners.iter().fold([f64::MAX, f64::MIN], |[a, b], away| [a.min(*away), b.max(*away)]);
        // A difference from NaN is not below any limit.
        if corners.iter().all(|away| away.is_finite()) && most - least < SAME_WALL * most {
            let rows = [corners[0], corners[2]].map(|first| first * (1.0 - part.x));
            let rows = [rows[0] + corners[1] * part.x, rows[1] + corners[3] * part.x];
            return rows[0] * (1.0 - part.y) + rows[1] * part.y;
        }
        let nearest = place.round();
        at(nearest.x, nearest.y)
    }
}

/// The ray of each pixel.
fn rays(eye: &Eye, image: &LensImage, stop: Stop) -> Result<Rays> {
    let size = image.size();
    let direction = by_rows(size, Vec3::ZERO, stop, |row, pixels| {
        for (i, pixel) in pixels.iter_mut().enumerate() {
            if let Some(seen) = image.direction(DVec2::new(i as f64, row as f64)) {
                *pixel = eye.world(seen).as_vec3();
            }
        }
    })?;
    let start = (START * eye.radius) as f32;
    // A ray without a direction ends where it starts.
    let span = |ray: &Vec3| [start, if *ray == Vec3::ZERO { start } else { END_MM }];
    let spans = direction.iter().map(span).collect();
    Rays::new(size, eye.position, direction, spans)
}

/// The unit direction in which the volume changes most at a point.
fn slope(beyond: &Beyond, point: DVec3, reach: f64) -> Vec3 {
    let change = DVec3::AXES.map(|axis| {
        let [before, after] = [-reach, reach].map(|by| (beyond.value)(point + axis * by));
        after - before
    });
    let slope = Vec3::from_array(change);
    if slope.is_finite() { slope.normalize_or_zero() } else { Vec3::ZERO }
}

impl Layout for Endoscopy {
    fn size(&self) -> [usize; 2] {
        self.image.size()
    }

    /// The side of the middle pixel at a distance of 1 mm (mm).
    fn pixel_spacing(&self) -> f64 {
        let [width, height] = self.size().map(|n| n as f64 / 2.0 - 0.5);
        let near = [DVec2::new(width, height), DVec2::new(width + 0.5, height)];
        let [a, b] = near.map(|pixel| self.image.direction(pixel).unwrap_or(DVec3::Z));
        2.0 * a.angle_between(b)
    }

    fn curved(&self, stop: Stop) -> Result<Curved> {
        let width = self.size()[0];
        curved_by_rows(self.size(), stop, |row, position, direction| {
            for i in 0..width {
                let n = row * width + i;
                let ray = self.rays.direction()[n];
                position[i] = self.point(n) + ray.as_dvec3() * self.behind;
                direction[i] = ray;
            }
        })
    }

    fn arc_length(&self, stop: Stop) -> Result<Vec<f64>> {
        self.on_vessel(stop, 0)
    }

    fn folded(&self, stop: Stop) -> Result<Vec<bool>> {
        go_on(stop).map(|()| vec![false; self.wall.len()])
    }

    fn world_from_pixel(&self, pixel: DVec2) -> DVec3 {
        let [width, height] = self.size().map(|n| n as f64 - 0.5);
        let is_within = pixel.cmpge(DVec2::splat(-0.5)).all() && pixel.cmple(DVec2::new(width, height)).all();
        let seen = self.image.direction(pixel).filter(|_| is_within);
        seen.map_or(DVec3::NAN, |seen| self.eye.position + self.eye.world(seen) * self.away(pixel))
    }

    fn pixel_from_world(&self, point: DVec3) -> DVec2 {
        let way = point - self.eye.position;
        let Some(pixel) = self.image.pixel(self.eye.seen(way)) else { return DVec2::NAN };
        // Without a wall nothing is shown.
        if way.length() <= self.away(pixel) + HIDDEN_MM { pixel } else { DVec2::NAN }
    }
}

#[cfg(test)]
#[path = "tests/endoscopy.rs"]
mod tests;
