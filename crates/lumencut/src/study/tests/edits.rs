//! Tests of edits of vessels and their results.

use glam::DVec3;
use lumencut_core::progress::Progress;
use serde_json::{Value as Json, json};

use super::masks::{grid, header, values};
use super::opened;
use super::tracing::{clicks, holding, points};
use crate::study::document::{Document, DocumentVessel};
use crate::study::edits::{EditMessage, Edited};
use crate::study::failure::Result;
use crate::study::open_study::Study;
use crate::study::tracing::Watch;

pub(super) fn tried(study: &mut Study, document: &Document, edit: &Json, bridging: bool) -> Result<Edited> {
    let message = json!({"document": document, "edit": edit, "bridging": bridging});
    let message: EditMessage = serde_json::from_value(message).expect("a message");
    study.edit(&message, Watch { stop: &|| false, progress: &Progress::default() })
}

pub(super) fn edited(study: &mut Study, document: &Document, edit: &Json) -> Edited {
    tried(study, document, edit, false).expect("an edit")
}

pub(super) fn after(study: &mut Study, document: &Document, edit: &Json) -> Document {
    edited(study, document, edit).document
}

pub(super) fn bare(phantom: &str) -> (Study, Vec<Vec<DVec3>>) {
    let mut study = opened(phantom);
    let lines = study.begin_document().vessels.iter().map(|vessel| points(&study, vessel.line)).collect();
    study.content.named = None;
    study.begin_document();
    (study, lines)
}

pub(super) fn called(document: &Document) -> Vec<String> {
    document.vessels.iter().map(DocumentVessel::called).collect()
}

fn ids(document: &Document) -> Vec<u32> {
    document.vessels.iter().map(|vessel| vessel.id).collect()
}

pub(super) fn three(study: &mut Study, names: [&str; 3]) -> Document {
    let lines: Vec<usize> = study.begin_document().vessels.iter().map(|vessel| vessel.line).collect();
    let named: Vec<Json> =
        lines.iter().zip(names).map(|(line, name)| json!({"line": line, "name": name})).collect();
    study.last_id = 0;
    after(study, &Document::default(), &json!({"kind": "add_lines", "lines": named}))
}

#[test]
fn a_study_counts_its_vessels_from_1_and_one_without_a_name_is_called_so() {
    let mut study = opened("y_junction");
    let document = study.begin_document();
    assert_eq!(ids(&document), [1, 2, 3]);
    let names = &study.content.named.as_ref().expect("vessels").names;
    assert_eq!(&called(&document), names);
    assert!(document.vessels.iter().all(|vessel| vessel.clicks.is_none() && vessel.doubt.is_none()));
    let unnamed = three(&mut study, ["", "aorta", ""]);
    assert_eq!(called(&unnamed), ["vessel 1", "aorta", "vessel 3"]);
    assert_eq!(opened("y_junction").begin_document(), study.begin_document());
    assert_eq!(Study::default().begin_document(), Document::default());
}

#[test]
fn an_id_is_never_given_twice() {
    let mut study = opened("y_junction");
    let document = three(&mut study, ["a", "b", "c"]);
    let line = json!({"kind": "add_lines", "lines": [{"line": 0, "name": "d"}]});
    let more = edited(&mut study, &document, &line.clone());
    assert_eq!((more.words.as_str(), &more.added), ("open centerlines", &vec![4]));
    // Ids are not used again after the last vessel was removed or its step was undone.
    let fewer = after(&mut study, &more.document, &json!({"kind": "remove", "ids": [4]}));
    assert_eq!(fewer, document);
    assert_eq!(edited(&mut study, &document, &line.clone()).added, [5]);
    // Ids of a document that was read from a file are not used again either.
    let mut read = document;
    read.vessels[1].id = 70;
    assert_eq!(edited(&mut study, &read, &line).added, [71]);
}

#[test]
fn two_clicks_begin_a_vessel_with_a_line_a_name_and_a_color() {
    let (mut study, lines) = bare("stenosis");
    let [from, to] = [5, lines[0].len() - 5].map(|n| lines[0][n].to_array());
    let begun =
        edited(&mut study, &Document::default(), &json!({"kind": "begin_vessel", "clicks": [from, to]}));
    assert_eq!((begun.words.as_str(), &begun.added), ("begin a vessel", &vec![1]));
    assert!(begun.without_marks.is_empty() && begun.notes.is_empty());
    let vessel = &begun.document.vessels[0];
    assert_eq!((vessel.name.as_str(), vessel.color.as_str()), ("Vessel 1", "#56b4e9"));
    assert_eq!(vessel.clicks, Some(vec![from, to]));
    let traced = points(&study, vessel.line);
    assert!(traced[0].distance(DVec3::from_array(from)) < 2.0 && traced.len() > 20);
}

