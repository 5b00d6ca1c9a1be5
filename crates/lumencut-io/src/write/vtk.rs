//! Writes legacy VTK poly data (`.vtk`), one polyline per vessel, as text.

use super::{CONFIDENCE, check_all, confidences};
use crate::centerlines::{JOINED_MARK, Line};
use crate::error::Result;
use crate::poly_data::{HAS_RADIUS, NAMES, RADIUS_NAMES};

/// Writes a `.vtk` of vessels (mm, LPS). An end point of several vessels is repeated in each of them. The point array
/// `MaximumInscribedSphereRadius` holds radii. If only some vessels have radii, those of others are 0, and the cell
/// array `HasRadius` marks them. The cell array `Name` holds names, which VTK reads and this crate does not.
/// Everything else is read back bit-identically. Fails if no vessel is valid.
pub fn write_vtk(vessels: &[Line]) -> Result<Vec<u8>> {
    check_all(vessels)?;
    let points: usize = vessels.iter().map(|vessel| vessel.points.len()).sum();
    let mut out = format!(
        "# vtk DataFile Version 3.0\n{JOINED_MARK} in mm SPACE=LPS\nASCII\nDATASET POLYDATA\n\
         POINTS {points} double\n"
    );
    for point in vessels.iter().flat_map(|vessel| &vessel.points) {
        out += &format!("{:?} {:?} {:?}\n", point.x, point.y, point.z);
    }
    out += &format!("LINES {} {}\n", vessels.len(), vessels.len() + points);
    let mut next = 0;
    for vessel in vessels {
        let count = vessel.points.len();
        let ids: Vec<String> = (next..next + count).map(|id| id.to_string()).collect();
        out += &format!("{count} {}\n", ids.join(" "));
        next += count;
    }
    out += &point_data(vessels, points);
    out += &cell_data(vessels);
    Ok(out.into_bytes())
}

fn point_data(vessels: &[Line], points: usize) -> String {
    let mut arrays = Vec::new();
    if vessels.iter().any(|vessel| vessel.radius.is_some()) {
        let of = |vessel: &Line| vessel.radius.clone().unwrap_or_else(|| vec![0.0; vessel.points.len()]);
        arrays.push((RADIUS_NAMES[0], vessels.iter().flat_map(of).collect()));
    }
    arrays.extend(confidences(vessels).map(|numbers| (CONFIDENCE, numbers)));
    if arrays.is_empty() {
        return String::new();
    }
    let mut out = format!("POINT_DATA {points}\nFIELD FieldData {}\n", arrays.len());
    for (name, numbers) in arrays {
        out += &format!("{name} 1 {points} double\n");
        for number in numbers {
            out += &format!("{number:?}\n");
        }
    }
    out
}

fn cell_data(vessels: &[Line]) -> String {
    let count = vessels.len();
    let mut arrays = Vec::new();
    if vessels.iter().any(|vessel| vessel.name.is_some()) {
        let names = vessels.iter().map(|vessel| encoded(vessel.name.as_deref().unwrap_or_default()) + "\n");
        arrays.push(format!("{NAMES} 1 {count} string\n{}", names.collect::<String>()));
    }
    let known = vessels.iter().filter(|vessel| vessel.radius.is_some()).count();
    if known > 0 && known < count {
        let has = vessels.iter().map(|vessel| if vessel.radius.is_some() { "1\n" } else { "0\n" });
        arrays.push(format!("{HAS_RADIUS} 1 {count} unsigned_char\n{}", has.collect::<String>()));
    }
    if arrays.is_empty() {
        return String::new();
    }
    format!("CELL_DATA {count}\nFIELD FieldData {}\n{}", arrays.len(), arrays.concat())
}

fn encoded(text: &str) -> String {
    text.bytes()
        .map(|byte| match byte {
            b'"' | b'%' => format!("%{byte:02X}"),
            b'!'..=b'~' => char::from(byte).to_string(),
            _ => format!("%{byte:02X}"),
        })
        .collect()
}
