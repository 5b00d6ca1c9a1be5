//! The wall of a vessel as a table: its radius by arc length and direction.

use std::f64::consts::TAU;

use crate::error::{Error, ErrorKind, Result};
use crate::math::arc_length::segment_at;

/// The radius of a wall (mm) by arc length and direction, interpolated bilinearly, and the wall's openings.
#[derive(Clone, Debug)]
pub struct Wall {
    at: Vec<f64>,
    directions: usize,
    radius: Vec<f64>,
    open: Vec<bool>,
}

impl Wall {
    /// The wall at rising arc lengths (mm): radius (mm) and opening in evenly spaced directions, from the
    /// right of the straightened vessel into the scene. Fails with [`ErrorKind::VesselTree`] for a table of
    /// other sizes, arc lengths that do not rise, or a radius that is not above 0.
    pub fn new(at: Vec<f64>, radius: Vec<f64>, open: Vec<bool>) -> Result<Self> {
        let directions = if at.is_empty() { 0 } else { radius.len() / at.len() };
        let rises = at.windows(2).all(|ends| ends[1] > ends[0]);
        let is_table = directions > 0 && radius.len() == directions * at.len() && open.len() == radius.len();
        if !is_table || !rises {
            let found = format!("{} arc lengths, {} radii", at.len(), radius.len());
            let expected = "the same number of radii for each arc length, in rising order";
            return Err(Error::new(ErrorKind::VesselTree, "wall of the vessel", found, expected));
        }
        if let Some(wrong) = radius.iter().find(|radius| !(**radius > 0.0 && radius.is_finite())) {
            let found = format!("{wrong} mm");
            return Err(Error::new(ErrorKind::VesselTree, "radius of the wall", found, "radii above 0 mm"));
        }
        Ok(Self { at, directions, radius, open })
    }

    /// The radius (mm) at an arc length (mm), in a direction (radians).
    pub fn radius(&self, at: f64, around: f64) -> f64 {
        let (rows, along) = self.rows(at);
        let place = (around / TAU).rem_euclid(1.0) * self.directions as f64;
        let first = place.floor();
        let share = place - first;
        let columns = [first as usize % self.directions, (first as usize + 1) % self.directions];
        let [low, high] = rows.map(|row| {
            let [a, b] = columns.map(|column| self.radius[row * self.directions + column]);
            a + (b - a) * share
        });
        low + (high - low) * along
    }

    /// Whether the wall is open at a place, by the nearest table entry, or the later one of two equally near.
    pub fn is_open(&self, at: f64, around: f64) -> bool {
        let (rows, along) = self.rows(at);
        let row = rows[usize::from(along >= 0.5)];
        let column =
            ((around / TAU).rem_euclid(1.0) * self.directions as f64).round() as usize % self.directions;
        self.open[row * self.directions + column]
    }

    fn rows(&self, at: f64) -> ([usize; 2], f64) {
        if self.at.len() == 1 {
            return ([0, 0], 0.0);
        }
        let row = segment_at(&self.at, at);
        let along = (at - self.at[row]) / (self.at[row + 1] - self.at[row]);
        ([row, row + 1], along.clamp(0.0, 1.0))
    }
}
