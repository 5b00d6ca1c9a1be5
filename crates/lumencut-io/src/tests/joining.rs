//! Tests that lines which repeat a trunk become vessels that share end points.

use glam::DVec3;

use crate::junctions::vessels;
use crate::{Centerlines, Line};

/// A line with points every 1 mm, including both ends.
fn straight(from: [f64; 3], to: [f64; 3]) -> Vec<DVec3> {
    let (from, to) = (DVec3::from(from), DVec3::from(to));
    let count = from.distance(to).ceil();
    (0..=count as usize).map(|i| from.lerp(to, i as f64 / count)).collect()
}

fn line(legs: &[Vec<DVec3>]) -> Line {
    let mut points = legs.concat();
    points.dedup();
    Line { radius: Some(points.iter().map(|p| 2.0 + p.z / 100.0).collect()), points, ..Line::default() }
}

fn join(lines: Vec<Line>) -> Vec<Line> {
    vessels(Centerlines { lines, ..Centerlines::default() }).lines
}

fn lengths(vessels: &[Line]) -> Vec<usize> {
    vessels.iter().map(|v| v.points.len()).collect()
}

const FORK: [f64; 3] = [0.0, 0.0, 20.0];

fn y() -> [Line; 2] {
    let trunk = straight([0.0; 3], FORK);
    [
        line(&[trunk.clone(), straight(FORK, [0.0, 10.0, 30.0])]),
        line(&[trunk, straight(FORK, [0.0, -10.0, 30.0])]),
    ]
}

#[test]
fn a_y_becomes_three_vessels_that_share_the_fork() {
    let joined = join(y().to_vec());
    assert_eq!(lengths(&joined), [21, 16, 16]);
    let fork = DVec3::from(FORK);
    assert_eq!(joined[0].points.last(), Some(&fork));
    assert_eq!([joined[1].points[0], joined[2].points[0]], [fork; 2]);
    for vessel in &joined {
        let radius: Vec<f64> = vessel.points.iter().map(|p| 2.0 + p.z / 100.0).collect();
        assert_eq!(vessel.radius.as_ref(), Some(&radius));
    }
}

#[test]
fn branches_at_three_heights_cut_the_trunk_three_times() {
    let top = [0.0, 0.0, 40.0];
    let mut lines = vec![line(&[straight([0.0; 3], top)])];
    for z in [10.0, 20.0, 30.0] {
        lines.push(line(&[straight([0.0; 3], [0.0, 0.0, z]), straight([0.0, 0.0, z], [9.0, 0.0, z])]));
    }
    let joined = join(lines);
    assert_eq!(lengths(&joined), [11, 11, 11, 11, 10, 10, 10]);
    for pair in joined[..4].windows(2) {
        assert_eq!(pair[0].points.last(), pair[1].points.first());
    }
}

#[test]
fn identical_lines_are_one_vessel_and_a_shorter_copy_adds_none() {
    let whole = y()[0].clone();
    let mut short = whole.clone();
    short.points.truncate(9);
    short.radius.as_mut().unwrap().truncate(9);
    assert_eq!(join(vec![whole.clone(); 2]), vec![whole.clone()]);
    assert_eq!(join(vec![short, whole.clone()])[0].points, whole.points);
}

#[test]
fn disjoint_lines_and_single_lines_stay_as_they_are() {
    let lines =
        vec![line(&[straight([0.0; 3], FORK)]), line(&[straight([50.0, 0.0, 0.0], [50.0, 9.0, 0.0])])];
    assert_eq!(join(lines.clone()), lines);
    let notes = vessels(Centerlines { lines, ..Centerlines::default() }).notes;
    assert_eq!(notes, Vec::<String>::new());
}

#[test]
fn reversed_lines_share_the_trunk_too() {
    let [a, mut b] = y();
    b.points.reverse();
    b.radius.as_mut().unwrap().reverse();
    let joined = join(vec![a, b]);
    assert_eq!(lengths(&joined), [21, 16, 16]);
    assert_eq!(
        joined[2].points.last(),
        Some(&DVec3::from(FORK)),
        "the vessel keeps the direction of its line"
    );
}

