//! The angle from which each section of a vessel is seen: constant, or following the narrow or wide side of
//! the lumen, so that an eccentric stenosis shows (our method).

use std::f64::consts::PI;

use crate::error::{Error, ErrorKind, Result};
use crate::math::arc_length::LinePlace;
use crate::named::Named;
use crate::reformations::Wall;

/// Number of diameter directions compared, over half a turn.
const DIRECTIONS: usize = 48;

/// Distance along the vessel between neighbouring angles (mm); they differ by at most one direction.
const STEP_MM: f64 = 0.5;

/// Cost of a change by one direction (mm of diameter); it keeps the angle steady if all diameters are alike.
const CHANGE_COST_MM: f64 = 0.15;

/// Standard deviations (mm) of the Gaussians that smooth the diameters and the angle along the vessel.
const SMOOTHING_MM: [f64; 2] = [1.5, 2.0];

/// The side of the lumen that a picture follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The narrowest side.
    Narrowest,
    /// The widest side.
    Widest,
}

impl Named for Side {
    const NAMES: &'static [(&'static str, Self)] =
        &[("narrowest", Self::Narrowest), ("widest", Self::Widest)];
}

/// An angle about the vessel (radians) by arc length (mm), interpolated linearly.
#[derive(Clone, Debug)]
pub struct Roll {
    at: Vec<f64>,
    angle: Vec<f64>,
}

impl Roll {
    /// The roll with these angles (radians) at rising arc lengths (mm). Fails with [`ErrorKind::Camera`] if
    /// an angle is not finite or there is not one angle per arc length.
    pub fn new(at: Vec<f64>, angle: Vec<f64>) -> Result<Self> {
        let rises = at.windows(2).all(|ends| ends[1] > ends[0]);
        if at.is_empty() || at.len() != angle.len() || !rises || !angle.iter().all(|a| a.is_finite()) {
            let found = format!("{} angles for {} arc lengths", angle.len(), at.len());
            let expected = "one finite angle for each arc length, in rising order";
            return Err(Error::new(ErrorKind::Camera, "roll of the CPR", found, expected));
        }
        Ok(Self { at, angle })
    }

    /// The roll for which the sum of the wall's diameters along a vessel of `length` mm is smallest or
    /// largest, by dynamic programming.
    pub fn following(wall: &Wall, length: f64, side: Side) -> Self {
        let count = (length / STEP_MM).ceil().max(1.0) as usize;
        let at: Vec<f64> = (0..=count).map(|n| length * n as f64 / count as f64).collect();
        let sign = if side == Side::Narrowest { 1.0 } else { -1.0 };
        let diameter = |n: usize, k: usize| {
            let around = PI * k as f64 / DIRECTIONS as f64;
            sign * (wall.radius(at[n], around) + wall.radius(at[n], around + PI))
        };
        let columns: Vec<Vec<f64>> = (0..DIRECTIONS)
            .map(|k| {
                smoothed(&(0..=count).map(|n| diameter(n, k)).collect::<Vec<_>>(), length, SMOOTHING_MM[0])
            })
            .collect();
        let steps = cheapest(&columns);
        let angle: Vec<f64> = steps.iter().map(|step| PI * f64::from(*step) / DIRECTIONS as f64).collect();
        Self { angle: smoothed(&angle, length, SMOOTHING_MM[1]), at }
    }

    /// The arc lengths (mm) of the angles.
    pub fn places(&self) -> &[f64] {
        &self.at
    }

    /// The angles (radians).
    pub fn angles(&self) -> &[f64] {
        &self.angle
    }

    /// The angle at an arc length (mm), clamped to the ends.
    pub fn angle(&self, at: f64) -> f64 {
        LinePlace::at(&self.at, at.clamp(self.at[0], self.at[self.at.len() - 1])).value(&self.angle)
    }
}

/// The directions with the smallest cost, unwrapped. Ties go to no change, then to the smaller direction.
fn cheapest(cost: &[Vec<f64>]) -> Vec<i32> {
    let places = cost[0].len();
    let mut best: Vec<f64> = cost.iter().map(|column| column[0]).collect();
    let mut came = vec![[0i8; DIRECTIONS]; places];
    for place in 1..places {
        let before = best.clone();
        for k in 0..DIRECTIONS {
            let from = |step: i8| (k + DIRECTIONS).wrapping_add_signed(-isize::from(step)) % DIRECTIONS;
            let whole = |step: i8| before[from(step)] + CHANGE_COST_MM * f64::from(step.abs());
            let step = [0i8, 1, -1]
                .into_iter()
                .fold(0i8, |best, step| if whole(step) < whole(best) { step } else { best });
            best[k] = whole(step) + cost[k][place];
            came[place][k] = step;
        }
    }
    let last = (0..DIRECTIONS).fold(0, |found, k| if best[k] < best[found] { k } else { found });
    let mut way = vec![0; places];
    way[places - 1] = last as i32;
    for place in (1..places).rev() {
        let here: i32 = way[place];
        way[place - 1] = here - i32::from(came[place][here.rem_euclid(DIRECTIONS as i32) as usize]);
    }
    // The first angle is as near to 0 as possible.
    let turns = (f64::from(way[0]) / DIRECTIONS as f64).round() as i32 * DIRECTIONS as i32;
    way.iter().map(|step| step - turns).collect()
}

/// Values at equal distances along a length (mm), smoothed by a Gaussian, constant beyond the ends.
fn smoothed(values: &[f64], length: f64, deviation: f64) -> Vec<f64> {
    let step = length / (values.len() - 1) as f64;
    let reach = (3.0 * deviation / step).ceil() as isize;
    let weight = |n: isize| (-0.5 * (n as f64 * step / deviation).powi(2)).exp();
    let weights: Vec<f64> = (-reach..=reach).map(weight).collect();
    let total: f64 = weights.iter().sum();
    let last = values.len() as isize - 1;
    (0..=last)
        .map(|n| {
            (-reach..=reach)
                .zip(&weights)
                .map(|(m, w)| w * values[(n + m).clamp(0, last) as usize])
                .sum::<f64>()
                / total
        })
        .collect()
}

#[cfg(test)]
#[path = "../tests/roll.rs"]
mod tests;
