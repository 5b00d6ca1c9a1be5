//! Tests that a remedy is a name with values, in Rust and in JSON.

use crate::made::{SYNTAX, as_they_are, even, refused, stack};
use lumencut_dicom::{Mend, json};
use serde_json::{Value, json};

fn document(files: &[Value]) -> Value {
    let headers = json!({"transfer_syntaxes": [SYNTAX], "files": files}).to_string();
    let answer: Value = serde_json::from_str(&json::judge(headers.as_bytes(), b"{}")).expect("JSON");
    answer["error"].clone()
}

fn phases(times: &[&str]) -> Vec<Value> {
    let of = |time: &&str| {
        stack(&even(5), |k, attributes| {
            attributes["SOPInstanceUID"] = format!("1.2.{time}.{k}").into();
            attributes["TriggerTime"] = (*time).into();
        })
    };
    times.iter().flat_map(of).collect()
}

#[test]
fn phases_can_be_chosen_among_in_the_order_of_their_numbers() {
    let files = phases(&["400", "50", "0"]);
    let values = ["0", "50", "400"].map(String::from).to_vec();
    assert_eq!(refused(&files).mended_by.as_deref(), Some(&Mend::Phase(values)));
    let error = document(&files);
    assert_eq!(error["mends"], json!([{"name": "phase", "values": ["0", "50", "400"]}]));
    assert_eq!(error["advice"], "");
}

#[test]
fn values_that_cannot_be_shown_are_no_choice() {
    let files = phases(&["early\u{1b}[2J", "late"]);
    assert_eq!(refused(&files).mended_by.as_deref(), Some(&Mend::Phase(Vec::new())));
}

#[test]
fn documents_tell_names_for_each_kind_of_refusal() {
    let with_gap = document(&stack(&[0.0, 2.0, 4.0, 8.0, 10.0], as_they_are));
    assert_eq!(with_gap["mends"], json!([{"name": "fill_gaps", "values": []}]));
    assert_eq!(with_gap["advice"], "add the missing files");
    let uneven = document(&stack(&[0.0, 2.0, 4.0, 7.0, 10.0], as_they_are));
    assert_eq!(uneven["mends"][0]["name"], "resample_slices");
    let turned = |k: usize, attributes: &mut Value| {
        if k == 2 {
            attributes["PixelSpacing"] = json!(["1", "1"]);
        }
    };
    assert_eq!(document(&stack(&even(5), turned))["mends"], json!([]));
}

#[test]
fn every_mend_has_its_name() {
    let all =
        [Mend::Series, Mend::Phase(vec![]), Mend::FillGaps, Mend::ResampleSlices, Mend::ResampleAndFill];
    assert_eq!(all.each_ref().map(Mend::name), Mend::NAMES);
}