#[test]
fn clicks_are_added_inserted_moved_and_removed_and_the_line_follows() {
    let (mut study, lines) = bare("stenosis");
    let at = |share: f64| lines[0][(share * (lines[0].len() - 1) as f64) as usize].to_array();
    let length = |study: &Study, document: &Document| {
        let line = points(study, document.vessels[0].line);
        line.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>()
    };
    let has = |document: &Document, shares: &[f64]| {
        assert_eq!(document.vessels[0].clicks, Some(shares.iter().map(|share| at(*share)).collect()));
    };
    let begin = json!({"kind": "begin_vessel", "clicks": [at(0.2), at(0.5)]});
    let begun = after(&mut study, &Document::default(), &begin);
    let added = edited(&mut study, &begun, &json!({"kind": "add_click", "id": 1, "point": at(0.9)}));
    assert_eq!(added.words, "add a point");
    has(&added.document, &[0.2, 0.5, 0.9]);
    assert!(length(&study, &added.document) > 2.0 * length(&study, &begun));
    let held = json!({"kind": "add_click_on_line", "id": 1, "point": at(0.35)});
    let held = edited(&mut study, &added.document, &held);
    assert_eq!(held.words, "add a point");
    has(&held.document, &[0.2, 0.35, 0.5, 0.9]);
    let moved = json!({"kind": "move_click", "id": 1, "number": 3, "point": at(0.8)});
    let moved = edited(&mut study, &held.document, &moved);
    assert_eq!(moved.words, "move a point");
    has(&moved.document, &[0.2, 0.35, 0.5, 0.8]);
    assert!(length(&study, &moved.document) < length(&study, &held.document) - 3.0);
    let removed = edited(&mut study, &moved.document, &json!({"kind": "remove_click", "id": 1, "number": 0}));
    assert_eq!(removed.words, "remove a point");
    has(&removed.document, &[0.35, 0.5, 0.8]);
    assert!(removed.without_marks.is_empty(), "a vessel that is traced again keeps its marks");
    // The same clicks give the same line, independently of the edits in between.
    let again = after(&mut study, &begun, &json!({"kind": "add_click", "id": 1, "point": at(0.9)}));
    let [again, added] = [&again, &added.document].map(|document| points(&study, document.vessels[0].line));
    assert_eq!(again, added);
}

#[test]
fn a_vessel_with_one_click_left_goes() {
    let mut study = opened("y_junction");
    let mut document = three(&mut study, ["a", "b", "c"]);
    document.vessels[1].clicks = Some(clicks(&study, 1, 3));
    let removed = edited(&mut study, &document, &json!({"kind": "remove_click", "id": 2, "number": 1}));
    assert_eq!((called(&removed.document), removed.without_marks), (vec!["a".into(), "c".into()], vec![2]));
    assert_eq!(removed.words, "remove a point");
}

#[test]
fn vessels_that_were_clicked_are_traced_beside_the_others_that_are_not_doubtful() {
    let mut study = opened("y_junction");
    let mut document = three(&mut study, ["a", "b", "c"]);
    let begin = json!({"kind": "begin_vessel", "clicks": clicks(&study, 0, 3)});
    let failure = tried(&mut study, &document, &begin.clone(), false).expect_err("the same vessel");
    assert!(failure.found.contains("within earlier vessels"), "{failure:?}");
    assert_eq!(failure.subject, "points of Vessel 1");
    document.vessels[0].is_hidden = true;
    assert!(tried(&mut study, &document, &begin.clone(), false).is_err(), "a hidden vessel is met too");
    document.vessels[0].doubt = Some("touches bone".into());
    let begun = after(&mut study, &document, &begin);
    // Both vessels are traced together, but the second does not change the first.
    let second = json!({"kind": "begin_vessel", "clicks": clicks(&study, 1, 3)});
    document.vessels[1].doubt = Some("touches bone".into());
    let mut begun = Document { vessels: [&document.vessels[..], &begun.vessels[3..]].concat(), ..begun };
    let first = begun.vessels[3].line;
    begun = after(&mut study, &begun, &second);
    assert_eq!((begun.vessels[3].line, called(&begun)[4].as_str()), (first, "Vessel 2"));
}

