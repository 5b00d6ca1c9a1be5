//! Tests of repeated positions, images, series and patients.

use crate::made::{SYNTAX, as_they_are, even, judged, plan, refused, stack};
use lumencut_dicom::{Error, Mend, Plan, json};
use serde_json::{Value, json};

fn acquired(parts: &[std::ops::Range<usize>]) -> Vec<Value> {
    let of = |(n, part): (usize, &std::ops::Range<usize>)| {
        let heights: Vec<f64> = part.clone().map(|k| 2.0 * k as f64).collect();
        stack(&heights, |k, attributes| {
            attributes["SOPInstanceUID"] = format!("1.2.{n}.{k}").into();
            attributes["AcquisitionNumber"] = n.into();
        })
    };
    parts.iter().enumerate().flat_map(of).collect()
}

fn with_unlike(files: &[Value], unlike: &[[usize; 2]]) -> Value {
    let frame = |file: usize| json!({"file": file, "frame": 0});
    let pairs: Vec<Value> =
        unlike.iter().map(|[kept, other]| json!({"kept": frame(*kept), "other": frame(*other)})).collect();
    let headers = json!({"transfer_syntaxes": [SYNTAX], "files": files, "unlike": pairs}).to_string();
    serde_json::from_str(&json::judge(headers.as_bytes(), b"{}")).expect("JSON")
}

fn pairs(plan: &Plan) -> Vec<[usize; 2]> {
    plan.compared.iter().map(|pair| [pair.kept.file, pair.other.file]).collect()
}

fn phases(error: &Error) -> Option<&Mend> {
    error.mended_by.as_deref()
}

#[test]
fn overlapping_parts_are_to_be_compared() {
    for (parts, compared) in [
        (vec![0..21, 20..40], vec![[20, 21]]),
        (vec![0..23, 20..40], vec![[20, 23], [21, 24], [22, 25]]),
        (vec![20..40, 0..21], vec![[0, 40]]),
        (vec![0..14, 13..27, 26..40], vec![[13, 14], [27, 28]]),
        (vec![0..40, 10..12], vec![[10, 40], [11, 41]]),
    ] {
        let plan = plan(&acquired(&parts));
        assert_eq!((plan.size[2], pairs(&plan)), (40, compared), "{parts:?}");
        assert!(plan.notes[0].contains("overlapping parts are read as one scan"), "{:?}", plan.notes);
    }
}

#[test]
fn parts_that_differ_have_two_meanings() {
    let files = acquired(&[0..21, 20..40]);
    let error = &with_unlike(&files, &[[20, 21]])["error"];
    let words = "41 slices at 40 positions, with different values: IM20 and IM0; AcquisitionNumber is 0 in 21 slices, \
                 1 in 20 slices: phases, or overlapping parts of one scan";
    assert_eq!(error["found"], words);
    assert_eq!(error["mends"], json!([{"name": "phase", "values": ["0", "1"]}]));
    let plan = judged(&files, json!({"phase": "1"})).expect("one part");
    assert_eq!((plan.size[2], plan.notes[0].as_str()), (20, "phase 1 lacks 20 of 40 positions"));
}

#[test]
fn places_that_all_phases_share_need_no_comparison() {
    for parts in [vec![0..40, 0..40], vec![0..40, 1..40], vec![0..40, 0..40, 0..9]] {
        let error = refused(&acquired(&parts));
        assert!(error.found.contains("AcquisitionNumber differs"), "{}", error.found);
        assert!(matches!(phases(&error), Some(Mend::Phase(_))));
    }
}

#[test]
fn copies_are_compared_and_what_differs_is_refused() {
    let mut files = stack(&even(4), as_they_are);
    files.extend(files[1..3].to_vec());
    let found = plan(&files);
    assert_eq!((found.slices.len(), pairs(&found)), (4, vec![[1, 4], [2, 5]]));
    assert_eq!(found.notes[0], "left out, 2 files with the SOPInstanceUID and values of another: IM1, IM2");
    let error = &with_unlike(&files, &[[2, 5]])["error"];
    assert_eq!(
        (&error["file"], &error["found"]),
        (&json!(5), &json!("the SOPInstanceUID of IM2, but different values"))
    );
    files[5]["header"]["attributes"]["RescaleIntercept"] = "-1000".into();
    let error = refused(&files);
    assert_eq!(error.found, "the SOPInstanceUID of IM2, but different RescaleIntercept");
    files[5]["header"]["attributes"]["RescaleIntercept"] = "-1024.0".into();
    assert_eq!(plan(&files).slices.len(), 4);
}

fn own_series(k: usize, attributes: &mut Value) {
    attributes["SeriesInstanceUID"] = format!("1.5.{k}").into();
}

#[test]
fn series_of_one_slice_are_one_scan_where_they_form_a_stack() {
    let found = plan(&stack(&even(6), own_series));
    assert_eq!((found.size[2], found.details.series_uid.as_str()), (6, "1.5.0"));
    assert!(found.notes[0].starts_with("6 series of one slice each are read as one scan"));
    let holed = refused(&stack(&[0.0, 2.0, 4.0, 8.0, 10.0], own_series));
    assert_eq!(holed.mended_by.as_deref(), Some(&Mend::FillGaps));
    for (what, change) in [
        ("SeriesNumber", (|k| json!(k)) as fn(usize) -> Value),
        ("StudyInstanceUID", |k| json!(format!("1.6.{k}"))),
        ("PatientID", |k| json!(format!("P{k}"))),
        ("ImagePositionPatient", |_| json!(["0", "0", "4"])),
        ("ImagePositionPatient", |k| json!(["0", format!("{}", k % 2), format!("{}", 2 * k)])),
    ] {
        let error = refused(&stack(&even(6), |k, attributes| {
            own_series(k, attributes);
            attributes[what] = change(k);
        }));
        assert!(error.found.starts_with("6 series: number"), "{what}: {}", error.found);
        assert!(error.found.ends_with("and 2 more"), "{what}: {}", error.found);
    }
}

#[test]
fn patients_are_told_apart_by_their_ids() {
    let error = refused(&stack(&even(6), |k, attributes| {
        attributes["PatientID"] = ["P1", "P2"][usize::from(k > 3)].into();
        attributes["PatientName"] = "DOE^JANE".into();
    }));
    assert_eq!(
        error.found,
        "slices of several patients: PatientID is 'P1' in 4 images (IM0), 'P2' in 2 images (IM4)"
    );
    let one = stack(&even(6), |k, attributes| attributes["PatientID"] = ["P1", " P1 ", ""][k % 3].into());
    assert_eq!(plan(&one).slices.len(), 6);
}

#[test]
fn lists_of_a_message_are_short() {
    let files = stack(&even(60), |k, attributes| {
        own_series(k, attributes);
        attributes["SeriesNumber"] = k.into();
        attributes["SeriesDescription"] = "a long description ".repeat(9).into();
    });
    let error = refused(&files);
    assert_eq!(error.series.len(), 60);
    assert!(error.found.len() < 1000, "{}", error.found.len());
    let many = stack(&even(60), |k, attributes| {
        for keyword in ["TriggerTime", "EchoTime", "EchoNumbers", "ContentTime", "AcquisitionTime", "StackID"]
        {
            attributes[keyword] = format!("{}{}", "7".repeat(50), k % 9).into();
        }
    });
    let error = judged(&many, json!({"phase": "x"})).expect_err("no such phase");
    assert!(error.found.len() < 1500, "{}", error.found.len());
}
