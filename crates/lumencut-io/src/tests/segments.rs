//! Tests that single segments in any order give the vessels of their polylines.

use glam::DVec3;

use super::robust::Random;
use crate::junctions::vessels;
use crate::{Centerlines, Line};

/// A line of `count` steps whose radius changes evenly from `radius[0]` to `radius[1]`.
fn polyline(from: DVec3, to: DVec3, count: usize, radius: [f64; 2]) -> Line {
    let part = |i: usize| i as f64 / count as f64;
    let sway = |i: usize| DVec3::new((part(i) * std::f64::consts::PI).sin() * 3.0, 0.0, 0.0);
    Line {
        points: (0..=count)
            .map(|i| {
                if i == 0 {
                    from
                } else if i == count {
                    to
                } else {
                    from.lerp(to, part(i)) + sway(i)
                }
            })
            .collect(),
        radius: Some((0..=count).map(|i| radius[0] + (radius[1] - radius[0]) * part(i)).collect()),
        ..Line::default()
    }
}

fn tree(steps: usize) -> Vec<Line> {
    let places = [
        [0.0; 3],
        [0.0, 0.0, 40.0],
        [30.0, 0.0, 70.0],
        [-30.0, 0.0, 70.0],
        [-60.0, 9.0, 90.0],
        [-30.0, 0.0, 99.0],
    ]
    .map(DVec3::from);
    let line = |a: usize, b: usize, radius| polyline(places[a], places[b], steps, radius);
    vec![
        line(0, 1, [5.0, 4.0]),
        line(1, 3, [4.0, 3.0]),
        line(1, 2, [4.0, 2.0]),
        line(3, 5, [3.0, 2.0]),
        line(3, 4, [3.0, 1.0]),
    ]
}

fn cut(lines: &[Line]) -> Vec<Line> {
    let of_line = |line: &Line| -> Vec<Line> {
        let radius = line.radius.clone();
        (0..line.points.len() - 1)
            .map(|i| Line {
                points: line.points[i..i + 2].to_vec(),
                radius: radius.as_ref().map(|radius| radius[i..i + 2].to_vec()),
                ..line.clone()
            })
            .collect()
    };
    lines.iter().flat_map(of_line).collect()
}

fn shuffled(mut segments: Vec<Line>, seed: u64) -> Vec<Line> {
    let mut random = Random(seed);
    segments.push(segments[0].clone());
    for i in 0..segments.len() {
        let other = random.below(segments.len());
        segments.swap(i, other);
        if random.below(2) == 0 {
            segments[i].points.reverse();
            segments[i].radius.iter_mut().for_each(|radius| radius.reverse());
        }
    }
    segments
}

fn join(lines: Vec<Line>) -> Centerlines {
    vessels(Centerlines { lines, ..Centerlines::default() })
}

fn sorted(mut lines: Vec<Line>) -> Vec<Line> {
    let key = |line: &Line| (line.points[0] + line.points[1] * 1e-3).to_array().map(|c| (c * 1e6) as i64);
    lines.sort_by_key(key);
    lines
}

#[test]
fn segments_in_their_order_give_the_lines_back() {
    let joined = join(cut(&tree(20)));
    assert_eq!(joined.lines, tree(20));
    assert_eq!(joined.notes[0], "100 single segments were joined to 5 chain(s)");
    assert!(!joined.notes.iter().any(|note| note.contains("common direction")));
}

#[test]
fn shuffled_segments_give_the_same_vessels_away_from_the_widest_end() {
    let expected = sorted(tree(20));
    let first = join(shuffled(cut(&tree(20)), 7));
    assert_eq!(sorted(first.lines.clone()), expected);
    assert_eq!(first.lines[0], tree(20)[0], "the root comes first");
    assert!(first.notes.iter().any(|note| note.contains("start at the end with the largest radius")));
    for seed in 8..20 {
        assert_eq!(join(shuffled(cut(&tree(20)), seed)).lines, first.lines, "whatever the order");
    }
}

#[test]
fn segments_without_radius_run_away_from_the_highest_end() {
    let mut lines = cut(&tree(20));
    lines.iter_mut().for_each(|line| line.radius = None);
    let joined = join(shuffled(lines, 3));
    assert_eq!(joined.lines.len(), 5);
    assert_eq!(joined.lines[0].points[0].z, 99.0);
    assert!(joined.lines.iter().all(|line| line.radius.is_none()));
}

#[test]
fn a_loop_of_segments_is_one_closed_vessel() {
    let count = 60;
    let at = |i: usize| {
        let angle = (i % count) as f64 / count as f64 * std::f64::consts::TAU;
        DVec3::new(20.0 * angle.cos(), 20.0 * angle.sin(), 5.0)
    };
    let ring =
        Line { points: (0..=count).map(at).collect(), radius: Some(vec![2.0; count + 1]), ..Line::default() };
    assert_eq!(join(cut(std::slice::from_ref(&ring))).lines, vec![ring.clone()], "in its order");
    let joined = join(shuffled(cut(std::slice::from_ref(&ring)), 5));
    assert_eq!(joined.lines.len(), 1);
    let line = &joined.lines[0];
    assert_eq!((line.points.len(), line.radius.as_ref().unwrap().len()), (count + 1, count + 1));
    assert_eq!(line.points.first(), line.points.last());
    for pair in line.points.windows(2) {
        assert!(ring.points.windows(2).any(|p| p == pair || [p[1], p[0]] == pair));
    }
}

#[test]
fn a_few_segments_among_lines_keep_their_place() {
    let mut lines = tree(20);
    let end = lines[4].points[20];
    let step =
        Line { points: vec![end, end + DVec3::Y * 3.0], radius: Some(vec![1.0; 2]), ..Line::default() };
    lines.push(step.clone());
    lines.push(Line { points: vec![step.points[1], end + DVec3::Y * 6.0], ..step });
    assert_eq!(join(lines.clone()).lines, lines);
}

#[test]
fn names_and_longer_lines_part_chains() {
    let mut segments = cut(&[polyline(DVec3::ZERO, DVec3::Z * 40.0, 20, [2.0; 2])]);
    segments[10..].iter_mut().for_each(|segment| segment.name = Some("upper".into()));
    assert_eq!(join(segments).lines.iter().map(|line| line.points.len()).collect::<Vec<_>>(), [11, 11]);
    let mut lines = cut(&[polyline(DVec3::ZERO, DVec3::Z * 40.0, 20, [2.0; 2])]);
    let beside = polyline(lines[4].points[1], DVec3::new(0.0, 40.0, 20.0), 9, [1.0; 2]);
    lines.push(beside);
    let mut counts: Vec<_> = join(lines).lines.iter().map(|line| line.points.len()).collect();
    counts.sort_unstable();
    assert_eq!(counts, [6, 10, 16]);
}

#[test]
fn twenty_thousand_segments_are_joined() {
    let segments = shuffled(cut(&tree(4000)), 11);
    assert_eq!(segments.len(), 20_001);
    assert_eq!(join(segments).lines.len(), 5);
}
