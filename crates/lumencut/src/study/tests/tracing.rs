//! Tests what the page expects of tracing; these tests run without a browser.

use glam::{DAffine3, DMat4, DVec3};
use lumencut_core::progress::Progress;
use lumencut_phantom::Phantom;
use serde_json::{Value as Json, json};

use super::opened;
use crate::study::document::Document;
use crate::study::edits::EditMessage;
use crate::study::open_study::Study;
use crate::study::tracing::{PathMessage, TraceRequest, Watch};

fn header(size: [usize; 3], world_from_index: DAffine3) -> String {
    let rows = DMat4::from(world_from_index).transpose().to_cols_array_2d();
    json!({"size": size, "dtype": "int16", "world_from_index": rows}).to_string()
}

pub(super) fn holding(phantom: Phantom) -> Study {
    let mut study = Study::default();
    study.begin_volume(&header(phantom.size, phantom.world_from_index)).expect("room");
    let bytes: Vec<u8> = phantom.voxels.iter().flat_map(|voxel| voxel.to_le_bytes()).collect();
    study.voxel_bytes(0, bytes.len()).expect("room").copy_from_slice(&bytes);
    study.show_tree(phantom.tree, phantom.vessel_names).expect("a tree");
    study
}

fn traced(
    study: &mut Study,
    request: &TraceRequest,
    stop: bool,
) -> crate::study::failure::Result<Vec<usize>> {
    study.trace(request, Watch { stop: &|| stop, progress: &Progress::default() })
}

fn request(vessels: &[Vec<[f64; 3]>], beside: &[usize]) -> TraceRequest {
    TraceRequest { vessels: vessels.to_vec(), beside: beside.to_vec(), ..TraceRequest::default() }
}

pub(super) fn clicks(study: &Study, vessel: usize, from_ends: usize) -> Vec<[f64; 3]> {
    let points = study.content.tree().expect("a tree").tree().vessels()[vessel].points().to_vec();
    vec![points[from_ends].to_array(), points[points.len() - 1 - from_ends].to_array()]
}

fn path(study: &mut Study, message: Json, stop: bool) -> Option<Vec<[f64; 3]>> {
    let message: PathMessage = serde_json::from_value(message).expect("a message");
    study.path(&message, &|| stop).expect("an open volume")
}

pub(super) fn points(study: &Study, line: usize) -> Vec<DVec3> {
    study.lines.get(line).expect("a line").points.clone()
}

#[test]
fn a_line_that_is_what_it_was_keeps_its_number() {
    let mut study = opened("y_junction");
    let (first, second) = (clicks(&study, 0, 3), clicks(&study, 1, 3));
    let lines = traced(&mut study, &request(&[first.clone(), second.clone()], &[]), false).expect("lines");
    let again = traced(&mut study, &request(&[first.clone(), second], &[]), false).expect("lines");
    assert_eq!(lines, again);
    let alone = traced(&mut study, &request(&[first], &[]), false).expect("a line");
    assert_eq!(alone, lines[..1]);
    assert!(traced(&mut study, &request(&[], &[]), false).expect("none").is_empty());
}

#[test]
fn a_vessel_ends_at_a_point_of_a_line_beside_it_which_stays() {
    let mut study = opened("y_junction");
    let trunk = points(&study, 0);
    // The path leads from within the trunk into the branch.
    let branch = points(&study, 1);
    let click = |point: DVec3| (point + DVec3::new(0.2, 0.0, 0.1)).to_array();
    let vessel = vec![click(trunk[trunk.len() - 2]), branch[branch.len() - 4].to_array()];
    let lines = traced(&mut study, &request(std::slice::from_ref(&vessel), &[0]), false).expect("a line");
    assert!(trunk.contains(&points(&study, lines[0])[0]));
    assert_eq!(points(&study, 0), trunk);
    let loose = traced(&mut study, &request(&[vessel], &[]), false).expect("a line");
    assert!(!trunk.contains(&points(&study, loose[0])[0]));
}

