//! Writes VTK XML poly data (`.vtp`), one polyline per vessel, as text.

use super::{BY_HAND, CONFIDENCE, check_all, confidences, moved};
use crate::centerlines::{JOINED_MARK, Line};
use crate::error::{Error, Result};
use crate::poly_data::{HAS_NAME, HAS_RADIUS, NAMES, RADIUS_NAMES};

/// Writes a `.vtp` of vessels (mm, LPS). An end point of several vessels is repeated in each of them. The point
/// arrays `MaximumInscribedSphereRadius` and `Confidence` hold radii and confidences, `ByHand` is 1 where a reader moved the line;
/// the cell array `Name` holds names. If only some vessels have radii or names, `HasRadius` and `HasName` mark those. Fails if no vessel is
/// valid, or if a name has a null character, which ends text in VTK.
pub fn write_vtp(vessels: &[Line]) -> Result<Vec<u8>> {
    check_all(vessels)?;
    let with_null = |vessel: &Line| vessel.name.as_ref().is_some_and(|name| name.contains('\0'));
    if let Some(index) = vessels.iter().position(with_null) {
        let error = Error::new(format!("name of line {index}"), "a null character", "a name without one");
        return Err(error.mend("write .mrk.json, or change the name"));
    }
    let (lines, points) = (vessels.len(), vessels.iter().map(|vessel| vessel.points.len()).sum::<usize>());
    Ok(format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n\
         <PolyData>\n<FieldData>\n{space}{mark}</FieldData>\n\
         <Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"{lines}\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n\
         <PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n<Lines>\n{}</Lines>\n\
         </Piece>\n</PolyData>\n</VTKFile>\n",
        radii(vessels) + &numbers(CONFIDENCE, confidences(vessels)) + &numbers(BY_HAND, moved(vessels)),
        names(vessels) + &which_have(HAS_RADIUS, vessels, |vessel| vessel.radius.is_some()),
        coordinates(vessels),
        cells(vessels, points),
        space = element("Array", "String", "SPACE", " NumberOfTuples=\"1\"", [text("LPS")]),
        mark = element("DataArray", "UInt8", JOINED_MARK, " NumberOfTuples=\"1\"", ["1".into()]),
    )
    .into_bytes())
}

fn element(tag: &str, kind: &str, name: &str, more: &str, rows: impl IntoIterator<Item = String>) -> String {
    let rows: Vec<String> = rows.into_iter().collect();
    let rows = rows.join("\n");
    format!("<{tag} type=\"{kind}\" Name=\"{name}\"{more} format=\"ascii\">\n{rows}\n</{tag}>\n")
}

/// The codes of the bytes, and a zero at the end.
fn text(text: &str) -> String {
    text.bytes().map(|byte| format!("{byte} ")).collect::<String>() + "0"
}

fn radii(vessels: &[Line]) -> String {
    if vessels.iter().all(|vessel| vessel.radius.is_none()) {
        return String::new();
    }
    let rows = vessels.iter().flat_map(|vessel| {
        (0..vessel.points.len()).map(|i| format!("{:?}", vessel.radius.as_ref().map_or(0.0, |r| r[i])))
    });
    element("DataArray", "Float64", RADIUS_NAMES[0], "", rows)
}

fn numbers(name: &str, numbers: Option<Vec<f64>>) -> String {
    numbers.map_or_else(String::new, |numbers| {
        element("DataArray", "Float64", name, "", numbers.iter().map(|number| format!("{number:?}")))
    })
}

fn names(vessels: &[Line]) -> String {
    if vessels.iter().all(|vessel| vessel.name.is_none()) {
        return String::new();
    }
    let rows = vessels.iter().map(|vessel| text(vessel.name.as_deref().unwrap_or_default()));
    element("Array", "String", NAMES, "", rows)
        + &which_have(HAS_NAME, vessels, |vessel| vessel.name.is_some())
}

fn which_have(name: &str, vessels: &[Line], has: impl Fn(&Line) -> bool) -> String {
    let count = vessels.iter().filter(|vessel| has(vessel)).count();
    if count == 0 || count == vessels.len() {
        return String::new();
    }
    element("DataArray", "UInt8", name, "", vessels.iter().map(|vessel| u8::from(has(vessel)).to_string()))
}

fn coordinates(vessels: &[Line]) -> String {
    let points = vessels.iter().flat_map(|vessel| &vessel.points);
    let rows = points.map(|p| format!("{:?} {:?} {:?}", p.x, p.y, p.z));
    element("DataArray", "Float64", "Points", " NumberOfComponents=\"3\"", rows)
}

fn cells(vessels: &[Line], points: usize) -> String {
    let ends = vessels.iter().scan(0, |end, vessel| {
        *end += vessel.points.len();
        Some(end.to_string())
    });
    element("DataArray", "Int64", "connectivity", "", (0..points).map(|id| id.to_string()))
        + &element("DataArray", "Int64", "offsets", "", ends)
}
