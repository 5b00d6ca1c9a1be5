//! Writes markups of 3D Slicer (`.mrk.json`), with one Curve per vessel.

use serde_json::Value;

use super::{BY_HAND, CONFIDENCE, check_all, moved};
use crate::centerlines::{JOINED_MARK, Line};
use crate::error::Result;

/// Address of the schema, as 3D Slicer states it.
const SCHEMA: &str = "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json#";

/// Writes a `.mrk.json` of vessels (mm, LPS); the measurement `Radius` holds radii. Fails if no vessel is valid.
pub fn write_mrk_json(vessels: &[Line]) -> Result<Vec<u8>> {
    check_all(vessels)?;
    Ok(markups(vessels, "").into_bytes())
}

/// `beside` contains additional fields, each followed by a comma. 3D Slicer ignores them.
pub(crate) fn markups(vessels: &[Line], beside: &str) -> String {
    let curves: Vec<String> = vessels.iter().map(curve).collect();
    let head = format!("\"@schema\": \"{SCHEMA}\",\n\"{JOINED_MARK}\": true");
    format!("{{\n{head},\n{beside}\"markups\": [{}]\n}}\n", curves.join(", "))
}

fn curve(vessel: &Line) -> String {
    let name = vessel.name.as_ref().map(|name| format!("\n  \"name\": {},", Value::from(name.as_str())));
    let points: Vec<String> = vessel.points.iter().enumerate().map(control_point).collect();
    format!(
        "{{\n  \"type\": \"Curve\",{}\n  \"coordinateSystem\": \"LPS\",\n  \"coordinateUnits\": \"mm\",\n  \
         \"controlPoints\": [\n    {}\n  ],\n  \"measurements\": [{}]\n}}",
        name.unwrap_or_default(),
        points.join(",\n    "),
        measurements(vessel),
    )
}

fn control_point((i, point): (usize, &glam::DVec3)) -> String {
    let (number, position) = (i + 1, point.to_array());
    format!(
        "{{\"id\": \"{number}\", \"label\": \"{number}\", \"position\": {position:?}, \
         \"positionStatus\": \"defined\"}}"
    )
}

fn measurements(vessel: &Line) -> String {
    let radius = vessel.radius.as_deref().map(|radius| measurement("Radius", "mm", radius));
    let confidence = vessel.confidence.as_deref().map(|numbers| measurement(CONFIDENCE, "", numbers));
    let by_hand = moved(std::slice::from_ref(vessel)).map(|numbers| measurement(BY_HAND, "", &numbers));
    let all: Vec<String> = radius.into_iter().chain(confidence).chain(by_hand).collect();
    if all.is_empty() { String::new() } else { format!("\n    {}\n  ", all.join(",\n    ")) }
}

fn measurement(name: &str, units: &str, numbers: &[f64]) -> String {
    format!(
        "{{\"name\": \"{name}\", \"enabled\": true, \"units\": \"{units}\", \"printFormat\": \"%-#4.4g%s\",\n     \
         \"controlPointValues\": {numbers:?}}}"
    )
}