fn crossing() -> (Study, [[f64; 3]; 2], [f64; 3]) {
    let mut study = holding(lumencut_phantom::crossing().expect("a phantom"));
    let [first, second] = [0, 1].map(|vessel| points(&study, vessel));
    study.content.named = None;
    let on_first = [first[first.len() / 8], first[first.len() / 4]].map(|point| point.to_array());
    (study, on_first, second[second.len() / 4].to_array())
}

#[test]
fn a_click_behind_a_gap_is_refused_and_taken_where_the_gap_is_bridged() {
    let (mut study, [from, to], other) = crossing();
    let begun =
        after(&mut study, &Document::default(), &json!({"kind": "begin_vessel", "clicks": [from, to]}));
    let add = json!({"kind": "add_click", "id": 1, "point": other});
    let failure = tried(&mut study, &begun, &add.clone(), false).expect_err("no lumen between");
    let mends: Vec<&str> = failure.more.mends.iter().map(crate::mends::Mend::name).collect();
    assert!(mends.contains(&"bridge"), "{failure:?}");
    let bridged = tried(&mut study, &begun, &add, true).expect("a bridge");
    assert_eq!(bridged.words, "add a point and bridge gaps");
    assert!(bridged.document.bridge);
    assert_eq!(bridged.document.vessels[0].clicks, Some(vec![from, to, other]));
    let words = |study: &mut Study, bridge: bool| {
        edited(study, &begun, &json!({"kind": "set_bridge", "bridge": bridge})).words
    };
    assert_eq!([true, false].map(|bridge| words(&mut study, bridge)), ["bridge gaps", "leave gaps"]);
}

#[test]
fn a_refused_click_is_told_by_the_name_of_its_vessel_or_as_the_new_point() {
    let (mut study, lines) = bare("stenosis");
    let corner = study.content.held.as_ref().expect("a volume").volume().expect("one").corners()[0];
    let ends = [5, lines[0].len() - 5].map(|n| lines[0][n]);
    let fat = corner.lerp(ends[0], 0.05).to_array();
    let clicks = ends.map(|point| point.to_array());
    let subject = |study: &mut Study, document: &Document, edit: &Json| {
        tried(study, document, edit, false).expect_err("no lumen").subject
    };
    let none = Document::default();
    let begin = json!({"kind": "begin_vessel", "clicks": [clicks[0], fat]});
    assert_eq!(subject(&mut study, &none, &begin), "this point");
    let mut document = after(&mut study, &none, &json!({"kind": "begin_vessel", "clicks": clicks}));
    for edit in [
        json!({"kind": "add_click", "id": 1, "point": fat}),
        json!({"kind": "add_click_on_line", "id": 1, "point": fat}),
        json!({"kind": "move_click", "id": 1, "number": 0, "point": fat}),
    ] {
        assert_eq!(subject(&mut study, &document, &edit), "this point");
    }
    // If the error concerns another click, the failure names that click.
    let outside = corner + 2.0 * (corner - ends[0]);
    document.vessels[0].clicks = Some(vec![clicks[0], outside.to_array()]);
    document.vessels[0].name = "SMA".into();
    let stopper = json!({"kind": "add_stopper", "center": corner.to_array()});
    assert_eq!(subject(&mut study, &document, &stopper), "point 2 of SMA");
}

