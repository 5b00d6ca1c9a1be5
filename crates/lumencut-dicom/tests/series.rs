//! Tests which files are images, which series is read, and which images are rejected.

use crate::made::{SYNTAX, as_they_are, even, headers, judged, plan, refused, stack, with};
use lumencut_dicom::{ErrorKind, describe, json};
use serde_json::{Value, json};

fn series(number: &str, description: &str, change: impl Fn(usize, &mut Value)) -> Vec<Value> {
    stack(&even(5), |k, attributes| {
        attributes["SeriesInstanceUID"] = format!("1.2.{number}").into();
        attributes["SeriesNumber"] = number.into();
        attributes["SeriesDescription"] = description.into();
        change(k, attributes);
    })
}

fn localizer(_: usize, attributes: &mut Value) {
    attributes["ImageType"] = json!(["ORIGINAL", "PRIMARY", "LOCALIZER"]);
}

fn foreign(name: &str, kind: &str) -> Value {
    json!({"name": name, "kind": kind})
}

#[test]
fn the_only_angiography_is_read() {
    let files = [
        series("2", "arterial", as_they_are),
        series("1", "scout", localizer),
        series("99", "screen", with("Modality", "OT")),
    ]
    .concat();
    let plan = plan(&files);
    assert_eq!(plan.slices.iter().map(|one| one.file).collect::<Vec<_>>(), [0, 1, 2, 3, 4]);
    assert_eq!(
        plan.notes[0],
        "of 3 series the only angiography volume is read: number 2 (arterial, CT, 4 × 3 × 5, \
         0.5 × 0.75 × 2 mm, UID 1.2.2)"
    );
    assert!(plan.notes[1].contains("UID 1.2.1: a localiser)"), "{}", plan.notes[1]);
    assert!(plan.notes[1].contains("UID 1.2.99: modality OT)"), "{}", plan.notes[1]);
    assert_eq!(plan.details.series, "number 2, arterial");
}

#[test]
fn several_volumes_are_a_choice() {
    let files = [series("2", "arterial", as_they_are), series("003", "venous", as_they_are)].concat();
    let error = refused(&files);
    assert_eq!((error.kind, error.series.len()), (ErrorKind::Series, 2));
    assert!(error.found.starts_with("2 series: number 2 (arterial, CT"), "{}", error.found);
    for wanted in ["3", "003", "1.2.003"] {
        let plan = judged(&files, json!({"series": wanted})).expect("the second");
        assert_eq!(plan.slices[0].file, 5, "{wanted}");
    }
    let error = judged(&files, json!({"series": "9"})).expect_err("neither");
    assert_eq!(error.expected, "one series with the number or UID '9'");
}

#[test]
fn series_are_described() {
    let holed = stack(&[0.0, 2.0, 4.0, 8.0], as_they_are);
    let files = [holed, series("5", "it", with("ImagePositionPatient", Value::Null))].concat();
    let reports = describe(&headers(&files)).expect("two series");
    assert_eq!((reports[0].size, reports[0].spacing), (Some([4, 3, 5]), Some([0.5, 0.75, 2.0])));
    assert_eq!((reports[0].trouble.as_str(), reports[0].can_be_volume), ("1 missing slice", true));
    assert_eq!((reports[1].trouble.as_str(), reports[1].can_be_volume), ("no positions", false));
    assert_eq!(reports[1].to_string(), "number 5 (it, CT, 5 images, UID 1.2.5: no positions)");
}

#[test]
fn localisers_within_a_series_are_left_out() {
    let files = stack(&even(5), |k, attributes| {
        if k == 1 {
            localizer(k, attributes);
        }
    });
    let error = refused(&files);
    assert!(error.found.starts_with("1 missing slice"), "{}", error.found);
    let files = stack(&[0.0, 2.0, 4.0, 99.0], |k, attributes| {
        if k == 3 {
            localizer(k, attributes);
        }
    });
    assert_eq!(plan(&files).notes, ["left out, localisers: IM3"]);
}

