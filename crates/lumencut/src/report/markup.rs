//! Pieces of HTML: what a host or a file told is escaped, and pictures are part of the page.

use lumencut_core::error::{Error, ErrorKind, Result};

/// A text that stands in HTML as it is.
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

/// The paragraph of a text.
pub(super) fn paragraph(class: &str, text: &str) -> String {
    let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
    format!("<p{class}>{}</p>\n", escaped(text))
}

/// The address of a PNG that is given in base64: the picture itself.
///
/// # Errors
/// [`ErrorKind::Settings`] for a text that is not base64.
pub(super) fn png_address(base64: &str) -> Result<String> {
    let is_known = |letter: u8| letter.is_ascii_alphanumeric() || b"+/=".contains(&letter);
    if base64.is_empty() || !base64.bytes().all(is_known) {
        let found = format!("{} letters that are not base64", base64.len());
        return Err(Error::new(ErrorKind::Settings, "picture of the report", found, "a PNG in base64"));
    }
    Ok(format!("data:image/png;base64,{base64}"))
}

/// A picture with what it shows.
///
/// # Errors
/// As [`png_address`].
pub(super) fn figure(base64: &str, words: &str) -> Result<String> {
    let (address, words) = (png_address(base64)?, escaped(words));
    Ok(format!("<figure><img src=\"{address}\" alt=\"{words}\"><figcaption>{words}</figcaption></figure>\n"))
}
