//! Tests of the whole vessel that one click adds, as the page requests it.

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;
use serde_json::json;

use super::edits::{after, bare, called, edited, tried};
use super::tracing::points;
use crate::study::document::Document;

#[test]
fn one_click_adds_the_whole_vessel_from_the_one_that_there_is_to_its_end() {
    let (mut study, lines) = bare("y_junction");
    let middle = |line: &[DVec3]| line[line.len() / 2];
    let [trunk, branch] = [&lines[0], &lines[1]].map(|line| (middle(line) + DVec3::X * 0.3).to_array());
    assert_eq!(study.whole_vessel(trunk, &[]).expect("a volume"), None, "nothing was looked for yet");
    let whole = |click: [f64; 3]| json!({"kind": "add_whole_vessel", "click": click});
    let first = edited(&mut study, &Document::default(), &whole(trunk));
    assert_eq!(
        (first.words.as_str(), called(&first.document)),
        ("add a whole vessel", vec!["Vessel 1".into()])
    );
    assert_eq!(first.document.vessels[0].doubt, None);
    let held = first.document.vessels[0].line;
    // From now on the page can show in advance what a click adds.
    let shown = study.whole_vessel(branch, &first.document.vessels).expect("a volume").expect("a vessel");
    let second = edited(&mut study, &first.document, &whole(branch));
    let added = points(&study, second.document.vessels[1].line);
    assert_eq!(shown.points, added.iter().map(|point| point.to_array()).collect::<Vec<_>>());
    // Both vessels name the point at which they join.
    let told = second.told.expect("words");
    assert_eq!(told.words, format!("Vessel 2, {}.", shown.words));
    let joined = points(&study, held).iter().position(|point| *point == added[0]).expect("a shared point");
    let at = arc_lengths(&points(&study, held))[joined];
    assert!(shown.words.ends_with(&format!(" mm, joins Vessel 1 at {at:.0} mm")), "{}", shown.words);
    assert_eq!(told.doubts, Vec::new());
    assert!(first.told.expect("words").words.ends_with(" mm."));
    let trunk_points = points(&study, held);
    assert!(trunk_points.contains(&added[0]), "it begins at a point of the other one");
    let end = *lines[1].last().expect("points");
    let near = trunk_points.iter().chain(&added).map(|point| point.distance(end)).fold(f64::MAX, f64::min);
    assert!(near < 2.0, "{near}");
}

#[test]
fn a_click_that_gives_no_whole_vessel_is_refused_and_says_why() {
    let (mut study, lines) = bare("y_junction");
    let click = lines[0][lines[0].len() / 2].to_array();
    let whole = |click: [f64; 3]| json!({"kind": "add_whole_vessel", "click": click});
    let document = after(&mut study, &Document::default(), &whole(click));
    let again = tried(&mut study, &document, &whole(click), false).expect_err("it is there");
    assert_eq!((again.kind, again.found.as_str()), ("tracing", "a vessel that is already traced"));
    assert_eq!(again.more.seen.as_ref().expect("a place").place, click);
    assert_eq!(study.whole_vessel(click, &document.vessels).expect("a volume"), None);
    let corner = study.content.held.as_ref().expect("a volume").volume().expect("one").corners()[0];
    let outside = (corner - DVec3::ONE * 40.0).to_array();
    assert_eq!(study.whole_vessel(outside, &[]).expect("a volume"), None);
    assert!(tried(&mut study, &document, &whole(outside), false).is_err());
    study.voxels_changed();
    assert_eq!(study.whole_vessel(click, &[]).expect("a volume"), None, "another scan");
}