#[test]
fn what_is_no_image_is_left_out() {
    let mut files = stack(&even(3), as_they_are);
    files.insert(0, foreign("READ\x1bME", "no DICOM"));
    let mut report = crate::made::file("DOSE", &json!({}));
    report["header"]["sop_class"] = "1.2.3".into();
    files.push(report);
    let plan = plan(&files);
    assert_eq!(plan.notes, ["left out, no images: READ\u{fffd}ME (no DICOM), DOSE (DICOM of no known kind)"]);
    assert_eq!(plan.slices[0].file, 1);
    assert_eq!(refused(&[]).found, "nothing in it");
    let error = refused(&[foreign("DICOMDIR", "Media Storage Directory Storage")]);
    assert_eq!(error.advice, "give the folder that it is in");
    files.push(crate::made::file("cut", &json!({"Rows": 3})));
    let error = refused(&files);
    assert_eq!((error.found.as_str(), error.file), ("an image without rows and columns", Some(5)));
}

#[test]
fn images_that_are_no_grey_slices_are_refused() {
    for (keyword, value, found) in [
        ("PhotometricInterpretation", json!("RGB"), "a colour image (PhotometricInterpretation RGB)"),
        ("PhotometricInterpretation", json!("PALETTE COLOR"), "a palette image"),
        (
            "PhotometricInterpretation",
            json!("DOE^JOHN"),
            "a colour image (PhotometricInterpretation unknown)",
        ),
        ("SamplesPerPixel", json!(3), "a colour image (PhotometricInterpretation unknown)"),
        ("ModalityLUTSequence", json!(1), "a modality look-up table"),
        ("BitsAllocated", json!(12), "BitsAllocated 12"),
        ("BitsStored", Value::Null, "BitsStored not stated"),
        ("PixelRepresentation", Value::Null, "PixelRepresentation not stated"),
        ("NumberOfFrames", json!("3"), "a multi-frame image of 3 frames without a position for each"),
        ("RescaleSlope", json!("0"), "RescaleSlope 0, which makes all values equal"),
        ("RescaleSlope", json!("nan"), "slope and intercept (nan, -1024.0)"),
        ("PixelSpacing", json!(["0", "1"]), "PixelSpacing [0.0, 1.0]"),
        (
            "ImageOrientationPatient",
            json!([1, 0, 0, 0.5, 1, 0]),
            "ImageOrientationPatient [1.0, 0.0, 0.0, 0.5",
        ),
        ("ImagePositionPatient", json!(["1", "2"]), "2 numbers in ImagePositionPatient"),
    ] {
        let files = stack(&even(4), |k, attributes| {
            if k == 2 {
                attributes[keyword] = value.clone();
            }
        });
        let error = refused(&files);
        assert!(error.found.starts_with(found), "{}", error.found);
        assert_eq!(error.file, Some(2), "{found}");
    }
    let error = refused(&stack(&even(4), with("ImagePositionPatient", Value::Null)));
    assert_eq!(error.found, "no ImagePositionPatient in 4 of 4 images: IM0, IM1, IM2, IM3");
    let mut files = stack(&even(4), as_they_are);
    files[1]["header"]["transfer_syntax"] = "DOE^JOHN".into();
    assert_eq!(refused(&files).found, "pixels in an unknown transfer syntax");
}

#[test]
fn odd_values_are_noted() {
    let files = stack(&even(4), |k, attributes| {
        attributes["RescaleSlope"] = (if k == 1 { "0.5" } else { "1" }).into();
        attributes["HighBit"] = 14.into();
        attributes["LossyImageCompression"] = "01".into();
        attributes["PhotometricInterpretation"] = "MONOCHROME1".into();
        attributes["PixelPaddingValue"] = if k == 2 { json!("DOE^JOHN") } else { json!(-2000) };
    });
    assert_eq!(
        plan(&files).notes,
        [
            "2 different rescale slopes and intercepts: applied slice by slice",
            "rescaling makes fractions: read as float32",
            "HighBit is not BitsStored - 1: the lowest BitsStored bits are read",
            "the images were compressed with loss",
            "MONOCHROME1 (meant to be shown inverted): values are read as they are",
            "stored value -2000 marks pixels outside the scan: read as they are",
        ]
    );
}

/// A file with functional groups: frames at these heights (mm); all other attributes are shared.
fn enhanced(heights: &[f64]) -> Value {
    let mut attributes = crate::made::axial(0.0);
    attributes["NumberOfFrames"] = heights.len().to_string().into();
    let mut one = crate::made::file("all", &attributes);
    let frame = |height: &f64| json!({"ImagePositionPatient": [0, 0, height]});
    one["header"]["frames"] = heights.iter().map(frame).collect();
    one["header"]["shared"] = json!({"PixelSpacing": ["0.6", "0.6"], "RescaleSlope": "2"});
    one
}