#[test]
fn stoppers_are_set_moved_and_removed_and_the_vessels_traced_around_them() {
    let (mut study, lines) = bare("stenosis");
    let [from, to] = [5, lines[0].len() - 5].map(|n| lines[0][n].to_array());
    let begun =
        after(&mut study, &Document::default(), &json!({"kind": "begin_vessel", "clicks": [from, to]}));
    let far = [0.0, 12.0, 0.0];
    let added = edited(&mut study, &begun, &json!({"kind": "add_stopper", "center": far}));
    assert_eq!(added.words, "add a stopper");
    let stopper = added.document.stoppers[0];
    assert_eq!((stopper.center, stopper.radius), (far, 3.0));
    let moved = json!({"kind": "move_stopper", "number": 0, "center": [0.0, 13.0, 0.0]});
    let moved = edited(&mut study, &added.document, &moved);
    assert_eq!(moved.words, "move a stopper");
    let stopper = moved.document.stoppers[0];
    assert_eq!((stopper.center, stopper.radius), ([0.0, 13.0, 0.0], 3.0));
    // A stopper at the narrowest place leaves no path.
    let closing = json!({"kind": "move_stopper", "number": 0, "center": [0.0, 0.0, 0.0]});
    let failure = tried(&mut study, &moved.document, &closing, false).expect_err("no way");
    assert_eq!(failure.kind, "tracing");
    let removed = edited(&mut study, &moved.document, &json!({"kind": "remove_stopper", "number": 0}));
    assert_eq!((removed.words.as_str(), removed.document.stoppers.len()), ("remove a stopper", 0));
    assert_eq!(points(&study, removed.document.vessels[0].line), points(&study, begun.vessels[0].line));
}

#[test]
fn both_parts_of_a_vessel_that_is_cut_take_its_place_without_marks() {
    let mut study = opened("y_junction");
    let mut document = three(&mut study, ["a", "", "c"]);
    document.vessels[1].color = "#123456".into();
    let cut = edited(&mut study, &document, &json!({"kind": "cut", "id": 2, "at": 5.0}));
    assert_eq!((cut.words.as_str(), &cut.added, &cut.without_marks), ("cut a vessel", &vec![4], &vec![2]));
    assert_eq!(called(&cut.document), ["a", "vessel 2", "vessel 2 part 1", "c"]);
    assert_eq!(ids(&cut.document), [1, 2, 4, 3]);
    let [first, second] = [1, 2].map(|n| &cut.document.vessels[n]);
    assert_eq!((first.color.as_str(), second.color.as_str()), ("#123456", "#cc79a7"));
    let [first, second] = [first, second].map(|vessel| points(&study, vessel.line));
    assert_eq!(first.last(), second.first());
    let again = after(&mut study, &cut.document, &json!({"kind": "cut", "id": 2, "at": 2.0}));
    assert_eq!(called(&again)[1..4], ["vessel 2", "vessel 2 part 2", "vessel 2 part 1"]);
    let odd = tried(&mut study, &document, &json!({"kind": "cut", "id": 1, "at": 999.0}), false);
    assert_eq!(odd.expect_err("no place of it").kind, "vessel tree");
}

#[test]
fn what_was_cut_is_joined_to_one_with_the_name_of_the_first() {
    let mut study = opened("stenosis");
    let mut document = study.begin_document();
    document.vessels[0].clicks = Some(clicks(&study, 0, 3));
    let whole = points(&study, document.vessels[0].line);
    let cut = after(&mut study, &document, &json!({"kind": "cut", "id": 1, "at": 20.0}));
    assert!(cut.vessels.iter().all(|vessel| vessel.clicks.is_none()));
    let joined = edited(&mut study, &cut, &json!({"kind": "join", "id": 2, "other": 1}));
    assert_eq!((joined.words.as_str(), &joined.without_marks), ("join two vessels", &vec![2, 1]));
    assert_eq!(joined.document.vessels.len(), 1);
    let (vessel, second) = (&joined.document.vessels[0], &cut.vessels[1]);
    assert_eq!((vessel.id, &vessel.name, &vessel.color), (2, &second.name, &second.color));
    assert_eq!(points(&study, vessel.line), whole);
    for other in [1, 9] {
        assert_eq!(after(&mut study, &cut, &json!({"kind": "join", "id": 1, "other": other})), cut);
    }
}

#[test]
fn branches_from_a_seed_come_at_once_and_doubtful_ones_are_accepted_or_left_out() {
    let mut study = opened("y_junction");
    let seed = clicks(&study, 0, 10)[0];
    let found = edited(&mut study, &Document::default(), &json!({"kind": "add_branches", "seed": seed}));
    assert_eq!(found.words, "add all branches from here");
    let names: Vec<String> = (1..=found.added.len()).map(|n| format!("Branch {n}")).collect();
    assert!(names.len() >= 2 && called(&found.document) == names);
    let mut document = three(&mut study, ["a", "b", "c"]);
    for vessel in &mut document.vessels[1..] {
        vessel.doubt = Some("touches bone".into());
    }
    let accepted = edited(&mut study, &document, &json!({"kind": "accept", "ids": [2]}));
    assert_eq!((accepted.words.as_str(), &accepted.document.vessels[1].doubt), ("accept a branch", &None));
    // A branch that was accepted meanwhile is not removed.
    let left = edited(&mut study, &accepted.document, &json!({"kind": "leave_out", "ids": [2, 3]}));
    assert_eq!(
        (left.words.as_str(), called(&left.document)),
        ("leave branches out", vec!["a".into(), "b".into()])
    );
    assert_eq!(left.without_marks, [3]);
    let both = edited(&mut study, &document, &json!({"kind": "accept", "ids": [2, 3]}));
    assert!(both.words == "accept branches" && both.document.vessels.iter().all(|one| one.doubt.is_none()));
}

