//! Writes tables (`.csv`) with one row per point.

use super::{check_all, confidences, marked_cell};
use crate::centerlines::Line;
use crate::error::{Error, Result};

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
