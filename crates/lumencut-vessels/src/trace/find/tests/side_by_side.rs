use super::*;
use crate::trace::find::made::straight_track;

fn at(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

/// A wide tube along x with a radius of 10 voxels.
fn wide() -> Vec<TrackPoint> {
    straight_track(at(0.0, 0.0), at(60.0, 0.0), 10.0).points
}

#[test]
fn what_runs_beside_the_middle_of_a_wide_tube_is_new_and_its_middle_is_not() {
    assert!(new_runs(&straight_track(at(5.0, 3.0), at(55.0, 3.0), 4.0), &wide()).is_empty());
    let beside = straight_track(at(5.0, 5.0), at(55.0, 5.0), 4.0);
    let runs = new_runs(&beside, &wide());
    assert_eq!(runs.len(), 1);
    assert_eq!(runs[0].points, beside.points);
}

#[test]
fn of_a_track_that_comes_out_of_the_middle_only_the_rest_is_new() {
    let mut track = straight_track(at(5.0, 0.0), at(25.0, 0.0), 4.0);
    track.points.extend(straight_track(at(25.0, 5.0), at(55.0, 5.0), 4.0).points);
    let runs = new_runs(&track, &wide());
    assert_eq!(runs.len(), 1);
    assert_eq!((runs[0].points[0].place, runs[0].length()), (at(25.0, 5.0), 30.0));
}

#[test]
fn what_lies_outside_or_is_short_is_none_of_its_lumens() {
    assert!(new_runs(&straight_track(at(5.0, 14.0), at(55.0, 14.0), 4.0), &wide()).is_empty());
    assert!(new_runs(&straight_track(at(5.0, 5.0), at(16.0, 5.0), 4.0), &wide()).is_empty());
}

#[test]
fn how_far_a_place_is_off_the_axis_is_told_within_a_section_alone() {
    let point = wide()[40];
    assert!((off_axis(point.place + DVec3::new(4.0, 3.0, 0.0), &point) - 3.0).abs() < 1e-12);
    assert_eq!(off_axis(point.place + DVec3::X * 11.0, &point), f64::MAX);
}
