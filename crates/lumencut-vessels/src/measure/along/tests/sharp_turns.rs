use super::*;
use crate::measure::section::Track;
use glam::DVec3;
use lumencut_core::vessel_tree::Vessel;

fn sharpest(points: Vec<DVec3>, diameter: f64) -> f64 {
    let vessel = Vessel::new(points, None).expect("a vessel");
    let places =
        Track::new(&vessel, Some(0.5 * diameter)).and_then(|track| track.places(0.5)).expect("places");
    turns(&places, diameter).into_iter().fold(0.0, f64::max)
}

/// A bend of 180° with this radius (mm), with points every 0.5 mm.
fn bend(radius: f64) -> Vec<DVec3> {
    let count = (std::f64::consts::PI * radius / 0.5) as usize;
    let angle = |n: usize| std::f64::consts::PI * n as f64 / count as f64;
    (0..=count).map(|n| DVec3::new(radius * angle(n).cos(), 0.0, radius * angle(n).sin())).collect()
}

#[test]
fn a_bend_is_no_restless_line() {
    // A bend like a carotid siphon: its radius equals the diameter of the vessel.
    let siphon = sharpest(bend(5.0), 5.0);
    assert!((50.0..SHARP).contains(&siphon), "{siphon}");
    assert!(sharpest(bend(40.0), 25.0) < 45.0);
}

#[test]
fn a_line_along_voxels_is_no_restless_line() {
    // A line with sideways steps of one voxel (0.7 mm), one every 2 mm.
    let stairs = |n: i32| DVec3::new(0.7 * f64::from(n / 3), 0.0, 0.7 * f64::from(n));
    for diameter in [2.0, 6.0, 20.0] {
        let turned = sharpest((0..90).map(stairs).collect(), diameter);
        assert!(turned < SHARP, "{turned} for {diameter} mm");
    }
}

#[test]
fn a_line_that_jumps_from_one_vessel_to_the_next_is_restless() {
    // A line that jumps from a 20 mm wide graft into one of its limbs, and a line with a hook at its end.
    let jump = |n: i32| DVec3::new(if n < 40 { 0.0 } else { 12.0 }, 0.0, f64::from(n));
    let turned = sharpest((0..80).map(jump).collect(), 20.0);
    assert!(turned > SHARP, "{turned}");
    let hook =
        (0..60).map(|n| DVec3::Z * f64::from(n)).chain((1..12).map(|n| DVec3::new(f64::from(n), 0.0, 59.0)));
    assert!(sharpest(hook.collect(), 6.0) > SHARP);
}