#[test]
fn a_vessel_within_a_line_beside_it_is_refused() {
    let mut study = opened("stenosis");
    let vessel = clicks(&study, 0, 6);
    let failure = traced(&mut study, &request(&[vessel], &[0]), false).expect_err("the same vessel");
    assert_eq!(failure.kind, "tracing");
    assert!(failure.found.contains("within earlier vessels"));
}

#[test]
fn tracing_stops_and_can_begin_again() {
    let mut study = opened("y_junction");
    let vessel = clicks(&study, 0, 3);
    let failure = traced(&mut study, &request(std::slice::from_ref(&vessel), &[]), true).expect_err("a stop");
    assert_eq!(failure.kind, "interrupted");
    assert_eq!(traced(&mut study, &request(&[vessel], &[]), false).expect("a line").len(), 1);
}

#[test]
fn a_click_in_no_lumen_is_refused_with_its_place_and_value() {
    let mut study = opened("y_junction");
    let mut vessel = clicks(&study, 0, 3);
    let corner = study.content.held.as_ref().expect("a volume").volume().expect("one").corners()[0];
    vessel[1] = corner.lerp(DVec3::from_array(vessel[1]), 0.05).to_array();
    let failure =
        traced(&mut study, &request(std::slice::from_ref(&vessel), &[]), false).expect_err("no lumen");
    let seen = failure.more.seen.as_ref().expect("a place");
    assert_eq!(seen.place, vessel[1]);
    assert!(seen.value < 100.0);
    let text = serde_json::to_value(&failure).expect("JSON");
    assert_eq!((&text["place"], &text["kind"]), (&json!(vessel[1]), &json!("tracing")));
}

#[test]
fn a_click_that_no_vessel_can_begin_at_is_refused_alone() {
    let study = opened("y_junction");
    let [lumen, _] = clicks(&study, 0, 3)[..] else { panic!("two clicks") };
    study.check_click(lumen).expect("lumen");
    let corner = study.content.held.as_ref().expect("a volume").volume().expect("one").corners()[0];
    let fat = corner.lerp(DVec3::from_array(lumen), 0.05);
    let failure = study.check_click(fat.to_array()).expect_err("no lumen");
    assert_eq!(failure.more.seen.map(|seen| seen.place), Some(fat.to_array()));
    let outside = corner + 2.0 * (corner - DVec3::from_array(lumen));
    let failure = study.check_click(outside.to_array()).expect_err("outside");
    assert!(failure.found.contains("outside the volume"), "{failure:?}");
}

#[test]
fn branches_from_a_place_that_is_no_lumen_by_its_value_are_refused_before_anything_is_searched() {
    let mut study = opened("y_junction");
    let corner = study.content.held.as_ref().expect("a volume").volume().expect("one").corners()[0];
    let fat = corner.lerp(DVec3::from_array(clicks(&study, 0, 3)[0]), 0.05).to_array();
    let message = json!({
        "document": Document::default(), "edit": {"kind": "add_branches", "seed": fat}, "bridging": false,
    });
    let message: EditMessage = serde_json::from_value(message).expect("a message");
    // If there were a search, it would notice the stop and end as interrupted.
    let watch = Watch { stop: &|| true, progress: &Progress::default() };
    let failure = study.edit(&message, watch).expect_err("no lumen");
    assert_eq!((failure.kind, failure.more.seen.map(|seen| seen.place)), ("tracing", Some(fat)));
}

