//! The foot of each pixel: the point of a vessel nearest to it in the image, at any depth.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::camera::Camera;
use crate::error::Result;
use crate::math::projection::Level;
use crate::reformations::cr::nearest_slots;
use crate::scene::LeveledTree;
use crate::stop::Stop;
use crate::vessel_tree::{Vessel, VesselTree};

#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    /// Arc length (mm).
    pub at: f64,
    pub segment: usize,
    /// Position of the foot in the image (mm, to the right and upwards).
    pub place: DVec2,
    /// Offset from the foot to the pixel (mm).
    pub aside: DVec2,
}

#[derive(Clone, Debug)]
pub(super) struct Feet {
    camera: Camera,
    points: Vec<DVec3>,
    places: Vec<DVec2>,
    arc_length: Arc<[f64]>,
}

impl Feet {
    pub(super) fn new(camera: &Camera, points: Vec<DVec3>, arc_length: &[f64]) -> Self {
        let places = points.iter().map(|point| camera.view_from_world(*point).truncate()).collect();
        Self { camera: *camera, points, places, arc_length: arc_length.into() }
    }

    pub(super) fn places(&self) -> &[DVec2] {
        &self.places
    }

    pub(super) fn of(&self, place: DVec2) -> Foot {
        self.among(place, 0, self.places.len() - 1)
    }

    /// A function that returns the foot of each pixel, by its number row by row.
    pub(super) fn of_pixels(&self, stop: Stop) -> Result<impl Fn(usize) -> Foot + Sync + '_> {
        let vessel = Vessel::new(self.points.clone(), None)?;
        let levels = LeveledTree::new(VesselTree::new(vec![vessel])?).levels(0, 0.0);
        let slots = nearest_slots(&levels[0], &self.camera, stop)?;
        let points = self.points_of_slots(&levels[0]);
        let width = self.camera.size()[0];
        Ok(move |pixel: usize| {
            let slot = slots[pixel] as usize;
            let (first, last) = (points[slot.saturating_sub(1)], points[(slot + 1).min(points.len() - 1)]);
            let place = [self.camera.view_x(pixel % width), self.camera.view_y(pixel / width)];
            self.among(DVec2::from_array(place), first, last)
        })
    }

    /// The point nearest to `place` on the segments from `first` to `last`; the first of equally near ones.
    fn among(&self, place: DVec2, first: usize, last: usize) -> Foot {
        let mut best = self.on_segment(place, first);
        for segment in first + 1..last {
            let other = self.on_segment(place, segment);
            if other.aside.length_squared() < best.aside.length_squared() {
                best = other;
            }
        }
        best
    }

    fn on_segment(&self, place: DVec2, segment: usize) -> Foot {
        let [start, end] = [self.places[segment], self.places[segment + 1]];
        let (edge, from_start) = (end - start, place - start);
        let square = edge.length_squared();
        let share = if square > 0.0 { (from_start.dot(edge) / square).clamp(0.0, 1.0) } else { 0.0 };
        let [from, to] = [self.arc_length[segment], self.arc_length[segment + 1]];
        Foot {
            at: from + share * (to - from),
            segment,
            place: start + edge * share,
            aside: from_start - edge * share,
        }
    }

    /// The index of the point for each slot: a level omits points that practically repeat the previous one.
    fn points_of_slots(&self, level: &Level) -> Vec<usize> {
        let mut numbered = self.points.iter().enumerate();
        let own = |slot: &DVec3| numbered.by_ref().find(|(_, point)| *point == slot).map(|(n, _)| n);
        let found: Vec<_> = level.points.iter().map_while(own).collect();
        debug_assert_eq!(found.len(), level.points.len());
        found
    }
}
