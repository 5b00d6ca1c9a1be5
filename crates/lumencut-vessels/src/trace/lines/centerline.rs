//! A centerline: points with radii and confidence.

use glam::DVec3;

use crate::trace::lines::even_steps::even_places;

/// A centerline with a radius and a confidence for each point.
#[derive(Clone, Debug, PartialEq)]
pub struct Centerline {
    /// Points (mm, LPS).
    pub points: Vec<DVec3>,
    /// Radius of the lumen at each point (mm).
    pub radius: Vec<f64>,
    /// Confidence that the point is in the centre of a lumen, 0 to 1.
    pub confidence: Vec<f64>,
}

impl Centerline {
    /// Resamples in even steps of at most `step` mm; the end points stay bit-identical.
    pub fn resampled(&self, step: f64) -> Self {
        let places = even_places(&self.points, step);
        let between = |values: &[f64]| places.iter().map(|place| place.value(values)).collect();
        let mut points: Vec<DVec3> = places.iter().map(|place| place.point(&self.points)).collect();
        let last = points.len() - 1;
        (points[0], points[last]) = (self.points[0], self.points[self.points.len() - 1]);
        Self { points, radius: between(&self.radius), confidence: between(&self.confidence) }
    }

    /// Reverses the direction of the line.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.points.reverse();
        self.radius.reverse();
        self.confidence.reverse();
        self
    }

    /// Appends another line at the end.
    pub fn append(&mut self, mut other: Self) {
        self.points.append(&mut other.points);
        self.radius.append(&mut other.radius);
        self.confidence.append(&mut other.confidence);
    }
}
