//! Tests that the answer to an edit equals the answers to separate questions.

use lumencut_core::progress::Progress;
use serde_json::{Value as Json, json};

use super::edits::bare;
use crate::study::after_edit::AfterEdit;
use crate::study::document::Document;
use crate::study::open_study::Study;
use crate::study::tracing::Watch;

fn made(study: &mut Study, document: &Document, edit: &Json) -> AfterEdit {
    let message = json!({"document": document, "edit": edit, "bridging": false});
    let message = serde_json::from_value(message).expect("a message");
    study.edit_and_show(&message, Watch { stop: &|| false, progress: &Progress::default() }).expect("an edit")
}

fn as_json(value: impl serde::Serialize) -> Json {
    serde_json::to_value(value).expect("JSON")
}

#[test]
fn an_edit_tells_what_line_facts_report_and_place_tell_and_shows_the_tree() {
    let (mut study, lines) = bare("y_junction");
    let trunk = [lines[0][4], lines[0][lines[0].len() - 5]].map(|point| point.to_array());
    let first = made(&mut study, &Document::default(), &json!({"kind": "begin_vessel", "clicks": trunk}));
    let line = first.edited.document.vessels[0].line;
    assert_eq!(first.lines.iter().map(|one| one.line).collect::<Vec<_>>(), [line]);
    assert_eq!(as_json(&first.lines[0].content), as_json(study.line(line).expect("a line")));
    assert_eq!(first.facts, study.line_facts(&[line]).expect("facts"));
    assert_eq!(as_json(&first.report), as_json(study.report().expect("a report")));
    assert_eq!(first.report.vessels.as_ref().map(Vec::len), Some(1));
    // The last click lies in the vessel that was traced to it.
    let pick = first.pick.expect("a place");
    assert_eq!((pick.point, pick.vessel), (trunk[1], Some(0)));

    // A hidden vessel is reported but not shown, and lines that the viewer knows are not sent again.
    let mut document = first.edited.document;
    document.vessels[0].is_hidden = true;
    let branch = [lines[1][9], lines[1][lines[1].len() - 5]].map(|point| point.to_array());
    let second = made(&mut study, &document, &json!({"kind": "begin_vessel", "clicks": branch}));
    assert_eq!(second.report.vessels.as_ref().map(Vec::len), Some(1));
    assert_eq!(second.facts.len(), 2);
    assert!(second.lines.iter().all(|one| one.line != line));
    let bridged = made(&mut study, &Document::default(), &json!({"kind": "set_bridge", "bridge": true}));
    assert!(bridged.pick.is_none() && bridged.report.vessels.is_none());
}

#[test]
fn a_vessel_without_a_name_is_called_by_its_number_in_the_list() {
    let (mut study, lines) = bare("y_junction");
    let trunk = [lines[0][4], lines[0][lines[0].len() - 5]].map(|point| point.to_array());
    let first = made(&mut study, &Document::default(), &json!({"kind": "begin_vessel", "clicks": trunk}));
    let mut document = first.edited.document;
    (document.vessels[0].id, document.vessels[0].name) = (139, String::new());
    let again = made(&mut study, &document, &json!({"kind": "set_bridge", "bridge": true}));
    assert_eq!(as_json(&again.report)["vessels"][0]["name"], "vessel 139");
}

#[test]
fn a_first_click_tells_its_place_and_the_whole_vessel_or_is_refused() {
    let (mut study, lines) = bare("y_junction");
    let click = lines[0][lines[0].len() / 2].to_array();
    let before = study.first_click(click, &[]).expect("lumen");
    assert_eq!((before.pick, before.whole), (study.at(click), None));
    made(&mut study, &Document::default(), &json!({"kind": "add_whole_vessel", "click": click}));
    let known = study.first_click(click, &[]).expect("lumen");
    assert_eq!(known.whole, study.whole_vessel(click, &[]).expect("a volume"));
    assert!(known.whole.is_some());
    assert!(study.first_click([1e4, 0.0, 0.0], &[]).is_err());
}
