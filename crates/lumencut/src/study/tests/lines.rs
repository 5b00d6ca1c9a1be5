//! Tests that lines are edited, shown and saved by their numbers.

use glam::DVec3;
use lumencut_core::error::ErrorKind;
use lumencut_io as centerlines;
use serde_json::json;

use super::{open_phantom, report_of};
use crate::study::line_edits::{MEETING, cut, join};
use crate::study::line_path::path;
use crate::study::lines::{Line, LineContent, ListedLine, NamedLine};
use crate::study::open_study::Study;

/// A line along x in steps of 1 mm from `from` on, with growing radius.
fn straight(from: f64, count: usize) -> Line {
    let along = |n: usize| from + n as f64;
    Line {
        points: (0..count).map(|n| DVec3::new(along(n), 0.0, 0.0)).collect(),
        radius: Some((0..count).map(|n| 1.0 + along(n) / 10.0).collect()),
        confidence: Some(vec![0.5; count]),
        bridged: Some(vec![false; count]),
        by_hand: None,
    }
}

fn reversed(mut line: Line) -> Line {
    line.points.reverse();
    line.radius.as_mut().expect("radii").reverse();
    line
}

#[test]
fn both_parts_of_a_cut_have_its_point() {
    let line = straight(0.0, 11);
    let [first, second] = cut(&line, 3.25).expect("two parts");
    assert_eq!((first.points.len(), second.points.len()), (5, 8));
    assert_eq!(first.points[4], second.points[0]);
    assert_eq!((first.points[4].x, first.radius.as_ref().expect("radii")[4]), (3.25, 1.325));
    assert_eq!((&first.points[..4], &second.points[1..]), (&line.points[..4], &line.points[4..]));
    // A cut at a point of the line adds no point.
    let [first, second] = cut(&line, 4.0 + 1e-9).expect("two parts");
    assert_eq!((&first.points[..], &second.points[..]), (&line.points[..5], &line.points[4..]));
    for at in [0.0, -1.0, 10.0, 99.0, f64::NAN] {
        assert_eq!(cut(&line, at).expect_err("no place within").kind, ErrorKind::VesselTree);
    }
}

#[test]
fn what_was_cut_can_be_joined_again() {
    let line = straight(0.0, 11);
    let [first, second] = cut(&line, 4.0).expect("two parts");
    assert_eq!(join(&first, &second).expect("one line"), line);
    assert_eq!(join(&first, &reversed(second.clone())).expect("one line"), line);
    // The result has the direction of the first line.
    assert_eq!(join(&second, &reversed(first.clone())).expect("one line"), line);
    assert_eq!(join(&reversed(first), &second).expect("one line"), reversed(line));
}

#[test]
fn ends_that_are_apart_are_joined_by_a_stretch_that_is_marked() {
    let (first, second) = (straight(0.0, 5), straight(6.0, 5));
    let line = join(&first, &second).expect("one line");
    let bridged: Vec<f64> = line
        .points
        .iter()
        .zip(line.bridged.as_ref().expect("marks"))
        .filter_map(|(point, is_bridged)| is_bridged.then_some(point.x))
        .collect();
    assert_eq!(bridged, [4.5, 5.0, 5.5]);
    assert!(line.points.windows(2).all(|pair| pair[0].x < pair[1].x));
    assert_eq!(line.confidence.as_ref().expect("confidence").iter().filter(|sure| **sure == 0.0).count(), 3);
    let failure = join(&first, &straight(12.0, 5)).expect_err("far apart");
    assert!(failure.found.contains("8.0 mm") && failure.expected.contains("5.0 mm"));
    assert!(failure.mend.contains("trace the stretch"));
}

#[test]
fn a_path_runs_from_its_first_line_to_its_last_whatever_their_directions() {
    let line = straight(0.0, 11);
    let [first, rest] = cut(&line, 3.0).expect("two parts");
    let [second, third] = cut(&rest, 4.0).expect("two parts");
    let words = ["a", "b", "c"].map(str::to_owned);
    let along = [reversed(first.clone()), second.clone(), reversed(third.clone())];
    assert_eq!(path(&along, &words).expect("a path"), line);
    let back = path(&[third.clone(), second, first.clone()], &words).expect("a path");
    assert_eq!(back.points, reversed(line).points);
    assert_eq!(path(std::slice::from_ref(&first), &words).expect("a path"), first);
    let error = path(&[first, third], &words).expect_err("a gap");
    assert_eq!(error.found, "a gap of 4 mm between a and b");
}

