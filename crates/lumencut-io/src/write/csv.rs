//! Tables (`.csv`): a row per point.

use super::{check_all, confidences, marked_cell};
use crate::centerlines::Line;
use crate::error::{Error, Result};

/// A `.csv` file of vessels (mm, LPS): the columns `line`, which counts the vessels from 0, `name` where any
/// vessel has one, `l (mm)`, `p (mm)`, `s (mm)`, `radius (mm)` where any vessel has radii, and
/// `confidence`, 0 to 1, where any vessel was traced.
///
/// A name that a spreadsheet would run as a formula stands behind an apostrophe.
///
/// Where only some vessels have radii, those of the others are 0. Coordinates and radii are read back to the
/// bit; names are not read, and lines that meet are joined anew as those of any table.
///
/// # Errors
/// Where there is no vessel, one is not what a [`Line`] is, or a name does not fit into one line.
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

/// A field in quotation marks where it needs them.
fn quoted(field: &str) -> String {
    let plain = field.trim() == field && !field.contains([',', ';', '"']);
    if plain { field.to_owned() } else { format!("\"{}\"", field.replace('"', "\"\"")) }
}