#[test]
fn points_within_the_weld_distance_become_equal_to_the_last_bit() {
    let [a, mut b] = y();
    b.points.iter_mut().filter(|p| p.z <= 20.0).for_each(|p| p.x += 4e-4);
    let joined = join(vec![a.clone(), b.clone()]);
    assert_eq!(lengths(&joined), [21, 16, 16]);
    assert_eq!([joined[1].points[0], joined[2].points[0]], [DVec3::from(FORK); 2]);
    b.points.iter_mut().for_each(|p| p.x += 1.0);
    assert_eq!(join(vec![a, b]).len(), 2);
}

#[test]
fn lines_that_share_a_stretch_in_the_middle_become_five_vessels() {
    let middle = straight([0.0; 3], FORK);
    let lines = [9.0, -9.0]
        .map(|y| line(&[straight([0.0, y, -9.0], [0.0; 3]), middle.clone(), straight(FORK, [0.0, y, 30.0])]));
    let joined = join(lines.to_vec());
    assert_eq!(joined.len(), 5);
    assert_eq!(joined.iter().filter(|v| v.points.len() == 21).count(), 1);
}

#[test]
fn lines_from_two_sources_to_one_outlet_share_the_end() {
    let outlet = straight(FORK, [0.0, 0.0, 30.0]);
    let joined = join(vec![
        line(&[straight([0.0, 9.0, 0.0], FORK), outlet.clone()]),
        line(&[straight([0.0, -9.0, 0.0], FORK), outlet]),
    ]);
    assert_eq!(joined.len(), 3);
}

#[test]
fn crossing_lines_are_no_junction() {
    let lines = vec![
        line(&[straight([-9.0, 0.0, 0.0], [9.0, 0.0, 0.0])]),
        line(&[straight([0.0, -9.0, 0.0], [0.0, 9.0, 0.0])]),
    ];
    assert_eq!(join(lines.clone()), lines, "they even have the point they cross at in common");
}

#[test]
fn a_line_that_ends_on_another_cuts_it() {
    let joined = join(vec![
        line(&[straight([-9.0, 0.0, 0.0], [9.0, 0.0, 0.0])]),
        line(&[straight([0.0; 3], [0.0, 9.0, 0.0])]),
    ]);
    assert_eq!(lengths(&joined), [10, 10, 10]);
}

#[test]
fn loops_stay_loops() {
    let corners = [[0.0; 3], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0; 3]];
    let ring = line(&[
        straight(corners[0], corners[1]),
        straight(corners[1], corners[2]),
        straight(corners[2], corners[3]),
    ]);
    for copies in 1..3 {
        assert_eq!(join(vec![ring.clone(); copies]), vec![ring.clone()]);
    }
    let two_ways = vec![
        line(&[straight(corners[0], corners[1]), straight(corners[1], corners[2])]),
        line(&[straight(corners[0], corners[2])]),
    ];
    assert_eq!(join(two_ways.clone()), two_ways);
}

#[test]
fn lines_that_meet_end_to_end_stay_two_unless_a_group_splitter_cut_them() {
    let mut lines = vec![line(&[straight([0.0; 3], FORK)]), line(&[straight(FORK, [0.0, 0.0, 30.0])])];
    assert_eq!(lengths(&join(lines.clone())), [21, 11]);
    lines[0].group = Some(0);
    lines[1].group = Some(1);
    let joined = join(lines);
    assert_eq!(lengths(&joined), [31]);
    assert_eq!(joined[0].radius.as_ref().unwrap().len(), 31);
}

/// The second line of the Y, resampled, with its trunk `aside` mm to the side.
fn resampled(aside: f64) -> Line {
    let mut b = y()[1].clone();
    for p in &mut b.points {
        if p.z > 0.0 && p.z < 20.0 {
            *p += DVec3::new(aside, 0.0, 0.4);
        }
    }
    b
}

