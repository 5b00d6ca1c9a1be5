//! Lumen map: the wall of a vessel cut open along it and unrolled, so that calcium, stent struts and the openings of
//! branches all around it show in one image. After the radial ray casting of "Curve-centric Volume Reformation for
//! Comparative Visualization" (Lampe, Correa, Ma, Hauser, IEEE TVCG 15(6), 2009, doi:10.1109/TVCG.2009.136), of which
//! only the abstract and the introduction were available; the formulas are ours.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::cpr::{Straightened, View};
use super::cut_locus::CutLocus;
use super::layout::{Layout, by_rows, checked_size, curved_by_rows, whole_pixels};
use super::wall::Wall;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::Curved;
use crate::limits::Limits;
use crate::math::centerline_path::CenterlinePath;
use crate::math::same_place::ON_PICTURE;
use crate::stop::{Stop, go_on};

const PIXEL_SPACING: Limits = Limits::new(1e-6, 1e4, "mm");
const OVERLAP: Limits = Limits::new(0.0, 3.0, "rad");

/// Brightness of a wall seen edge on, and the additional brightness of one seen face on.
const EDGE_AND_FACE_BRIGHTNESS: [f64; 2] = [0.3, 0.7];

/// The layout of a lumen map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LumenMapParameters {
    /// The side of a pixel (mm): along the vessel, and around it at the mean radius.
    pub pixel_spacing: f64,
    /// The radius at which widths in the map are true (mm).
    pub mean_radius: f64,
    /// The direction of the middle column (radians): 0 is to the right in the straightened CPR at angle 0.
    pub angle: f64,
    /// The angle by which each edge is extended with a copy of the other side (radians).
    pub overlap: f64,
    /// Distance of the shown points beyond the wall (mm).
    pub beyond: f64,
}

/// A vessel cut open and unrolled: rows by arc length, columns by the direction around the vessel.
#[derive(Clone)]
pub struct LumenMap {
    path: Arc<CenterlinePath>,
    straightened: Straightened,
    wall: Arc<Wall>,
    parameters: LumenMapParameters,
    /// Number of columns once around the vessel, and number of repeated columns on each side.
    columns: [usize; 2],
    rows: usize,
}

impl LumenMap {
    /// The map of a vessel with this path and wall in the straightened space of `view`. Fails with
    /// [`ErrorKind::Camera`] for an invalid view, spacing, angle or overlap, or too many pixels.
    pub fn new(
        path: Arc<CenterlinePath>,
        view: &View,
        wall: Arc<Wall>,
        parameters: LumenMapParameters,
    ) -> Result<Self> {
        let LumenMapParameters { pixel_spacing, mean_radius, angle, overlap, .. } = parameters;
        let checked = |limits: Limits, subject: &str, value: f64| {
            limits.check(subject, value).map_err(|error| Error { kind: ErrorKind::Camera, ..error })
        };
        checked(PIXEL_SPACING, "pixel_spacing of the lumen map", pixel_spacing)?;
        checked(OVERLAP, "overlap of the lumen map", overlap)?;
        if !angle.is_finite() {
            let found = format!("{angle}");
            return Err(Error::new(ErrorKind::Camera, "angle of the lumen map", found, "a finite angle"));
        }
        let straightened = Straightened::new(Arc::clone(&path), &View { angle: 0.0, ..*view })?;
        let around = (TAU * mean_radius / pixel_spacing).round().max(1.0);
        let aside = (overlap / TAU * around).round();
        let rows = whole_pixels(path.length(), pixel_spacing) + 1.0;
        let [_, rows] = checked_size("size of the lumen map", [around + 2.0 * aside, rows])?;
        let columns = [around, aside].map(|count| count as usize);
        Ok(Self { path, straightened, wall, parameters, columns, rows })
    }

    /// The layout of the map.
    pub fn parameters(&self) -> &LumenMapParameters {
        &self.parameters
    }

    /// The number of columns on each side that repeat the other side.
    pub fn overlap(&self) -> usize {
        self.columns[1]
    }

    /// The straightened space in which directions around the vessel are measured.
    pub fn straightened(&self) -> &Straightened {
        &self.straightened
    }

    /// The radius of the wall at each pixel (mm).
    pub fn wall(&self, stop: Stop) -> Result<Vec<f64>> {
        self.each(0.0, stop, |at, around| self.wall.radius(at, around))
    }

    /// The wall by arc length and direction.
    pub fn wall_table(&self) -> &Wall {
        &self.wall
    }

    /// Whether each pixel lies in the opening of a branch, where no wall was met.
    pub fn open(&self, stop: Stop) -> Result<Vec<bool>> {
        self.each(false, stop, |at, around| self.wall.is_open(at, around))
    }

    /// Brightness of the wall lit from the middle of the vessel: 1 if the light meets it at right angles.
    pub fn shades(&self, stop: Stop) -> Result<Vec<f32>> {
        let numbers = (0..self.size()[1] + 2).into_par_iter();
        let rows = numbers
            .map(|j| go_on(stop).map(|()| self.wall_row(j)))
            .collect::<Result<Vec<(Vec<DVec3>, Vec<DVec3>)>>>()?;
        let shade = |j: usize, i: usize| {
            let [before, here, after] = [0, 1, 2].map(|step| &rows[j + step]);
            let along = after.0[i + 1] - before.0[i + 1];
            let across = here.0[i + 2] - here.0[i];
            let normal = along.cross(across).normalize_or_zero();
            (EDGE_AND_FACE_BRIGHTNESS[0] + EDGE_AND_FACE_BRIGHTNESS[1] * normal.dot(here.1[i + 1]).abs())
                as f32
        };
        by_rows(self.size(), 0.0, stop, |j, row| {
            row.iter_mut().enumerate().for_each(|(i, pixel)| *pixel = shade(j, i));
        })
    }

