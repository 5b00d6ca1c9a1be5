//! A centerline with its radii, and how sure each of its points is.

use glam::DVec3;

use crate::trace::lines::even_steps::even_places;

/// A centerline, and what is known at each of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Centerline {
    /// The points (mm, LPS).
    pub points: Vec<DVec3>,
    /// The radius of the lumen (mm).
    pub radius: Vec<f64>,
    /// How sure the point is, 0 to 1.
    pub confidence: Vec<f64>,
}

impl Centerline {
    /// The same line in even steps of at most `step` (mm); its ends stay to the bit.
    pub fn resampled(&self, step: f64) -> Self {
        let places = even_places(&self.points, step);
        let between = |values: &[f64]| places.iter().map(|place| place.value(values)).collect();
        let mut points: Vec<DVec3> = places.iter().map(|place| place.point(&self.points)).collect();
        let last = points.len() - 1;
        (points[0], points[last]) = (self.points[0], self.points[self.points.len() - 1]);
        Self { points, radius: between(&self.radius), confidence: between(&self.confidence) }
    }

    /// The same line from its end to its start.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.points.reverse();
        self.radius.reverse();
        self.confidence.reverse();
        self
    }

    /// Goes on with the points of another line.
    pub fn append(&mut self, mut other: Self) {
        self.points.append(&mut other.points);
        self.radius.append(&mut other.radius);
        self.confidence.append(&mut other.confidence);
    }
}
