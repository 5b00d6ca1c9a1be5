//! Tests the motion between two scans, and that a vessel is compared as in Python.

use std::sync::LazyLock;

use serde_json::{Value as Json, json};

use crate::study::questions::ask_at_once;
use crate::study::tests::{opened, report_of};

fn asked(name: &str, message: &Json) -> crate::study::failure::Result<Json> {
    let answer = ask_at_once(name, &message.to_string())?;
    Ok(serde_json::from_str(&answer.json).expect("JSON"))
}

fn corners(low: [f64; 3], side: f64) -> Vec<[f64; 3]> {
    (0..8).map(|n| [0, 1, 2].map(|axis| low[axis] + if n >> axis & 1 == 1 { side } else { 0.0 })).collect()
}

fn motion(other: [f64; 3], pairs: &Json) -> crate::study::failure::Result<Json> {
    let both = [corners([0.0; 3], 100.0), corners(other, 100.0)];
    asked("motion_between", &json!({"corners": both, "pairs": pairs}))
}

#[test]
fn without_pairs_scans_in_one_place_keep_it_and_others_move_centre_to_centre() {
    let moved = |other| motion(other, &json!([])).expect("a motion")["shift"].clone();
    assert_eq!(moved([20.0, 0.0, -20.0]), json!([0.0, 0.0, 0.0]));
    assert_eq!(moved([0.0, 0.0, 800.0]), json!([0.0, 0.0, 800.0]));
}

#[test]
fn pairs_determine_the_motion() {
    // A quarter turn about z: x goes to y, y to -x.
    let pairs = json!([[[0, 0, 0], [5, 0, 0]], [[40, 0, 0], [5, 40, 0]], [[0, 40, 0], [-35, 0, 0]]]);
    let found = motion([0.0; 3], &pairs).expect("a motion");
    let entry = |row: usize, column: usize| found["rotation"][row][column].as_f64().expect("a number");
    assert!((entry(1, 0) - 1.0).abs() < 1e-9 && (entry(0, 1) + 1.0).abs() < 1e-9, "{found}");
    assert!((found["shift"][0].as_f64().expect("a number") - 5.0).abs() < 1e-9);
    let line = json!([[[0, 0, 0], [0, 0, 0]], [[9, 0, 0], [9, 0, 0]], [[30, 0, 0], [30, 0, 0]]]);
    assert_eq!(motion([0.0; 3], &line).expect_err("a line").found, "3 points on a line");
}

static RECORD: LazyLock<String> = LazyLock::new(|| {
    let mut study = opened("stenosis");
    let line = report_of(&study)["vessels"][0]["line"].as_u64().expect("a line") as usize;
    study.profile_record(line, &|| false).expect("a record")
});

fn scans(more: &Json) -> Json {
    let mut message = json!({
        "records": [*RECORD, *RECORD], "pairs": [[20.0, 20.0]], "vessel": "ICA", "scans": ["2024", "2026"],
        "identities": [{"patient": "A1"}, {"patient": "A1"}], "other_patient": false, "is_named": true, "pictures": [],
    });
    for (name, value) in more.as_object().expect("names") {
        message[name] = value.clone();
    }
    message
}

#[test]
fn a_vessel_is_compared_with_sentences_places_and_a_chart() {
    let message = json!({"scans": scans(&json!({})), "size": [900.0, 300.0]});
    let found = asked("compare_scans", &message).expect("a comparison");
    let sentences = found["sentences"].as_array().expect("sentences");
    assert_eq!(sentences[0], "both profiles are equal in every section: perhaps both are of one scan");
    assert_eq!(sentences[1], "no change beyond 2 standard deviations of both diameters");
    assert_eq!(found["places"][10][0], found["places"][10][1]);
    let chart = found["chart"].as_str().expect("a chart");
    assert!(chart.starts_with("<svg xmlns=") && chart.contains("viewBox=\"0 0 900 300\""));
    assert_eq!(found["axis"]["low"], 0.0);
}

#[test]
fn each_kind_of_file_is_written() {
    let file = |kind: &str| asked("comparison_file", &json!({"scans": scans(&json!({})), "kind": kind}));
    assert!(file("csv").expect("a table").as_str().expect("text").starts_with("vessel,"));
    assert!(file("html").expect("a report").as_str().expect("text").contains("ICA: before and after"));
    assert!(file("json").expect("JSON").as_str().expect("text").contains("\"2026\""));
    assert_eq!(file("pdf").expect_err("no such kind").kind, "settings");
    let shown = |picture: &str| {
        let scans = scans(&json!({"pictures": [picture, picture]}));
        asked("comparison_file", &json!({"scans": scans, "kind": "html"}))
    };
    let report = shown("QUJD").expect("a report");
    assert_eq!(report.as_str().expect("text").matches("data:image/png;base64,QUJD").count(), 2);
    assert_eq!(shown("<b>").expect_err("no base64").expected, "a PNG in base64");
}

#[test]
fn files_name_neither_scans_nor_patients_unless_asked() {
    let mut two = scans(&json!({
        "identities": [{"patient": "ID-A1"}, {"patient": "ID-B2"}], "scans": ["Smith 1", "Smith 2"],
        "other_patient": true,
    }));
    for (kind, is_named) in [("csv", false), ("html", false), ("html", true), ("json", false), ("json", true)]
    {
        two["is_named"] = json!(is_named);
        let file = asked("comparison_file", &json!({"scans": two, "kind": kind})).expect("a file");
        for secret in ["ID-A1", "ID-B2", "Smith 1", "Smith 2"] {
            assert_eq!(file.as_str().expect("text").contains(secret), is_named, "{kind}");
        }
    }
}

#[test]
fn two_patients_and_damaged_records_are_refused() {
    let compare =
        |more: &Json| asked("compare_scans", &json!({"scans": scans(more), "size": [900.0, 300.0]}));
    let two =
        compare(&json!({"identities": [{"patient": "A1"}, {"patient": "B2"}]})).expect_err("two patients");
    assert_eq!(two.found, "PatientID 'A1' and PatientID 'B2'");
    assert_eq!(two.more.mends[0].name(), "other_patient");
    assert_eq!(compare(&json!({"records": ["{}", "{}"]})).expect_err("no record").kind, "measuring");
    assert!(compare(&json!({"pairs": []})).is_err(), "a straight tube has no shape");
}
