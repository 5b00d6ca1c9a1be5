//! Tests of the sides of straightened volumes with known frames.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DMat3, DVec3};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::cpr::{Straightened, View};
use lumencut_core::vessel_tree::Vessel;

use super::StraightenedSides;

fn space(points: Vec<DVec3>, angle: f64) -> Straightened {
    let vessel = Vessel::new(points, None).expect("a vessel");
    let path = CenterlinePath::new(&vessel, 0.0).expect("a path");
    let view = View { up: DVec3::Z, angle, normal: None };
    Straightened::new(Arc::new(path), &view).expect("a space")
}

fn straight(along: DVec3) -> Straightened {
    space((0..=40).map(|n| along.normalize() * f64::from(n)).collect(), 0.0)
}

/// An arc of this many quarter turns: up, left, down.
fn arc(quarters: f64) -> Straightened {
    let place = |n: i32| {
        let turn = quarters * PI / 2.0 * f64::from(n) / 60.0;
        DVec3::new(1.0 - turn.cos(), 0.0, turn.sin()) * 30.0
    };
    space((0..=60).map(place).collect(), 0.0)
}

#[test]
fn a_vessel_along_an_axis_of_the_patient_states_its_own_frame() {
    let known = [
        (DVec3::NEG_Z, "LPI", 0),
        (DVec3::Z, "RPS", 0),
        (DVec3::X, "SPL", 1),
        (DVec3::NEG_X, "IPR", 1),
        (DVec3::new(0.2, 0.1, 0.9), "RPS", 0),
        (DVec3::new(-0.3, 0.2, -0.9), "LPI", 0),
    ];
    for (along, letters, notes) in known {
        let found = StraightenedSides::of(&straight(along), 1.0, true);
        assert_eq!(found.letters(), letters, "{along}");
        assert_eq!(found.notes().len(), notes, "{along}");
    }
    let turned = space((0..=40).map(|n| DVec3::Z * f64::from(n)).collect(), PI / 2.0);
    assert_eq!(StraightenedSides::of(&turned, 1.0, true).letters(), "PLS");
}

#[test]
fn stated_axes_have_the_handedness_of_the_frame_and_no_others_are_nearer() {
    for n in 0..200 {
        let n = f64::from(n);
        let along = DVec3::new((n * 1.3).sin(), (n * 0.7).cos(), (n * 2.1).sin());
        let points = (0..=40).map(|n| along.normalize() * f64::from(n)).collect();
        let space = space(points, n);
        let axes = StraightenedSides::of(&space, 1.0, true).axes();
        assert_eq!(DMat3::from_cols(axes[0], axes[1], axes[2]).determinant(), -1.0);
        let frame = space.frame(20.0);
        let turned = axes[0].dot(frame.across) + axes[1].dot(frame.ahead) + axes[2].dot(frame.tangent);
        // No frame is more than 62.8 degrees from the nearest rotation of a cube; rotations off by a quarter turn are farther.
        assert!(turned >= 1.0 + 2.0 * 62.81_f64.to_radians().cos(), "{along}: {turned}");
    }
}

#[test]
fn equally_near_axes_do_not_depend_on_rounding() {
    for away in [-1e-9, 0.0, 1e-9] {
        let found = StraightenedSides::of(&straight(DVec3::new(1.0 + away, 0.0, 1.0)), 1.0, true);
        assert_eq!(found.letters(), "RPS");
        assert_eq!(found.notes(), [""; 0]);
    }
}

#[test]
fn noise_of_the_line_does_not_choose_sides() {
    for seed in 0..30 {
        let noise = |n: i32| f64::from((n * 7919 + seed * 104_729).rem_euclid(1000)) / 1000.0 - 0.5;
        let place = |n: i32| DVec3::new(noise(3 * n), noise(3 * n + 1), f64::from(n) * 0.5);
        let found = StraightenedSides::of(&space((0..=80).map(place).collect(), 0.0), 0.5, true);
        let letters = found.letters();
        assert!(letters.ends_with('S'), "{letters}");
    }
}

#[test]
fn a_vessel_that_turns_away_from_its_sides_says_how_far() {
    let bent = StraightenedSides::of(&arc(0.45), 0.5, true);
    assert_eq!((bent.letters(), bent.notes().len()), ("RPS", 0));
    let half = StraightenedSides::of(&arc(2.0), 0.5, true);
    assert_eq!(half.letters(), "SPL");
    let [across, off] = half.notes().try_into().expect("two notes");
    assert!(across.ends_with("to the patient's left"), "{across}");
    let degrees: f64 = off
        .split("up to ")
        .nth(1)
        .and_then(|rest| rest.strip_suffix("° off"))
        .expect("degrees")
        .parse()
        .expect("a number");
    // At both ends, the frame deviates from the tangent of the arc by half a segment.
    assert!((degrees - 90.0).abs() < 3.0, "{degrees}");
}

#[test]
fn the_mark_is_read_back_and_nothing_else_is() {
    let unstated = StraightenedSides::of(&straight(DVec3::Z), 1.0, false);
    assert_eq!(unstated.notes().len(), 1);
    for made in [
        StraightenedSides::of(&arc(2.0), 0.5, true),
        StraightenedSides::of(&straight(DVec3::Z), 1.0, true),
        unstated,
    ] {
        let mark = made.mark();
        assert!(mark.is_ascii() && mark.len() <= 79, "{mark}");
        assert_eq!(StraightenedSides::read(&mark), Some(made.clone()));
        assert_eq!(StraightenedSides::read(&format!("\0 ä content: {mark}. More, ä and more")), Some(made));
    }
    let others = ["", "chest", "Lumencut straightened vessel; sides LPX at its middle; up to 1.0 deg off"];
    let damaged = [
        "Lumencut straightened vessel; sides LPI at its middle; up to nan deg off",
        "Lumencut straightened vessel; sides LPI",
    ];
    for text in others.into_iter().chain(damaged) {
        assert_eq!(StraightenedSides::read(text), None, "{text}");
    }
}
