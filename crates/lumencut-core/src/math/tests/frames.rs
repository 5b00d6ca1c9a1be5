use std::f64::consts::TAU;

use super::*;
use crate::vessel_tree::Vessel;

const RADIUS: f64 = 20.0;
const PITCH: f64 = 5.0;

fn helix(a: f64) -> (DVec3, DVec3, DVec3) {
    let (sine, cosine) = a.sin_cos();
    let point = DVec3::new(RADIUS * cosine, RADIUS * sine, PITCH * a);
    let tangent = DVec3::new(-RADIUS * sine, RADIUS * cosine, PITCH).normalize();
    (point, tangent, DVec3::new(-cosine, -sine, 0.0))
}

fn from_normal(frame: &MovingFrame, a: f64) -> f64 {
    let (_, tangent, normal) = helix(a);
    frame.ahead.dot(tangent.cross(normal)).atan2(frame.ahead.dot(normal))
}

/// Rotation of the analytic rotation-minimising frame relative to the Frenet frame: −∫τ ds.
fn analytic(a: f64) -> f64 {
    let speed = RADIUS.hypot(PITCH);
    -PITCH / speed.powi(2) * (a * speed)
}

fn apart(one: f64, other: f64) -> f64 {
    (one - other + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0
}

#[test]
fn double_reflection_is_of_fourth_order() {
    let error = |steps: u32| {
        let (_, tangent, normal) = helix(0.0);
        let mut frame = MovingFrame::looking(tangent, normal);
        for n in 0..steps {
            let [a, b] = [n, n + 1].map(|n| TAU * f64::from(n) / f64::from(steps));
            frame = double_reflection(frame, helix(b).0 - helix(a).0, helix(b).1);
        }
        apart(from_normal(&frame, TAU), analytic(TAU)).abs()
    };
    let [coarse, fine] = [error(30), error(60)];
    assert!(coarse < 1e-3 && (12.0..20.0).contains(&(coarse / fine)), "{coarse} {fine}");
}

fn frames(points: Vec<DVec3>, ahead: DVec3) -> (CenterlinePath, Frames) {
    let path = CenterlinePath::new(&Vessel::new(points, None).unwrap(), 0.0).unwrap();
    let frames = Frames::new(&path, MovingFrame::looking(path.direction()[0], ahead));
    (path, frames)
}

#[test]
fn a_finely_sampled_helix_has_the_analytic_frame() {
    let count = 3 * 250;
    let points: Vec<_> = (0..=count).map(|n| helix(3.0 * TAU * f64::from(n) / f64::from(count)).0).collect();
    let (path, frames) = frames(points, helix(0.0).2);
    let first = from_normal(&frames.at(path.length() / 2.0 / f64::from(count)), TAU * 1.5 / f64::from(count));
    for n in (0..count).step_by(10) {
        let a = TAU * 3.0 * (f64::from(n) + 0.5) / f64::from(count);
        let t = path.length() * (f64::from(n) + 0.5) / f64::from(count);
        let turned = apart(
            from_normal(&frames.at(t), a) - first,
            analytic(a) - analytic(TAU * 1.5 / f64::from(count)),
        );
        assert!(turned.abs() < 1e-3, "{turned} rad after {t} mm");
        assert!(frames.at(t).tangent.distance(helix(a).1) < 1e-3);
    }
}

#[test]
fn frames_are_orthonormal_and_continuous_everywhere() {
    // The path has a right angle, a point of inflection, a straight run, and a reversal.
    let points =
        [[0, 0, 0], [20, 0, 0], [20, 30, 0], [22, 35, 0], [20, 40, 0], [20, 60, 0], [20, 50, 0], [20, 40, 9]];
    let points = points.map(|p| DVec3::from_array(p.map(f64::from))).to_vec();
    let (path, frames) = frames(points, DVec3::Z);
    let mut last = frames.at(-1.0);
    for n in -100..=13_000 {
        let MovingFrame { tangent, across, ahead } = frames.at(f64::from(n) * 0.01);
        assert!(tangent.cross(ahead).distance(across) < 1e-12 && (tangent.length() - 1.0).abs() < 1e-12);
        assert!(tangent.distance(last.tangent) < 0.02, "{tangent} after {}", last.tangent);
        assert!(across.distance(last.across) < 0.02);
        last = MovingFrame { tangent, across, ahead };
    }
    assert!(path.length() < 130.0);
    for (t, along) in [(10.0, DVec3::X), (30.0, DVec3::Y), (45.0, DVec3::Y)] {
        assert!(frames.at(t).tangent.distance(along) < 1e-12);
    }
    assert!(frames.at(70.0).ahead.distance(DVec3::Z) < 1e-12);
}

#[test]
fn the_viewer_of_a_turned_frame_moves_to_the_right() {
    // The path runs down the body, seen from the front, so the patient's left is on the right.
    let front = MovingFrame::looking(DVec3::NEG_Z, DVec3::Y);
    assert_eq!(front.across, DVec3::X);
    let turned = front.turned(std::f64::consts::FRAC_PI_2.sin_cos().into());
    assert!(turned.ahead.distance(DVec3::NEG_X) < 1e-15 && turned.across.distance(DVec3::Y) < 1e-15);
}