#[test]
fn a_mask_adds_its_vessels_and_says_what_was_odd() {
    let mut study = opened("y_junction");
    let bytes: Vec<u8> = values(&study).iter().map(|value| u8::from(*value > 205)).collect();
    study.begin_mask(&header(grid(&study), "uint8")).expect("room");
    study.mask_bytes(0, bytes.len()).expect("room").copy_from_slice(&bytes);
    let document = three(&mut study, ["a", "Mask 1", "c"]);
    let added = edited(&mut study, &document, &json!({"kind": "add_mask"}));
    assert_eq!(called(&added.document)[3..], ["Mask 2", "Mask 3", "Mask 4"]);
    assert_eq!(added.words, "add the vessels of a mask");
    assert_eq!(
        tried(&mut study, &document, &json!({"kind": "add_mask"}), false).expect_err("none").kind,
        "volume"
    );
}

#[test]
fn a_vessel_that_nobody_clicked_takes_points_and_runs_where_it_ran() {
    let mut study = opened("stenosis");
    let document = study.begin_document();
    let line = points(&study, document.vessels[0].line);
    let held = line[line.len() / 2].to_array();
    let edit = json!({"kind": "add_click_on_line", "id": 1, "point": held});
    let taken = edited(&mut study, &document, &edit.clone());
    let vessel = &taken.document.vessels[0];
    let clicks = vessel.clicks.as_ref().expect("clicks");
    assert!(
        clicks.contains(&held) && clicks.contains(&line[0].to_array()) && clicks.len() == 5,
        "{clicks:?}"
    );
    let away = |point: &DVec3| line.iter().map(|own| own.distance(*point)).fold(f64::MAX, f64::min);
    assert!(points(&study, vessel.line).iter().all(|point| away(point) < 0.7));
    // A doubtful branch must be accepted first.
    let mut doubtful = document;
    doubtful.vessels[0].doubt = Some("touches bone".into());
    assert_eq!(after(&mut study, &doubtful, &edit), doubtful);
}

#[test]
fn what_is_not_there_is_not_changed() {
    let mut study = opened("y_junction");
    let document = three(&mut study, ["a", "b", "c"]);
    let point = [0.0, 0.0, 0.0];
    for edit in [
        json!({"kind": "add_click", "id": 9, "point": point}),
        json!({"kind": "add_click", "id": 1, "point": point}),
        json!({"kind": "add_click_on_line", "id": 9, "point": point}),
        json!({"kind": "move_click", "id": 1, "number": 0, "point": point}),
        json!({"kind": "remove_click", "id": 1, "number": 0}),
        json!({"kind": "move_stopper", "number": 0, "center": point}),
        json!({"kind": "remove_stopper", "number": 0}),
        json!({"kind": "set_bridge", "bridge": false}),
        json!({"kind": "cut", "id": 9, "at": 1.0}),
        json!({"kind": "remove", "ids": [9]}),
        json!({"kind": "accept", "ids": [1]}),
        json!({"kind": "leave_out", "ids": [1]}),
        json!({"kind": "add_lines", "lines": []}),
    ] {
        let nothing = edited(&mut study, &document, &edit.clone());
        assert_eq!(nothing.document, document, "{edit}");
        assert!(nothing.without_marks.is_empty() && nothing.added.is_empty());
    }
    let removed = edited(&mut study, &document, &json!({"kind": "remove", "ids": [1, 3]}));
    assert_eq!((removed.words.as_str(), removed.without_marks), ("delete vessels", vec![1, 3]));
    let one = edited(&mut study, &document, &json!({"kind": "remove", "ids": [1]}));
    assert_eq!(one.words, "delete a vessel");
}
