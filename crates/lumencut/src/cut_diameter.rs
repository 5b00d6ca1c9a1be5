//! Measures the diameter of a vessel in a view that is centred on a point of the vessel.

use lumencut_core::camera::Camera;
use lumencut_core::math::statistics::median;
use lumencut_core::volume::Volume;

use crate::windows::sample;

/// Distances from the centre in radii: the lumen is sampled up to the first, the surroundings between the other two.
const LUMEN_RADII: f64 = 0.5;
const SURROUNDINGS_RADII: [f64; 2] = [1.5, 3.0];
const SAMPLES: usize = 200;

/// The diameter (mm) that the view cuts; None if there are not two walls.
///
/// It is measured on the image's horizontal line through the camera's center, where the cut runs inside the lumen. On each side,
/// the wall is where values first pass midway between two levels. These are the median within half a radius (lumen), and the value
/// within three radii that differs most from it. A wall beyond 1.5 radii belongs to a touching vessel; then the result is None.
/// `radius` is an estimate (mm).
pub fn cut_diameter(volume: &Volume, camera: &Camera, radius: f64) -> Option<f64> {
    let places: Vec<f64> = (0..=2 * SAMPLES)
        .map(|n| SURROUNDINGS_RADII[1] * radius * (n as f64 / SAMPLES as f64 - 1.0))
        .collect();
    let points: Vec<_> = places.iter().map(|place| camera.center() + *place * camera.right()).collect();
    let values: Vec<f64> = sample(volume, &points).into_iter().map(f64::from).collect();
    let within = |from: f64, to: f64| -> Vec<f64> {
        let place = |n: &usize| (from * radius..=to * radius).contains(&places[*n].abs());
        (0..places.len()).filter(place).map(|n| values[n]).collect()
    };
    let mut inside = within(0.0, LUMEN_RADII);
    let mut around: Vec<f64> =
        within(SURROUNDINGS_RADII[0], f64::INFINITY).into_iter().filter(|value| value.is_finite()).collect();
    if inside.iter().any(|value| value.is_nan()) {
        return None;
    }
    let (lumen, around) = (median(&mut inside)?, median(&mut around)?);
    let sign = if around <= lumen { 1.0 } else { -1.0 };
    let depth: Vec<f64> = values.iter().map(|value| sign * (value - lumen)).collect();
    let left: Vec<f64> = depth[..=SAMPLES].iter().rev().copied().collect();
    let step = SURROUNDINGS_RADII[1] * radius / SAMPLES as f64;
    let wall = |depth| {
        steps_to_wall(depth).map(|steps| step * steps).filter(|at| *at <= SURROUNDINGS_RADII[0] * radius)
    };
    Some(wall(&left)? + wall(&depth[SAMPLES..])?)
}

fn steps_to_wall(depth: &[f64]) -> Option<f64> {
    let half = depth.iter().copied().fold(0.0, f64::min) / 2.0;
    let after = depth.iter().position(|value| *value <= half).filter(|after| half < 0.0 && *after > 0)?;
    let share = (depth[after - 1] - half) / (depth[after - 1] - depth[after]);
    // NaN if the wall would be next to values outside the volume.
    Some((after - 1) as f64 + share).filter(|steps| steps.is_finite())
}

#[cfg(test)]
#[path = "tests/cut_diameter.rs"]
mod tests;
