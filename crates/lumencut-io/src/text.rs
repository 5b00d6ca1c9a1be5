//! Lines, fields and numbers of text files.

use std::borrow::Cow;

use glam::DVec3;

use crate::error::{Error, Result, excerpt};

/// Fields of a line beyond which it is no row of a table.
const MOST_FIELDS: usize = 1024;

/// What stands between the fields of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    Character(char),
    Blanks,
}

/// The lines of a text with their numbers, from 1. They end in LF or CR LF, or in CR where there is no LF.
pub fn lines(text: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let end = if text.contains(&b'\n') { b'\n' } else { b'\r' };
    text.split(move |b| *b == end)
        .enumerate()
        .map(|(i, line)| (i + 1, String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line))))
}

/// The lines that are neither blank nor comments behind `#`.
pub fn data_lines(text: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    lines(text).filter(|(_, line)| !line.trim_start().is_empty() && !line.trim_start().starts_with('#'))
}

/// The fields of a line without blanks and quotes around them; separators inside quotes are part of a field.
/// Never many more than a table can have.
pub fn fields(line: &str, separator: Separator) -> Vec<&str> {
    match separator {
        Separator::Blanks => line.split_ascii_whitespace().take(MOST_FIELDS + 1).map(unquoted).collect(),
        Separator::Character(separator) => {
            let mut quoted = false;
            let ends = |c: char| {
                quoted ^= c == '"';
                !quoted && c == separator
            };
            line.split(ends).take(MOST_FIELDS + 1).map(unquoted).collect()
        }
    }
}

fn unquoted(field: &str) -> &str {
    let field = field.trim();
    field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).map_or(field, str::trim)
}

/// The finite number that `field` writes.
///
/// # Errors
/// Naming the line where it is invalid.
pub fn number(line: usize, field: &str) -> Result<f64> {
    let number = field.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| Error::new(format!("line {line}"), excerpt(field), "a finite number"))
}

/// The place that three fields write.
///
/// # Errors
/// Naming the line where one is no finite number.
pub fn point(line: usize, [x, y, z]: [&str; 3]) -> Result<DVec3> {
    Ok(DVec3::new(number(line, x)?, number(line, y)?, number(line, z)?))
}
