use std::f64::consts::FRAC_PI_3;

use glam::DVec2;
use serde_json::json;

use super::*;
use crate::study::tests::LPS;

const SIZE: [usize; 3] = [48, 48, 40];
const SIDE: f64 = 0.5;
const MIDDLE: f64 = 12.0;
/// Half axes of the lumen (mm); the longer one is at 60 degrees to x.
const AXES: [f64; 2] = [4.0, 3.0];

/// The distance of the wall from the centre in a direction (mm).
fn wall(direction: DVec2) -> f64 {
    let along = DVec2::from_angle(-FRAC_PI_3).rotate(direction.normalize());
    1.0 / (along.x / AXES[0]).hypot(along.y / AXES[1])
}

fn tube(with_radius: bool) -> Study {
    let mut study = Study::default();
    let rows = [[SIDE, 0.0, 0.0, 0.0], [0.0, SIDE, 0.0, 0.0], [0.0, 0.0, SIDE, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let header = json!({"size": SIZE, "dtype": "float32", "world_from_index": rows});
    study.begin_volume(&header.to_string()).expect("room");
    let value = |n: usize| {
        let place = DVec2::new((n % SIZE[0]) as f64, (n / SIZE[0] % SIZE[1]) as f64) * SIDE - MIDDLE;
        let beyond = place.length() - wall(place + DVec2::X * 1e-12);
        40.0 + 300.0 * (0.5 - beyond / (2.0 * SIDE)).clamp(0.0, 1.0) as f32
    };
    let bytes: Vec<u8> = (0..SIZE.iter().product()).flat_map(|n| value(n).to_le_bytes()).collect();
    study.voxel_bytes(0, bytes.len()).expect("room").copy_from_slice(&bytes);
    study.open_centerlines(line(with_radius).as_bytes(), "line.csv", LPS).expect("a line");
    study
}

fn line(with_radius: bool) -> String {
    let radius = if with_radius { [",radius", ",3.5"] } else { ["", ""] };
    let rows: Vec<String> = (2..=17).map(|z| format!("{MIDDLE},{MIDDLE},{z}{}\n", radius[1])).collect();
    format!("x,y,z{}\n{}", radius[0], rows.concat())
}

fn turn(study: &mut Study, at: f64) -> Result<PlaceTurn> {
    study.turn_about(0, at, [200, 100], &|| false)
}

#[test]
fn a_turn_sweeps_the_diameters_of_the_lumen() {
    // In the first view, from the front, x points right. The viewer then moves counterclockwise as seen from the head.
    let expected = |degree: f64| 2.0 * wall(DVec2::from_angle(degree.to_radians()));
    for with_radius in [true, false] {
        let turn = turn(&mut tube(with_radius), 6.0).expect("a turn");
        assert_eq!(turn.diameters.len(), 180);
        for (degree, found) in turn.diameters.iter().enumerate() {
            let found = found.expect("two walls");
            let expected = expected(degree as f64);
            assert!((found - expected).abs() < 0.06, "{degree} degrees: {found} of {expected}");
        }
        let camera = turn.camera.camera().expect("a camera");
        assert!(camera.center().abs_diff_eq([MIDDLE, MIDDLE, 8.0].into(), 1e-9));
        assert!(camera.direction().abs_diff_eq(glam::DVec3::Y, 1e-9));
        assert!(camera.up().abs_diff_eq(glam::DVec3::Z, 1e-9));
        let reach = 50.0 * camera.pixel_spacing();
        assert!((reach - 8.0 * 3.5).abs() < 0.5, "{reach} mm to each side");
    }
}

#[test]
fn there_is_no_turn_without_a_place_a_volume_or_a_radius() {
    let kind = |found: Result<PlaceTurn>| found.map(|_| "").map_err(|failure| failure.kind);
    let mut study = tube(true);
    assert_eq!(kind(turn(&mut study, 15.1)), Err("camera"), "beyond the end");
    assert_eq!(kind(turn(&mut study, f64::NAN)), Err("camera"));
    assert_eq!(kind(study.turn_about(1, 6.0, [200, 100], &|| false)), Err("settings"), "no such vessel");
    let mut alone = Study::default();
    alone.open_centerlines(line(true).as_bytes(), "line.csv", LPS).expect("a line");
    assert_eq!(kind(turn(&mut alone, 6.0)), Err("volume"));
    let mut even = tube(false);
    let rows = [[SIDE, 0.0, 0.0, 0.0], [0.0, SIDE, 0.0, 0.0], [0.0, 0.0, SIDE, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let header = json!({"size": SIZE, "dtype": "float32", "world_from_index": rows});
    even.begin_volume(&header.to_string()).expect("room");
    even.open_centerlines(line(false).as_bytes(), "line.csv", LPS).expect("a line");
    assert_eq!(kind(turn(&mut even, 6.0)), Err("measuring"), "nothing to measure");
}

#[test]
fn the_best_view_of_a_vessel_looks_across_it_and_keeps_the_size() {
    let study = tube(true);
    let from_above = study.fitted("superior", [200, 100]).expect("a camera");
    let best = study.best_view(&from_above, 0).expect("a view").camera().expect("a camera");
    assert!(best.direction().z.abs() < 0.2, "{}", best.direction());
    assert_eq!(best.size(), [200, 100]);
    assert!(best.center().abs_diff_eq([MIDDLE, MIDDLE, 9.5].into(), 0.5), "{}", best.center());
    assert_eq!(study.best_view(&from_above, 1).map_err(|failure| failure.kind), Err("vessel tree"));
}
