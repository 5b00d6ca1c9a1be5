//! Builds HTML fragments with escaped texts and embedded pictures.

use lumencut_core::error::{Error, ErrorKind, Result};

pub(super) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            other => safe.push(other),
        }
    }
    safe
}

pub(super) fn paragraph(class: &str, text: &str) -> String {
    let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
    format!("<p{class}>{}</p>\n", escaped(text))
}

/// A data URL of a base64 PNG.
pub(super) fn png_address(base64: &str) -> Result<String> {
    let is_known = |letter: u8| letter.is_ascii_alphanumeric() || b"+/=".contains(&letter);
    if base64.is_empty() || !base64.bytes().all(is_known) {
        let found = format!("{} letters that are not base64", base64.len());
        return Err(Error::new(ErrorKind::Settings, "picture of the report", found, "a PNG in base64"));
    }
    Ok(format!("data:image/png;base64,{base64}"))
}

pub(super) fn figure(base64: &str, words: &str) -> Result<String> {
    let (address, words) = (png_address(base64)?, escaped(words));
    Ok(format!("<figure><img src=\"{address}\" alt=\"{words}\"><figcaption>{words}</figcaption></figure>\n"))
}