#[test]
fn a_path_leaves_a_line_and_enters_it_where_another_one_begins() {
    let trunk = straight(0.0, 21);
    // Branches start at the trunk's points 5 and 15, since a branch starts at a point of its parent.
    let branch = |x: usize, side: f64| {
        let points = (0..4).map(|n| trunk.points[x] + f64::from(n) * side * DVec3::Y).collect();
        Line { points, radius: Some(vec![0.5; 4]), confidence: Some(vec![1.0; 4]), ..Line::default() }
    };
    let [left, right] = [branch(5, 1.0), branch(15, -1.0)];
    let words = ["a", "b", "c"].map(str::to_owned);
    let places = |lines: &[Line]| -> Vec<DVec3> { path(lines, &words).expect("a path").points };
    let out = places(&[trunk.clone(), left.clone()]);
    assert_eq!(out, [&trunk.points[..=5], &left.points[1..]].concat());
    // The path in reverse, for both directions of the branch.
    let back: Vec<DVec3> = out.iter().rev().copied().collect();
    assert_eq!(places(&[left.clone(), trunk.clone()]), back);
    assert_eq!(places(&[reversed(left.clone()), trunk.clone()]), back);
    // From one branch along the trunk to the other, in both directions.
    let across = places(&[left.clone(), trunk.clone(), right.clone()]);
    let left_back: Vec<DVec3> = left.points.iter().rev().copied().collect();
    assert_eq!(across, [&left_back[..], &trunk.points[6..=15], &right.points[1..]].concat());
    let other: Vec<DVec3> = across.iter().rev().copied().collect();
    assert_eq!(places(&[right.clone(), trunk.clone(), left.clone()]), other);
    assert_eq!(path(&[left, right], &words).expect_err("a gap").found, "a gap of 10 mm between a and b");
}

#[test]
fn ends_that_meet_are_one_point_of_a_path_and_of_a_joined_line() {
    for (apart, count) in [(0.9 * MEETING, 9), (1.1 * MEETING, 10)] {
        let (first, second) = (straight(0.0, 5), straight(4.0 + apart, 5));
        assert_eq!(join(&first, &second).expect("one line").points.len(), count);
        let words = ["a", "b"].map(str::to_owned);
        assert_eq!(path(&[first, second], &words).is_ok(), apart <= MEETING);
    }
}

#[test]
fn a_line_that_knows_more_than_the_other_keeps_it() {
    let bare = Line { points: straight(6.0, 5).points, ..Line::default() };
    let line = join(&straight(0.0, 5), &bare).expect("one line");
    let radius = line.radius.as_ref().expect("radii");
    assert!(radius[..5].iter().all(|radius| radius.is_finite()) && radius[8..].iter().all(|r| r.is_nan()));
    let content = serde_json::to_value(line.content()).expect("JSON");
    assert!(content["radius"][9].is_null() && content["radius"][0].as_f64() == Some(1.0));
}

fn with_line(study: &mut Study, line: &Line) -> usize {
    let content = serde_json::to_value(line.content()).expect("JSON");
    study.add_line(serde_json::from_value::<LineContent>(content).expect("a line")).expect("a line")
}

fn named(line: usize, name: &str) -> NamedLine {
    NamedLine { line, name: name.into() }
}

fn listed(line: usize, name: &str) -> ListedLine {
    ListedLine { line, name: name.into(), hidden: false, ..Default::default() }
}

#[test]
fn lines_are_shown_in_their_order_and_windows_stay() {
    let mut study = Study::default();
    open_phantom(&mut study, "y_junction");
    let before = report_of(&study);
    let lines: Vec<u64> =
        before["vessels"].as_array().expect("vessels").iter().filter_map(|v| v["line"].as_u64()).collect();
    let added = with_line(&mut study, &straight(0.0, 5));
    study.show(&[listed(added, "mine"), listed(lines[1] as usize, "other")]).expect("a tree");
    let report = report_of(&study);
    assert_eq!(
        report["vessels"][0],
        json!({"line": added, "name": "mine", "length": 4.0, "has_radius": true})
    );
    assert_eq!(report["vessels"][1]["length"], before["vessels"][1]["length"]);
    assert_eq!(report["windows"], before["windows"]);
    assert!(study.show(&[listed(9999, "")]).is_err());
    assert_eq!(report_of(&study)["vessels"], report["vessels"]);
    study.show(&[]).expect("the volume alone");
    let report = report_of(&study);
    assert_eq!((&report["vessels"], &report["windows"]), (&json!(null), &before["windows"]));
}