    /// Wall points of a row and their directions, with one more column on each side; row 0 is off the image.
    fn wall_row(&self, number: usize) -> (Vec<DVec3>, Vec<DVec3>) {
        let at = (number as f64 - 1.0) * self.parameters.pixel_spacing;
        let (middle, frame) = (self.path.at(at), self.straightened.frame(at));
        let columns = 0..self.size()[0] + 2;
        let ray = |i: usize| {
            let around = self.around(i as f64 - 1.0);
            let (sine, cosine) = around.sin_cos();
            let ray = frame.across * cosine + frame.ahead * sine;
            (middle + ray * self.wall.radius(at, around), ray)
        };
        columns.map(ray).unzip()
    }

    /// The column of a direction around the vessel (radians), with fractions.
    pub fn column(&self, around: f64) -> f64 {
        let share = ((around - self.parameters.angle) / TAU + 0.5).rem_euclid(1.0);
        share * self.columns[0] as f64 - 0.5 + self.columns[1] as f64
    }

    /// The direction around the vessel (radians) of a column.
    pub fn around(&self, column: f64) -> f64 {
        let [around, aside] = self.columns.map(|count| count as f64);
        TAU * ((column - aside + 0.5) / around - 0.5) + self.parameters.angle
    }

    fn point(&self, at: f64, around: f64, beyond: f64) -> DVec3 {
        let offset = DVec2::from_angle(around) * self.distance(at, around, beyond);
        self.straightened.world_from_straightened(offset.extend(at))
    }

    /// Distance (mm, at least 0) from the middle of the vessel to a point `beyond` mm outside the wall.
    fn distance(&self, at: f64, around: f64, beyond: f64) -> f64 {
        (self.wall.radius(at, around) + beyond).max(0.0)
    }

    fn each<T: Clone + Send>(
        &self,
        nothing: T,
        stop: Stop,
        told: impl Fn(f64, f64) -> T + Sync,
    ) -> Result<Vec<T>> {
        by_rows(self.size(), nothing, stop, |j, row| {
            let at = j as f64 * self.parameters.pixel_spacing;
            for (i, pixel) in row.iter_mut().enumerate() {
                *pixel = told(at, self.around(i as f64));
            }
        })
    }
}

impl Layout for LumenMap {
    fn size(&self) -> [usize; 2] {
        [self.columns[0] + 2 * self.columns[1], self.rows]
    }

    fn pixel_spacing(&self) -> f64 {
        self.parameters.pixel_spacing
    }

    fn curved(&self, stop: Stop) -> Result<Curved> {
        let beyond = self.parameters.beyond;
        let directions: Vec<_> = (0..self.size()[0]).map(|i| self.around(i as f64)).collect();
        curved_by_rows(self.size(), stop, |j, position, direction| {
            let at = j as f64 * self.parameters.pixel_spacing;
            let (middle, frame) = (self.path.at(at), self.straightened.frame(at));
            for (i, around) in directions.iter().enumerate() {
                let (sine, cosine) = around.sin_cos();
                let ray = frame.across * cosine + frame.ahead * sine;
                direction[i] = ray.as_vec3();
                // In the opening of a branch there is no wall to show.
                if !self.wall.is_open(at, *around) {
                    position[i] = middle + ray * self.distance(at, *around, beyond);
                }
            }
        })
    }

    fn arc_length(&self, _: Stop) -> Result<Vec<f64>> {
        Ok((0..self.rows).map(|j| j as f64 * self.parameters.pixel_spacing).collect())
    }

    fn folded(&self, stop: Stop) -> Result<Vec<bool>> {
        let cut_locus = CutLocus::new(&self.path);
        self.each(false, stop, |at, around| {
            let offset = DVec2::from_angle(around) * self.distance(at, around, self.parameters.beyond);
            let point = self.straightened.world_from_straightened(offset.extend(at));
            self.straightened.advance(at, offset) <= 0.0 || cut_locus.is_beyond(point, at)
        })
    }

    fn world_from_pixel(&self, pixel: DVec2) -> DVec3 {
        let (at, around) = (pixel.y * self.parameters.pixel_spacing, self.around(pixel.x));
        self.point(at, around, self.parameters.beyond)
    }

    fn pixel_from_world(&self, point: DVec3) -> DVec2 {
        let place = self.straightened.straightened_from_world(point);
        let offset = place.truncate();
        let is_along = (-ON_PICTURE..=self.path.length() + ON_PICTURE).contains(&place.z);
        if !is_along || offset == DVec2::ZERO {
            return DVec2::NAN;
        }
        DVec2::new(self.column(offset.to_angle()), place.z / self.parameters.pixel_spacing)
    }
}

#[cfg(test)]
#[path = "tests/lumen_map.rs"]
mod tests;