#[test]
fn two_vessels_that_do_not_meet_are_refused_at_the_weakest_place() {
    let mut study = holding(lumencut_phantom::crossing().expect("a phantom"));
    let [first, second] = [0, 1].map(|vessel| points(&study, vessel));
    let vessel = vec![first[first.len() / 4].to_array(), second[second.len() / 4].to_array()];
    let failure = traced(&mut study, &request(&[vessel], &[]), false).expect_err("no lumen between");
    let seen = failure.more.seen.expect("a place");
    let place = DVec3::from_array(seen.place);
    let away = |line: &[DVec3]| line.iter().map(|point| point.distance(place)).fold(f64::MAX, f64::min);
    assert!(away(&first) > 1.0 && away(&second) > 1.0 && seen.value < 200.0);
}

#[test]
fn the_way_to_the_pointer_goes_on_where_it_was_stopped() {
    let mut study = opened("stenosis");
    let [from, to] = clicks(&study, 0, 4)[..] else { panic!("two clicks") };
    let sought = |to: [f64; 3]| json!({"from": from, "to": to, "stoppers": [], "bridge": false});
    assert_eq!(path(&mut study, sought(to), true), None);
    let way = path(&mut study, sought(to), false).expect("a way");
    assert_eq!((way[0], way[way.len() - 1]), (from, to));
    let line = points(&study, 0);
    let away = |point: DVec3| line.iter().map(|own| own.distance(point)).fold(f64::MAX, f64::min);
    assert!(way.iter().all(|point| away(DVec3::from_array(*point)) < 4.0));
    // The earlier search has already reached the place, so no time is needed.
    assert_eq!(path(&mut study, sought(to), true), Some(way));
    // There is no path outside the vessel, outside the volume, or from a place without lumen.
    let beside = [from[0] + 6.0, from[1], from[2]];
    assert_eq!(path(&mut study, sought(beside), false), None);
    assert_eq!(path(&mut study, sought([1e4, 0.0, 0.0]), false), None);
    let message = json!({"from": beside, "to": to, "stoppers": [], "bridge": false});
    assert_eq!(path(&mut study, message, false), None);
}

#[test]
fn the_ways_from_both_neighbours_of_a_dragged_point_are_kept() {
    let mut study = opened("stenosis");
    let [first, last] = clicks(&study, 0, 4)[..] else { panic!("two clicks") };
    let line = points(&study, 0);
    let dragged = line[line.len() / 3].to_array();
    let sought = |from: [f64; 3]| json!({"from": from, "to": dragged, "stoppers": [], "bridge": false});
    let ways = [first, last].map(|from| path(&mut study, sought(from), false).expect("a way"));
    assert_eq!([first, last].map(|from| path(&mut study, sought(from), true).expect("a way")), ways);
}

#[test]
fn the_way_to_the_pointer_passes_no_stopper() {
    let mut study = opened("stenosis");
    let [from, to] = clicks(&study, 0, 4)[..] else { panic!("two clicks") };
    let sought = |radius: f64| json!({"from": from, "to": to, "bridge": false, "stoppers": [{"center": [0.0, 0.0, 0.0], "radius": radius}]});
    assert_eq!(path(&mut study, sought(8.0), false), None);
    let around = path(&mut study, sought(0.5), false).expect("a way around");
    assert!(around.iter().all(|point| DVec3::from_array(*point).length() > 0.4));
}

#[test]
fn a_seed_finds_all_branches() {
    let mut study = opened("y_junction");
    let seed = clicks(&study, 0, 10)[0];
    let watch = Watch { stop: &|| false, progress: &Progress::default() };
    let branches = study.trace_from(seed, watch).expect("branches");
    assert!(branches.len() >= 2 && branches.iter().all(|branch| branch.doubt.is_none()));
    let found: Vec<DVec3> = branches.iter().flat_map(|branch| points(&study, branch.line)).collect();
    for vessel in 0..3 {
        let middle = points(&study, vessel);
        let middle = middle[middle.len() / 2];
        assert!(found.iter().any(|point| point.distance(middle) < 0.6));
    }
    let stopped = Watch { stop: &|| true, ..watch };
    assert_eq!(study.trace_from(seed, stopped).expect_err("a stop").kind, "interrupted");
}
