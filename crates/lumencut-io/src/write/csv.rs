//! Writes tables (`.csv`) with one row per point. Spreadsheets show their cells but do not execute them.

use super::{check_all, confidences};
use crate::centerlines::Line;
use crate::error::{Error, Result};
use std::borrow::Cow;

/// Writes a `.csv` of vessels (mm, LPS) with the columns `line` (from 0), `name`, `l (mm)`, `p (mm)`, `s (mm)`,
/// `radius (mm)` and `confidence`. Name, radius and confidence exist only if any vessel has them. Names that look
/// like formulas get an apostrophe. Missing radii are 0. Coordinates and radii are read back bit-identically; names
/// are not read, and lines that meet are joined again. Fails if no vessel is valid, or if a name has a line break.
pub fn write_csv(vessels: &[Line]) -> Result<Vec<u8>> {
    check_all(vessels)?;
    let is_long = |vessel: &Line| vessel.name.as_ref().is_some_and(|name| name.contains(char::is_control));
    if let Some(index) = vessels.iter().position(is_long) {
        let found = "a line break or another control character";
        let error = Error::new(format!("name of line {index}"), found, "a name without one");
        return Err(error.mend("write .mrk.json, or change the name"));
    }
    let with_names = vessels.iter().any(|vessel| vessel.name.is_some());
    let with_radii = vessels.iter().any(|vessel| vessel.radius.is_some());
    let (name, radius) =
        (if with_names { ",name" } else { "" }, if with_radii { ",radius (mm)" } else { "" });
    let mut confidence = confidences(vessels).map(Vec::into_iter);
    let sure = if confidence.is_some() { ",confidence" } else { "" };
    let mut out = format!("line{name},l (mm),p (mm),s (mm){radius}{sure}\n");
    for (index, vessel) in vessels.iter().enumerate() {
        let name = quoted(&marked_cell(vessel.name.as_deref().unwrap_or_default()));
        for (i, point) in vessel.points.iter().enumerate() {
            out += &index.to_string();
            if with_names {
                out += &format!(",{name}");
            }
            out += &format!(",{:?},{:?},{:?}", point.x, point.y, point.z);
            if with_radii {
                out += &format!(",{:?}", vessel.radius.as_ref().map_or(0.0, |radius| radius[i]));
            }
            if let Some(number) = confidence.as_mut().and_then(Iterator::next) {
                out += &format!(",{number:?}");
            }
            out.push('\n');
        }
    }
    Ok(out.into_bytes())
}

fn quoted(field: &str) -> String {
    let plain = field.trim() == field && !field.contains([',', ';', '"']);
    if plain { field.to_owned() } else { format!("\"{}\"", field.replace('"', "\"\"")) }
}

/// Characters with which a formula starts.
const FORMULA: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];

/// The text of a cell. If it looks like a formula but is not a number, an apostrophe is put in front. If text
/// begins with apostrophes before a formula, it gets one more, so that reading can restore it.
pub fn marked_cell(text: &str) -> Cow<'_, str> {
    if text.trim_start_matches('\'').starts_with(FORMULA) && !is_number(text) {
        return Cow::Owned(format!("'{text}"));
    }
    Cow::Borrowed(text)
}

fn is_number(text: &str) -> bool {
    text.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c)) && text.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_begins_as_a_formula_is_marked() {
        for text in [
            "=1+1", "+1+1", "-1-", "@SUM(1)", "\t=1", "\r=1", "-", "--1", "+e5", "'=1", "''@", "-inf", "+nan",
        ] {
            assert_eq!(marked_cell(text), format!("'{text}"));
        }
        for text in ["", "LAD", "-1", "+.5", "-2.5e-3", "-3.", "1=1", "'LAD", "'", " =1"] {
            assert_eq!(marked_cell(text), text);
        }
    }
}
