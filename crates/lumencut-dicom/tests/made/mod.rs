//! Series of known truth, as the headers of them.

// Every test file compiles this room by itself and needs its own part of it.
#![allow(dead_code)]

use lumencut_dicom::{Error, Headers, Plan, Wanted};
use serde_json::{Value, json};

/// The only transfer syntax that is decoded here.
pub const SYNTAX: &str = "1.2.840.10008.1.2.1";

/// A file with these attributes.
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

/// The attributes of an axial slice of 4 × 3 pixels at this height.
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

/// Slices at these heights, named by their order, with changes to each.
pub fn stack(heights: &[f64], change: impl Fn(usize, &mut Value)) -> Vec<Value> {
    let one = |(k, &height): (usize, &f64)| {
        let mut attributes = axial(height);
        change(k, &mut attributes);
        file(&format!("IM{k}"), &attributes)
    };
    heights.iter().enumerate().map(one).collect()
}

/// Slices every 2 mm.
pub fn even(count: usize) -> Vec<f64> {
    (0..count).map(|k| 2.0 * k as f64).collect()
}

/// Leaves slices as they are.
pub fn as_they_are(_: usize, _: &mut Value) {}

/// Puts a value into every slice.
pub fn with(keyword: &str, value: impl Into<Value>) -> impl Fn(usize, &mut Value) {
    let value = value.into();
    move |_, attributes| attributes[keyword] = value.clone()
}

/// The headers of files.
pub fn headers(files: &[Value]) -> Headers {
    let document = json!({"transfer_syntaxes": [SYNTAX], "files": files});
    serde_json::from_value(document).expect("headers")
}

/// What is made of files by these wishes.
pub fn judged(files: &[Value], wanted: Value) -> Result<Plan, Error> {
    let wanted: Wanted = serde_json::from_value(wanted).expect("wishes");
    lumencut_dicom::judge(&headers(files), &wanted)
}

/// The plan for files that can be read as they are.
pub fn plan(files: &[Value]) -> Plan {
    judged(files, json!({})).expect("one volume")
}

/// The error for files that cannot be read as they are.
pub fn refused(files: &[Value]) -> Error {
    judged(files, json!({})).expect_err("no volume")
}
