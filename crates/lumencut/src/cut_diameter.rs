//! The diameter of a vessel that the view of a place on it cuts.

use lumencut_core::camera::Camera;
use lumencut_core::math::statistics::median;
use lumencut_core::volume::Volume;

use crate::windows::sample;

/// How far from the middle the lumen is read, from where on its surroundings are, and how far these are read (radii).
const LUMEN: f64 = 0.5;
const AROUND: [f64; 2] = [1.5, 3.0];
/// How many places are read on each side.
const STEPS: usize = 200;

/// The diameter of a vessel (mm) that the view of a place cuts; None where it has no two walls.
///
/// It is read along the line through the camera's center to the right: the cut runs through it within the lumen, and no other
/// vessel of the picture lies on it unless it touches this one. On each side the wall is where the values first pass half way
/// between the lumen, their median within half a radius of the middle, and the value within three radii that differs from it
/// most towards the tissue. A wall that would lie beyond 1.5 radii, from where on what is read counts as surroundings, is that of
/// another vessel which touches this one: there none is told. `radius` is about that of the vessel (mm).
pub fn cut_diameter(volume: &Volume, camera: &Camera, radius: f64) -> Option<f64> {
    let places: Vec<f64> =
        (0..=2 * STEPS).map(|n| AROUND[1] * radius * (n as f64 / STEPS as f64 - 1.0)).collect();
    let points: Vec<_> = places.iter().map(|place| camera.center() + *place * camera.right()).collect();
    let values: Vec<f64> = sample(volume, &points).into_iter().map(f64::from).collect();
    let within = |from: f64, to: f64| -> Vec<f64> {
        let place = |n: &usize| (from * radius..=to * radius).contains(&places[*n].abs());
        (0..places.len()).filter(place).map(|n| values[n]).collect()
    };
    let mut inside = within(0.0, LUMEN);
    let mut around: Vec<f64> =
        within(AROUND[0], f64::INFINITY).into_iter().filter(|value| value.is_finite()).collect();
    if inside.iter().any(|value| value.is_nan()) {
        return None;
    }
    let (lumen, around) = (median(&mut inside)?, median(&mut around)?);
    let sign = if around <= lumen { 1.0 } else { -1.0 };
    let depth: Vec<f64> = values.iter().map(|value| sign * (value - lumen)).collect();
    let left: Vec<f64> = depth[..=STEPS].iter().rev().copied().collect();
    let step = AROUND[1] * radius / STEPS as f64;
    let wall = |depth| steps_to_wall(depth).map(|steps| step * steps).filter(|at| *at <= AROUND[0] * radius);
    Some(wall(&left)? + wall(&depth[STEPS..])?)
}

/// After how many steps values, from the middle on and less the lumen, first fall to half of their deepest.
fn steps_to_wall(depth: &[f64]) -> Option<f64> {
    let half = depth.iter().copied().fold(0.0, f64::min) / 2.0;
    let after = depth.iter().position(|value| *value <= half).filter(|after| half < 0.0 && *after > 0)?;
    let share = (depth[after - 1] - half) / (depth[after - 1] - depth[after]);
    // Beside values outside the volume there is no wall to be told.
    Some((after - 1) as f64 + share).filter(|steps| steps.is_finite())
}

#[cfg(test)]
#[path = "tests/cut_diameter.rs"]
mod tests;