#[test]
fn frames_come_before_what_they_share_before_the_top_level() {
    let mut one = enhanced(&[4.0, 0.0, 2.0]);
    one["header"]["frames"][1]["RescaleSlope"] = "3".into();
    let plan = plan(std::slice::from_ref(&one));
    assert_eq!(plan.slices.iter().map(|slice| slice.frame).collect::<Vec<_>>(), [1, 2, 0]);
    assert_eq!(plan.slices.iter().map(|slice| slice.slope).collect::<Vec<_>>(), [3.0, 2.0, 2.0]);
    assert_eq!((plan.world_from_index[0][0], plan.details.files.as_str()), (0.6, "1"));
    one["header"]["frames"][2]["ImagePositionPatient"] = Value::Null;
    assert_eq!(
        refused(std::slice::from_ref(&one)).found,
        "no ImagePositionPatient in 1 of 3 images: all frame 3"
    );
    one["header"]["attributes"]["NumberOfFrames"] = 2_000_000_000.into();
    assert_eq!(refused(&[one]).found, "2000000000 frames and functional groups for 3");
}

const TOLD: [&str; 19] = [
    "SeriesInstanceUID",
    "SeriesNumber",
    "SeriesDescription",
    "Modality",
    "TemporalPositionIdentifier",
    "TemporalPositionIndex",
    "NominalPercentageOfCardiacPhase",
    "NominalCardiacTriggerDelayTime",
    "TriggerTime",
    "EchoNumbers",
    "EchoTime",
    "EffectiveEchoTime",
    "StackID",
    "ConvolutionKernel",
    "AcquisitionNumber",
    "FrameAcquisitionNumber",
    "ImageType",
    "FrameType",
    "AcquisitionTime",
];

#[test]
fn damaged_values_are_neither_told_nor_break_anything() {
    let odd = [
        json!("DOE^JOHN"),
        json!(["DOE^JOHN", "1"]),
        json!(true),
        json!({"DOE^JOHN": 1}),
        json!(-1),
        json!(0),
        json!(1e300),
        json!("nan"),
        json!("inf"),
        json!([]),
        json!(null),
        json!("7".repeat(80)),
        json!([[1]]),
    ];
    for keyword in lumencut_dicom::Keyword::ALL {
        for value in &odd {
            let changed = |k: usize, attributes: &mut Value| {
                if k != 1 {
                    attributes[keyword.name()] = value.clone();
                }
            };
            let files = [stack(&even(4), changed), vec![enhanced(&even(3))]].concat();
            let document = json!({"transfer_syntaxes": [SYNTAX], "files": files}).to_string();
            for wanted in ["{}", r#"{"fill_gaps": true, "resample_slices": true, "phase": "0"}"#] {
                let answer = json::judge(document.as_bytes(), wanted.as_bytes());
                assert!(answer.starts_with(r#"{"plan""#) || answer.starts_with(r#"{"error""#));
                let is_told = TOLD.contains(&keyword.name()) || keyword.name().ends_with("Time");
                assert!(is_told || !answer.contains("DOE"), "{}: {answer}", keyword.name());
            }
            assert!(json::describe(document.as_bytes()).starts_with("{\""));
        }
    }
}

#[test]
fn documents_of_another_form_are_refused_without_their_values() {
    for document in
        [r#"{"files": "DOE^JOHN"}"#, "DOE^JOHN", r#"{"files": [{"name": 3, "x": "DOE^JOHN"}]}"#, ""]
    {
        let answer = json::judge(document.as_bytes(), b"{}");
        assert!(
            answer.starts_with(
                r#"{"error":{"kind":"format","file":null,"found":"headers in an unexpected form"#
            )
        );
        assert!(!answer.contains("DOE"), "{answer}");
    }
}

#[test]
fn numbers_survive_documents_to_the_bit() {
    let third = 1.0 / 3.0;
    let files = stack(&even(3), with("RescaleSlope", json!(third)));
    let document = json!({"transfer_syntaxes": [SYNTAX], "files": files}).to_string();
    let answer: Value = serde_json::from_str(&json::judge(document.as_bytes(), b"{}")).expect("a plan");
    assert_eq!(answer["plan"]["slices"][0]["slope"].as_f64(), Some(third));
}