#[test]
fn a_trunk_that_is_sampled_differently_is_merged_within_the_tolerance() {
    let joined = join(vec![y()[0].clone(), resampled(0.1)]);
    assert_eq!(joined.len(), 3);
    assert_eq!(joined[0].points.last(), joined[1].points.first());
    assert_eq!(joined[1].points.first(), joined[2].points.first());
    assert!(joined[0].points.last().unwrap().distance(DVec3::from(FORK)) <= 2.0);
    assert!(joined.iter().all(|v| v.radius.as_ref().unwrap().len() == v.points.len()));
    assert_eq!(join(vec![y()[0].clone(), resampled(1.0)]).len(), 2, "1 mm is half the radius");
}

#[test]
fn lines_of_one_group_are_merged_within_half_the_radius() {
    let [mut a, mut b] = [y()[0].clone(), resampled(0.7)];
    assert_eq!(join(vec![a.clone(), b.clone()]).len(), 2);
    (a.group, b.group) = (Some(0), Some(0));
    assert_eq!(join(vec![a, b]).len(), 3);
}

#[test]
fn a_line_goes_on_where_the_copy_it_began_at_was_merged() {
    let beside: Vec<DVec3> = straight([0.1, 0.0, 0.0], [0.1, 0.0, 20.0]);
    let branch = straight([0.1, 0.0, 20.0], [0.1, 9.0, 20.0]);
    let joined = join(vec![y()[0].clone(), line(&[beside]), line(&[branch])]);
    assert_eq!(lengths(&joined), [21, 16, 10]);
    assert_eq!(joined[2].points[0], DVec3::from(FORK));
}

#[test]
fn cut_lines_whose_shared_points_say_where_they_part_are_not_merged_further() {
    let [a, b] = y();
    let cells = [(&a, 0..24, 0), (&a, 23..36, 1), (&b, 0..24, 0), (&b, 23..36, 2)];
    let cut = cells.map(|(line, range, group)| Line {
        points: line.points[range.clone()].to_vec(),
        radius: line.radius.as_ref().map(|radius| radius[range].to_vec()),
        group: Some(group),
        name: None,
        ..Line::default()
    });
    assert_eq!(lengths(&join(cut.to_vec())), [21, 16, 16]);
}

#[test]
fn vessels_that_part_at_a_small_angle_at_a_shared_point_stay_apart() {
    let lines =
        vec![line(&[straight([0.0; 3], [0.0, 0.0, 30.0])]), line(&[straight([0.0; 3], [0.0, 4.0, 30.0])])];
    assert_eq!(join(lines.clone()), lines, "7.6° is more than the 6° that are told apart");
}

#[test]
fn trunks_without_radius_are_merged_too_and_names_are_kept() {
    let mut lines = y().to_vec();
    for (line, name) in lines.iter_mut().zip(["left", "right"]) {
        line.radius = None;
        line.name = Some(name.into());
    }
    let joined = join(lines);
    let names: Vec<_> = joined.iter().map(|v| v.name.as_deref().unwrap()).collect();
    assert_eq!(names, ["left", "left", "right"]);
    assert!(joined.iter().all(|v| v.radius.is_none()));
}

#[test]
fn lines_that_know_few_radii_share_their_trunk_as_lines_without_any() {
    let beside = |x: f64, end: [f64; 3]| {
        line(&[straight([x, 0.0, 0.0], [x, 0.0, 20.0]), straight([x, 0.0, 20.0], end)])
    };
    let lines = [beside(0.0, [0.0, 20.0, 40.0]), beside(0.2, [0.0, -20.0, 40.0])];
    let with = |radius: &dyn Fn(usize) -> Option<f64>| {
        let each =
            |line: &Line| Line { radius: (0..line.points.len()).map(radius).collect(), ..line.clone() };
        lengths(&join(lines.iter().map(each).collect()))
    };
    let [none, few] = [with(&|_| None), with(&|i| Some(if i % 2 == 0 { 0.0 } else { 4.0 }))];
    assert_eq!((none.len(), &few), (3, &none));
}
