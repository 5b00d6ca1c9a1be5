//! Uncurl: pictures between the camera's view of a vessel (tangential CPR) and its straightened CPR. Idea and
//! formulas are ours (docs/method/reformations.md).

mod bent;
mod feet;

use std::sync::Arc;

use glam::{DVec2, DVec3};

use self::bent::Bent;
use self::feet::{Feet, Foot};
use super::cut_locus::CutLocus;
use super::layout::{Layout, by_rows, curved_by_rows};
use crate::camera::Camera;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::Curved;
use crate::math::centerline_path::CenterlinePath;
use crate::math::same_place::ON_PICTURE;
use crate::stop::{Stop, filled};

/// The largest number of bisections in the search for a foot; this many reach the resolution of an f64.
const BISECTIONS: usize = 60;

/// One vessel, partly straightened, in the pixels of a camera.
#[derive(Clone, Debug)]
pub struct Uncurl {
    path: Arc<CenterlinePath>,
    camera: Camera,
    amount: f64,
    /// The largest distance from the vessel that a pixel shows (mm).
    reach: f64,
    bent: Bent,
    feet: Feet,
}

impl Uncurl {
    /// A vessel straightened by `amount`: at 0 the tangential CPR from the camera, at 1 the straightened CPR
    /// in the middle of its image. Pixels farther than half of `width` (mm) from the vessel show nothing.
    /// Fails with [`ErrorKind::Settings`] for an amount outside 0 to 1, [`ErrorKind::Camera`] for a width
    /// that is not above 0 mm.
    pub fn new(path: Arc<CenterlinePath>, camera: Camera, amount: f64, width: Option<f64>) -> Result<Self> {
        if !(0.0..=1.0).contains(&amount) {
            let expected = "from 0 (as the camera sees it) to 1 (straightened)";
            return Err(Error::new(
                ErrorKind::Settings,
                "amount of the uncurling",
                format!("{amount}"),
                expected,
            ));
        }
        if let Some(width) = width.filter(|width| !(*width > 0.0 && width.is_finite())) {
            let found = format!("{width} mm");
            return Err(Error::new(ErrorKind::Camera, "width of the uncurling", found, "a width above 0 mm"));
        }
        let bent = Bent::new(&path, &camera, amount);
        let feet = Feet::new(&camera, bent.points.clone(), path.arc_length());
        Ok(Self { path, camera, amount, reach: width.map_or(f64::INFINITY, |width| width / 2.0), bent, feet })
    }

    /// The points of the bent vessel, placed in front of the camera (mm, LPS).
    pub fn points(&self) -> &[DVec3] {
        &self.bent.points
    }

    /// Extent of the vessel from the middle of the image, across and up or down (mm).
    pub fn extent(&self) -> DVec2 {
        self.feet.places().iter().fold(DVec2::ZERO, |extent, place| extent.max(place.abs()))
    }

    fn look(&self, foot: &Foot) -> (DVec3, DVec3) {
        let from_bent = self.bent.true_from_bent(foot.at);
        let aside = self.camera.right() * foot.aside.x + self.camera.up() * foot.aside.y;
        (self.true_point(foot) + from_bent * aside, from_bent * self.camera.direction())
    }

    fn true_point(&self, foot: &Foot) -> DVec3 {
        let along = foot.at - self.path.arc_length()[foot.segment];
        self.path.points()[foot.segment] + self.path.direction()[foot.segment] * along
    }

    fn is_shown(&self, foot: &Foot) -> bool {
        foot.aside.length_squared() <= self.reach * self.reach
    }

    fn place(&self, pixel: DVec2) -> DVec2 {
        let side = self.camera.pixel_spacing();
        DVec2::new(self.camera.view_x(0) + pixel.x * side, self.camera.view_y(0) - pixel.y * side)
    }

    fn each<T: Send + Clone + Sync>(
        &self,
        nothing: T,
        stop: Stop,
        value_of: impl Fn(&Foot) -> T + Sync,
    ) -> Result<Vec<T>> {
        let [width, height] = self.camera.size();
        let foot_of = self.feet.of_pixels(stop)?;
        by_rows([width, height], nothing, stop, |row, pixels| {
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let foot = foot_of(row * width + column);
                if self.is_shown(&foot) {
                    *pixel = value_of(&foot);
                }
            }
        })
    }
}

