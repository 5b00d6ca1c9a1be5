//! Test data: headers of series with known geometry.

// Each test file compiles this module, but uses only a part of it.
#![allow(dead_code)]

use lumencut_dicom::{Error, Headers, Plan, Wanted};
use serde_json::{Value, json};

/// The only transfer syntax that can be decoded in tests.
pub const SYNTAX: &str = "1.2.840.10008.1.2.1";

pub fn file(name: &str, attributes: &Value) -> Value {
    json!({
        "name": name,
        "header": {
            "sop_class": "1.2.840.10008.5.1.4.1.1.2",
            "transfer_syntax": SYNTAX,
            "pixels": "PixelData",
            "attributes": attributes,
        },
    })
}

/// The header of an axial slice of 4 × 3 pixels at this height (mm).
pub fn axial(height: f64) -> Value {
    json!({
        "SOPInstanceUID": format!("1.2.3.{height}"),
        "SeriesInstanceUID": "1.2.3", "SeriesNumber": "7", "SeriesDescription": "made", "Modality": "CT",
        "ImageType": ["ORIGINAL", "PRIMARY", "AXIAL"], "SamplesPerPixel": 1,
        "PhotometricInterpretation": "MONOCHROME2", "Rows": 3, "Columns": 4, "BitsAllocated": 16,
        "BitsStored": 12, "HighBit": 11, "PixelRepresentation": 0, "RescaleSlope": "1",
        "RescaleIntercept": "-1024", "PixelSpacing": ["0.75", "0.5"], "SliceThickness": "2",
        "ImagePositionPatient": ["0", "0", format!("{height}")],
        "ImageOrientationPatient": ["1", "0", "0", "0", "1", "0"],
    })
}

/// Headers of slices at these heights (mm), each modified by `change`.
pub fn stack(heights: &[f64], change: impl Fn(usize, &mut Value)) -> Vec<Value> {
    let one = |(k, &height): (usize, &f64)| {
        let mut attributes = axial(height);
        change(k, &mut attributes);
        file(&format!("IM{k}"), &attributes)
    };
    heights.iter().enumerate().map(one).collect()
}

pub fn even(count: usize) -> Vec<f64> {
    (0..count).map(|k| 2.0 * k as f64).collect()
}

pub fn as_they_are(_: usize, _: &mut Value) {}

pub fn with(keyword: &str, value: impl Into<Value>) -> impl Fn(usize, &mut Value) {
    let value = value.into();
    move |_, attributes| attributes[keyword] = value.clone()
}

pub fn headers(files: &[Value]) -> Headers {
    let document = json!({"transfer_syntaxes": [SYNTAX], "files": files});
    serde_json::from_value(document).expect("headers")
}

pub fn judged(files: &[Value], wanted: Value) -> Result<Plan, Error> {
    let wanted: Wanted = serde_json::from_value(wanted).expect("wishes");
    lumencut_dicom::judge(&headers(files), &wanted)
}

pub fn plan(files: &[Value]) -> Plan {
    judged(files, json!({})).expect("one volume")
}

pub fn refused(files: &[Value]) -> Error {
    judged(files, json!({})).expect_err("no volume")
}
