//! Plans how to read DICOM series in a browser; input and output are those of `lumencut_dicom::json`. It is a
//! separate module, so that pages without DICOM do not load it.
#![cfg(target_arch = "wasm32")]

use lumencut_dicom::{Keyword, json};
use serde_json::{Map, Value};
use wasm_bindgen::prelude::wasm_bindgen;

/// Plans a volume; see `lumencut_dicom::json::judge`.
#[wasm_bindgen]
pub fn judge_dicom(headers: &str, wanted: &str) -> String {
    json::judge(headers.as_bytes(), wanted.as_bytes())
}

/// The attributes to read from headers, with their functional groups.
#[wasm_bindgen]
pub fn dicom_attributes() -> String {
    let groups =
        Keyword::ALL.iter().map(|keyword| (keyword.name().to_owned(), Value::from(keyword.groups())));
    Value::Object(groups.collect::<Map<_, _>>()).to_string()
}