#[test]
fn the_number_of_a_line_never_stands_for_one_of_another_study() {
    let mut study = Study::default();
    open_phantom(&mut study, "y_junction");
    let added = with_line(&mut study, &straight(0.0, 5));
    open_phantom(&mut study, "stenosis");
    assert!((0..=added).all(|line| study.line(line).is_err()));
    let line = report_of(&study)["vessels"][0]["line"].as_u64().expect("a number");
    assert_eq!(line as usize, added + 1);
}

#[test]
fn what_is_no_line_is_refused() {
    let mut study = Study::default();
    let add = |study: &mut Study, content: serde_json::Value| {
        study.add_line(serde_json::from_value(content).expect("a message")).map_err(|failure| failure.kind)
    };
    let line = |points: serde_json::Value, radius: serde_json::Value| json!({"points": points, "radius": radius, "confidence": null, "bridged": null});
    let two = json!([[0, 0, 0], [1, 0, 0]]);
    assert!(add(&mut study, line(two.clone(), json!([1.0, null]))).is_ok());
    for odd in [
        line(json!([[0, 0, 0]]), json!(null)),
        line(json!([[0, 0, 0], [1e9, 0, 0]]), json!(null)),
        line(two.clone(), json!([1.0])),
        line(two.clone(), json!([1.0, -1.0])),
        json!({"points": two, "radius": null, "confidence": [0.5, 1.5], "bridged": null}),
        json!({"points": two, "radius": null, "confidence": null, "bridged": [true]}),
    ] {
        assert_eq!(add(&mut study, odd), Err("vessel tree"));
    }
}

#[test]
fn files_hold_names_radii_and_confidence() {
    let mut study = Study::default();
    let first = with_line(&mut study, &straight(0.0, 5));
    let bare = Line { points: straight(6.0, 5).points, ..Line::default() };
    let second = with_line(&mut study, &bare);
    let lines = [named(first, "SMA & co"), named(second, "")];
    for kind in ["vtp", "mrk.json"] {
        let bytes = study.write(&lines, kind).expect("a file");
        let read = centerlines::read(&bytes, &format!("lines.{kind}")).expect("lines");
        assert_eq!(read.lines[0].points, straight(0.0, 5).points);
        assert_eq!((&read.lines[0].radius, &read.lines[1].radius), (&straight(0.0, 5).radius, &None));
        assert_eq!((read.lines[0].name.as_deref(), &read.lines[1].name), (Some("SMA & co"), &None));
        assert!(read.joined && String::from_utf8_lossy(&bytes).contains("Confidence"));
    }
    assert_eq!(study.write(&lines, "stl").expect_err("no such format").subject, "format");
    assert_eq!(study.write(&[], "vtp").expect_err("no lines").kind, "format");
}

#[test]
fn lines_are_told_by_length_calibre_and_what_they_hang_together_with() {
    let mut study = Study::default();
    let mut add = |line| study.lines.add(line).expect("a line");
    // A piece that is not connected, a trunk of 10 mm, and a branch from one of its points, without radius.
    let piece =
        add(Line { points: vec![DVec3::new(0.0, 50.0, 0.0), DVec3::new(0.0, 50.0, 3.0)], ..Line::default() });
    let trunk = add(straight(0.0, 11));
    let branch =
        add(Line { points: vec![DVec3::new(4.0, 0.0, 0.0), DVec3::new(4.0, 7.0, 0.0)], ..Line::default() });
    let facts = study.line_facts(&[piece, trunk, branch]).expect("lines");
    let told = facts.iter().map(|facts| (facts.line, facts.length, facts.calibre, facts.part));
    // The trunk's radius grows from 1 to 2 mm.
    assert!(told.eq([(piece, 3.0, None, 1), (trunk, 10.0, Some(3.0), 0), (branch, 7.0, None, 0)]));
    let parents = facts.iter().map(|facts| facts.parent);
    assert!(parents.eq([None, None, Some(trunk)]), "the branch hangs on the trunk");
    let alone = study.line_facts(&[branch, piece]).expect("lines");
    assert_eq!([alone[0].part, alone[1].part], [0, 1], "without the trunk they are two parts");
    assert_eq!(study.line_facts(&[branch + 1]).expect_err("no line").kind, "vessel tree");
    // A radius of 0 means unknown.
    let odd = Line {
        radius: Some(vec![0.0, 2.0, 0.0, f64::NAN, 0.0]),
        confidence: None,
        bridged: None,
        ..straight(0.0, 5)
    };
    let odd = study.lines.add(odd).expect("a line");
    assert_eq!(study.line_facts(&[odd]).expect("a line")[0].calibre, Some(4.0));
}