impl Layout for Uncurl {
    fn size(&self) -> [usize; 2] {
        self.camera.size()
    }

    fn pixel_spacing(&self) -> f64 {
        self.camera.pixel_spacing()
    }

    fn curved(&self, stop: Stop) -> Result<Curved> {
        let [width, height] = self.camera.size();
        let foot_of = self.feet.of_pixels(stop)?;
        curved_by_rows([width, height], stop, |row, position, direction| {
            for (column, (position, direction)) in position.iter_mut().zip(direction).enumerate() {
                let foot = foot_of(row * width + column);
                if self.is_shown(&foot) {
                    let (point, slab) = self.look(&foot);
                    (*position, *direction) = (point, slab.as_vec3());
                }
            }
        })
    }

    fn arc_length(&self, stop: Stop) -> Result<Vec<f64>> {
        self.each(f64::NAN, stop, |foot| foot.at)
    }

    fn folded(&self, stop: Stop) -> Result<Vec<bool>> {
        let [width, height] = self.camera.size();
        if self.amount == 0.0 {
            // Without bending, the point nearest in the image is also nearest in space: nothing is folded.
            return filled(width * height, false, stop);
        }
        let cut_locus = CutLocus::new(&self.path);
        self.each(false, stop, |foot| cut_locus.is_beyond(self.look(foot).0, foot.at))
    }

    fn world_from_pixel(&self, pixel: DVec2) -> DVec3 {
        let foot = self.feet.of(self.place(pixel));
        if self.is_shown(&foot) { self.look(&foot).0 } else { DVec3::NAN }
    }

    fn pixel_from_world(&self, point: DVec3) -> DVec2 {
        let mut found: Vec<_> = self.feet_of_world(point);
        found.sort_by(|a, b| a.aside.length_squared().total_cmp(&b.aside.length_squared()));
        let side = self.camera.pixel_spacing();
        let pixel = |foot: &Foot| {
            let place = foot.place + foot.aside;
            DVec2::new(place.x - self.camera.view_x(0), self.camera.view_y(0) - place.y) / side
        };
        let shows = |pixel: &DVec2| self.world_from_pixel(*pixel).distance(point) <= ON_PICTURE;
        found.iter().map(pixel).find(shows).unwrap_or(DVec2::NAN)
    }
}

impl Uncurl {
    /// The vessel points (feet) whose pixels may show a world point.
    fn feet_of_world(&self, point: DVec3) -> Vec<Foot> {
        let mut marks: Vec<_> = self.path.arc_length().to_vec();
        marks.extend(self.bent.stations().filter(|at| *at > 0.0 && *at < self.path.length()));
        marks.sort_by(f64::total_cmp);
        marks.dedup();
        let mut found = Vec::new();
        for ends in marks.windows(2) {
            let segment = self.path.segment(f64::midpoint(ends[0], ends[1]));
            let edge = self.feet.places()[segment + 1] - self.feet.places()[segment];
            let is_ahead = |at: f64| self.seen(point, segment, at).0.aside.dot(edge) > 0.0;
            let [mut from, mut to] = [ends[0], ends[1]];
            found.extend([self.seen(point, segment, from), self.seen(point, segment, to)]);
            if !is_ahead(from) || is_ahead(to) {
                continue;
            }
            for _ in 0..BISECTIONS {
                let middle = f64::midpoint(from, to);
                *if is_ahead(middle) { &mut from } else { &mut to } = middle;
            }
            found.push(self.seen(point, segment, from));
        }
        found.into_iter().filter(|(_, depth)| depth.abs() <= ON_PICTURE).map(|(foot, _)| foot).collect()
    }

    fn seen(&self, point: DVec3, segment: usize, at: f64) -> (Foot, f64) {
        let [start, end] = [self.feet.places()[segment], self.feet.places()[segment + 1]];
        let ends = &self.path.arc_length()[segment..];
        let place = start.lerp(end, (at - ends[0]) / (ends[1] - ends[0]));
        let mut foot = Foot { at, segment, place, aside: DVec2::ZERO };
        let offset = self.bent.true_from_bent(at).inverse() * (point - self.true_point(&foot));
        foot.aside = DVec2::new(offset.dot(self.camera.right()), offset.dot(self.camera.up()));
        (foot, offset.dot(self.camera.direction()))
    }
}

#[cfg(test)]
#[path = "tests/uncurl.rs"]
mod tests;
