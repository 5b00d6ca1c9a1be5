use glam::{DQuat, DVec3};

use super::Motion;

fn moved(point: DVec3) -> DVec3 {
    DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.5) * point + DVec3::new(40.0, -25.0, 300.0)
}

fn pairs(points: &[DVec3]) -> Vec<[DVec3; 2]> {
    points.iter().map(|point| [*point, moved(*point)]).collect()
}

#[test]
fn three_pairs_determine_the_motion() {
    let corners = [DVec3::ZERO, 50.0 * DVec3::X, 20.0 * DVec3::Y];
    let found = Motion::of_pairs(&pairs(&corners)).expect("a triangle");
    let elsewhere = DVec3::new(-12.0, 33.0, 70.0);
    assert!(found.of(elsewhere).distance(moved(elsewhere)) < 1e-9);
}

#[test]
fn one_or_two_pairs_shift() {
    assert_eq!(Motion::of_pairs(&[]).expect("no pair"), Motion::NONE);
    let shift = [[DVec3::X, DVec3::new(3.0, 1.0, 0.0)], [DVec3::ZERO, DVec3::new(2.0, 3.0, 0.0)]];
    let found = Motion::of_pairs(&shift).expect("two pairs");
    assert_eq!(found, Motion { translation: DVec3::new(2.0, 2.0, 0.0), ..Motion::NONE });
}

#[test]
fn points_on_a_line_are_refused() {
    let on_line = [DVec3::ZERO, 30.0 * DVec3::X, DVec3::new(60.0, 2.0, 0.0)];
    let error = Motion::of_pairs(&pairs(&on_line)).expect_err("a line");
    assert_eq!(error.found, "3 points on a line");
    assert!(Motion::of_pairs(&pairs(&[DVec3::X; 3])).is_err());
}
