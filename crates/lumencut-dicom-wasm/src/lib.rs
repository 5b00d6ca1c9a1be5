//! DICOM series in a browser, judged by the values of their headers: the documents are those of `lumencut_dicom::json`.
//!
//! A module of its own: most visits open no DICOM, and need not load it.
#![cfg(target_arch = "wasm32")]

use lumencut_dicom::{Keyword, json};
use serde_json::{Map, Value};
use wasm_bindgen::prelude::wasm_bindgen;

/// How images become one volume, or why they do not.
#[wasm_bindgen]
pub fn judge_dicom(headers: &str, wanted: &str) -> String {
    json::judge(headers.as_bytes(), wanted.as_bytes())
}

/// The attributes that headers are asked for, and the functional groups that may have each.
#[wasm_bindgen]
pub fn dicom_attributes() -> String {
    let groups =
        Keyword::ALL.iter().map(|keyword| (keyword.name().to_owned(), Value::from(keyword.groups())));
    Value::Object(groups.collect::<Map<_, _>>()).to_string()
}
