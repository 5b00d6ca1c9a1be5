//! The wall and the course of a vessel as the tables that rays follow.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use crate::math::tube::{AROUND, Tube, TubeRow};
use crate::reformations::Wall;
use crate::reformations::cpr::Straightened;

/// The largest distance of rows (mm).
const ROW_MM: f64 = 0.5;
/// So far around an opening (mm) the volume decides whether a ray leaves, since openings are known at single places only.
const RIM_MM: f64 = 2.0;

/// The values that bound a lumen.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Halfway from the lumen to its surroundings.
    pub level: f64,
    /// Calcium or metal begins here.
    pub calcium: f64,
    /// Whether the lumen is brighter than its surroundings.
    pub is_bright: bool,
}

/// The tables of a vessel, with the bounds of its lumen by arc length (mm).
pub fn tube(straightened: &Straightened, wall: &Wall, bounds: impl Fn(f64) -> Bounds) -> Tube {
    let length = straightened.length();
    let count = (length / ROW_MM).ceil().max(1.0) as usize;
    let step = length / count as f64;
    let origin = straightened.world_from_straightened(DVec3::new(0.0, 0.0, length / 2.0));
    let directions: Vec<f64> = (0..AROUND).map(direction).collect();
    let row = |n: usize| {
        let at = n as f64 * step;
        let frame = straightened.frame(at);
        let middle = straightened.world_from_straightened(DVec3::new(0.0, 0.0, at)) - origin;
        let Bounds { level, calcium, is_bright } = bounds(at);
        let with = |vector: DVec3, last: f64| vector.as_vec3().extend(last as f32).to_array();
        let radius = directions.iter().map(move |around| {
            let radius = wall.radius(at, *around) as f32;
            if wall.is_open(at, *around) { -radius } else { radius }
        });
        let row = TubeRow {
            middle: with(middle, level),
            tangent: with(frame.tangent, calcium),
            across: with(frame.across, if is_bright { 1.0 } else { -1.0 }),
        };
        (row, widened_around(&radius.collect::<Vec<f32>>()))
    };
    let (rows, radius): (Vec<_>, Vec<_>) = (0..=count).map(row).unzip();
    Tube::new(origin, step, rows, widened_along(&radius, (RIM_MM / step).round() as usize))
}

/// The radii of a row, with openings that reach [`RIM_MM`] farther around.
fn widened_around(radii: &[f32]) -> Vec<f32> {
    let count = radii.len();
    let reach = |radius: f32| (RIM_MM / f64::from(radius.abs()) / TAU * AROUND as f64).ceil() as usize;
    let is_near =
        |n: usize, by: usize| radii[(n + by) % count] < 0.0 || radii[(n + count - by) % count] < 0.0;
    let radius = |n: usize| {
        let is_open = (0..=reach(radii[n]).min(count / 2)).any(|by| is_near(n, by));
        if is_open { -radii[n].abs() } else { radii[n] }
    };
    (0..count).map(radius).collect()
}

/// The radii of all rows, with openings that reach some rows farther along.
fn widened_along(rows: &[Vec<f32>], reach: usize) -> Vec<f32> {
    let row = |n: usize| {
        let near = &rows[n.saturating_sub(reach)..(n + reach + 1).min(rows.len())];
        let radius = move |k: usize| {
            if near.iter().any(|radii| radii[k] < 0.0) { -rows[n][k].abs() } else { rows[n][k] }
        };
        (0..AROUND).map(radius)
    };
    (0..rows.len()).flat_map(row).collect()
}

/// The angle (radians) of an entry of a row.
fn direction(entry: usize) -> f64 {
    let turn = entry as f64 * 4.0 / AROUND as f64;
    let quarter = turn.floor();
    let share = turn - quarter;
    // A quarter of the diamond |x| + |y| = 1.
    share.atan2(1.0 - share) + quarter * FRAC_PI_2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::tube::turn_of;

    #[test]
    fn entries_of_a_row_are_even_turns() {
        for entry in 0..AROUND {
            let (sine, cosine) = direction(entry).sin_cos();
            let turn = turn_of([cosine as f32, sine as f32]) * AROUND as f32 / 4.0;
            let away = (turn - entry as f32).abs();
            assert!(away.min(AROUND as f32 - away) < 1e-4, "entry {entry}: {turn}");
        }
        assert_eq!(turn_of([0.0; 2]), 0.0);
    }
}
