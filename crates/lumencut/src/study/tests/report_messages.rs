//! Tests that findings are sentences, and that reports have a page for each vessel.

use serde_json::{Value as Json, json};

use super::*;
use crate::study::tests::{opened, report_of};

fn go_on() -> bool {
    false
}

fn vessel(study: &Study, number: usize, marked: &Json) -> Json {
    let mut marks = json!({"at": null, "references": [], "method": "nascet", "original": null, "comparison": null, "group": null});
    for (name, value) in marked.as_object().expect("names") {
        marks[name] = value.clone();
    }
    let line = &report_of(study)["vessels"][number]["line"];
    json!({"id": number.to_string(), "name": "", "line": line, "marks": marks})
}

#[test]
fn findings_are_told_in_the_sentences_of_the_report() {
    let mut study = opened("y_junction");
    let marked =
        [vessel(&study, 0, &json!({"at": 10.0})), vessel(&study, 2, &json!({"stretch": [2.0, 12.0]}))];
    let vessels: Vec<VesselMessage> = serde_json::from_value(json!(marked)).expect("vessels");
    let mut found = |has_units| {
        let stated = Stated { has_units, has_orientation: true };
        let found = study.findings(&vessels, &[12.34], (stated, &go_on)).expect("findings");
        serde_json::to_value(found).expect("JSON")
    };
    let told = found(true);
    assert_eq!(told["vessels"][0]["line"], marked[0]["line"]);
    let first = &told["vessels"][0]["sentences"][0];
    assert_eq!(first["kind"], "finding");
    let words = first["words"].as_str().expect("words");
    assert!(
        words.ends_with(" mm at 10.0 mm. No percentage: mark a reference where the vessel is normal."),
        "{words}"
    );
    let stretch = "Stretch: length 10.0 mm, straight ";
    let sentences = told["vessels"][1]["sentences"].as_array().expect("sentences");
    let is_stretch = |one: &Json| one["words"].as_str().is_some_and(|words| words.starts_with(stretch));
    assert!(sentences.iter().any(is_stretch), "{sentences:?}");
    assert_eq!(told["distances"], json!(["Straight distance 1: 12.3 mm"]));
    // If the voxel spacing is unknown, lengths have no unit.
    assert!(!found(false).to_string().contains(" mm"));
}

#[test]
fn a_report_has_a_page_for_each_vessel_and_tells_distances_once() {
    let mut study = opened("y_junction");
    let strip = json!({"picture": "QUJD", "size": [100, 20], "spacing": 0.5});
    let page = |number: usize| {
        let vessel = vessel(&study, number, &json!({"at": 10.0}));
        json!({"vessel": vessel, "view": {"picture": "QUJD", "method": "csr"}, "strip": strip, "sections": []})
    };
    let message = json!({
        "vessels": [page(0), page(2)], "scan": null, "saved": "a day",
        "stated": {"has_units": true, "has_orientation": true}, "is_millimetre_assumed": false,
        "window": [300.0, 700.0], "settings": {}, "distances": [12.34],
    });
    let message = serde_json::from_value(message).expect("a message");
    let html = study.measured_report(&message, &go_on).expect("a report");
    assert!(html.contains("<title>Lumencut: lumen of 2 vessels</title>"));
    let count = |words: &str| html.matches(words).count();
    assert_eq!((count("<section>"), count("Straight distance 1: 12.3 mm")), (2, 1));
}
