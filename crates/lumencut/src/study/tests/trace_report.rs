//! Tests the reports on vessels that were traced in scenes with a known answer.

use glam::{DAffine3, DVec3};
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_phantom::Phantom;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lumen::wander::wandering;
use serde_json::json;

use super::edits::edited;
use super::tracing::{holding, points};
use crate::study::document::Document;
use crate::study::open_study::Study;
use crate::study::trace_report::Told;

/// A tube along z in fat: 96 mm long, 9 mm radius, 1 mm voxels. Its values are a function of z with noise of ±20.
fn tube(lumen: impl Fn(f64) -> f64) -> Study {
    tube_of(96, lumen)
}

fn tube_of(length: usize, lumen: impl Fn(f64) -> f64) -> Study {
    let size = [40, 40, length];
    let mut seed = 3u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        40.0 * (f64::from(seed >> 16) / 65536.0 - 0.5)
    };
    let value = |n: usize| {
        let across = [n % size[0], n / size[0] % size[1]].map(|c| c as f64 - 19.5);
        let is_lumen = across[0].hypot(across[1]) < 9.0;
        let z = (n / (size[0] * size[1])) as f64;
        ((if is_lumen { lumen(z) } else { -100.0 }) + noise()).round() as i16
    };
    let points = vec![DVec3::ZERO, DVec3::Z * 95.0];
    let tree = VesselTree::new(vec![Vessel::new(points, None).expect("a line")]).expect("a tree");
    let voxels = (0..size.iter().product()).map(value).collect();
    let world_from_index = DAffine3::from_translation(DVec3::new(-19.5, -19.5, 0.0));
    let mut study = holding(Phantom {
        voxels,
        size,
        world_from_index,
        tree,
        vessel_names: vec!["tube".to_owned()],
        ..lumencut_phantom::y_junction().expect("a phantom")
    });
    study.content.named = None;
    study
}

#[test]
fn one_click_takes_a_vessel_that_is_hardly_longer_than_wide_in_the_scan_and_says_that_it_was_not_found() {
    // A 24 mm slab of a vessel that is 18 mm wide.
    let mut study = tube_of(24, |_| 400.0);
    let whole = json!({"kind": "add_whole_vessel", "click": [2.0, -3.0, 12.0]});
    let begun = edited(&mut study, &Document::default(), &whole);
    let line = points(&study, begun.document.vessels[0].line);
    let off = line.iter().map(|point| point.truncate().length()).fold(0.0, f64::max);
    assert!(off < 0.6, "{off}");
    assert!(line[0].distance(line[line.len() - 1]) > 16.0, "{line:?}");
    let told = begun.told.expect("words");
    let words = "Vessel 1 was traced from the click alone, because no vessel was found there: check it.";
    assert_eq!(told.doubts.iter().map(|doubt| doubt.words.as_str()).collect::<Vec<_>>(), [words]);
}

fn told(study: &mut Study, clicks: [[f64; 3]; 2]) -> Told {
    let begin = json!({"kind": "begin_vessel", "clicks": clicks});
    edited(study, &Document::default(), &begin).told.expect("words")
}

const ENDS: [[f64; 3]; 2] = [[0.5, 0.2, 6.0], [-0.3, 0.4, 90.0]];

#[test]
fn a_lumen_that_changes_its_brightness_at_a_place_is_told_with_the_place() {
    let mut study = tube(|z| if z < 48.0 { 450.0 } else { 300.0 });
    let begun = edited(&mut study, &Document::default(), &json!({"kind": "begin_vessel", "clicks": ENDS}));
    let told = begun.told.expect("words");
    assert!(told.words.starts_with("Vessel 1, 8") && told.words.ends_with(" mm."), "{}", told.words);
    let [doubt] = &told.doubts[..] else { panic!("{:?}", told.doubts) };
    let at = doubt.at.expect("a place");
    let vessel = &begun.document.vessels[0];
    let (line, lengths) = (points(&study, vessel.line), arc_lengths(&points(&study, vessel.line)));
    let place = line[lengths.partition_point(|length| *length < at)];
    assert!((place.z - 48.0).abs() < 3.0, "{at} {place}");
    let words = format!("Doubtful from {at:.0} mm on: the brightness of the lumen changes there from 45");
    assert!(doubt.words.starts_with(&words), "{}", doubt.words);
}

#[test]
fn contrast_medium_that_fades_along_a_vessel_is_no_doubt_and_neither_is_noise() {
    for lumen in [|z: f64| 450.0 - 1.6 * z, |_| 400.0, |z: f64| if z < 48.0 { 430.0 } else { 360.0 }] {
        assert_eq!(told(&mut tube(lumen), ENDS).doubts, Vec::new());
    }
}

#[test]
fn a_way_across_the_lumen_is_told_and_one_along_it_is_none() {
    let mut study = tube(|_| 400.0);
    let across = told(&mut study, [[-6.0, 0.3, 48.0], [6.0, 0.1, 48.5]]);
    let [doubt] = &across.doubts[..] else { panic!("{:?}", across.doubts) };
    assert_eq!(doubt.words, "The path runs across the lumen, not along it: click in another slice.");
    assert_eq!(doubt.at, None);
    assert_eq!(told(&mut study, [[-6.0, 0.3, 36.0], [6.0, 0.1, 58.0]]).doubts, Vec::new());
}

#[test]
fn a_line_wanders_where_it_turns_more_tightly_than_its_vessel_is_wide() {
    let circle = |radius: f64| {
        let points: Vec<DVec3> = (0..=60)
            .map(|n| f64::from(n) * 0.1)
            .map(|angle| radius * DVec3::new(angle.cos(), angle.sin(), 0.0))
            .collect();
        let count = points.len();
        let line = Centerline { points, radius: vec![9.0; count], confidence: vec![1.0; count] };
        wandering(&line).into_iter().filter(|wanders| *wanders).count()
    };
    // No tube bends more sharply than this, but a fold within the lumen does.
    assert_eq!(circle(9.0), 0);
    assert!(circle(4.0) > 10, "{}", circle(4.0));
}

#[test]
fn a_found_vessel_has_the_doubts_of_a_traced_one() {
    let mut study = tube(|z| if z < 48.0 { 400.0 } else { 280.0 });
    let find = json!({"kind": "find_vessels", "doubtful": false});
    let found = edited(&mut study, &Document::default(), &find);
    assert_eq!(found.document.vessels.len(), 1);
    let line = points(&study, found.document.vessels[0].line);
    let told = study.trace_report(&found.document, Some(found.document.vessels[0].id)).expect("a report");
    let [change] = told.expect("a vessel").doubts.try_into().expect("one doubt");
    assert_eq!(found.notes.len(), 1, "{:?}", found.notes);
    let [doubt] = &found.doubts[..] else { panic!("{:?}", found.doubts) };
    assert_eq!((doubt.line, &doubt.kind[..]), (found.document.vessels[0].line, "changes its brightness"));
    assert_eq!(doubt.place, change);
    let at =
        arc_lengths(&line).iter().position(|length| *length >= change.at.expect("a place")).expect("a point");
    assert!((line[at].z - 48.0).abs() < 3.0, "{}", line[at].z);
}
