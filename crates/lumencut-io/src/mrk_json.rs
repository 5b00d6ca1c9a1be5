//! 3D Slicer markups (`.mrk.json`): Curve, ClosedCurve and Line.

use glam::DVec3;
use serde_json::Value;

use crate::centerlines::{Centerlines, JOINED_MARK, Line, Space};
use crate::error::{Error, Result, excerpt};
use crate::unit::Unit;

/// The curves and lines of a `.mrk.json` file, one line each through the control points, in the unit of the
/// first.
///
/// # Errors
/// Where the JSON is damaged, a point or unit is none, or no markup is a curve or line.
pub fn read(bytes: &[u8]) -> Result<Centerlines> {
    let root: Value = serde_json::from_slice(bytes).map_err(|error| {
        Error::truncated("", format!("damaged JSON ({error})"), "a 3D Slicer markups file")
    })?;
    let markups = root.get("markups").and_then(Value::as_array);
    let markups =
        markups.ok_or_else(|| Error::new("markups", "no list", "a 3D Slicer markups file with a list"))?;
    let joined = root.get(JOINED_MARK).and_then(Value::as_bool).unwrap_or(false);
    let mut out = Centerlines { joined, ..Centerlines::of("3D Slicer markups") };
    let mut other_types = Vec::new();
    for (i, markup) in markups.iter().enumerate() {
        let kind = markup.get("type").and_then(Value::as_str).unwrap_or("unnamed type");
        if matches!(kind, "Curve" | "ClosedCurve" | "Line") {
            markup_line(markup, kind, &mut out).map_err(|error| error.in_file(&format!("markup {i}")))?;
        } else {
            other_types.push(excerpt(kind));
        }
    }
    if out.lines.is_empty() && !other_types.is_empty() {
        let expected = "a markup of type Curve, ClosedCurve or Line";
        return Err(Error::new("markups", other_types.join(", "), expected));
    }
    if !other_types.is_empty() {
        out.notes.push(format!("markups that are no curves were left out: {}", other_types.join(", ")));
    }
    out.tidy()
}

fn markup_line(markup: &Value, kind: &str, out: &mut Centerlines) -> Result<()> {
    let space = space(markup)?;
    let own = unit_of("coordinateUnits", markup.get("coordinateUnits"))?;
    let unit = *out.unit.get_or_insert(own);
    if unit != own {
        out.note_once(format!(
            "markups in different units were brought into {}, that of the first",
            unit.name()
        ));
    }
    let empty = Vec::new();
    let controls = markup.get("controlPoints").and_then(Value::as_array).unwrap_or(&empty);
    let placed: Vec<usize> = (0..controls.len()).filter(|i| is_placed(&controls[*i])).collect();
    if placed.len() < controls.len() {
        let count = controls.len() - placed.len();
        out.note_once(format!("{count} control point(s) without a place were left out"));
    }
    let point = |i: &usize| position(&controls[*i], *i).map(|p| p * own.in_units_of(unit));
    let mut points = placed.iter().map(point).collect::<Result<Vec<DVec3>>>()?;
    if out.lines.is_empty() {
        out.space = space;
    } else if space.unwrap_or(Space::Lps) != out.space.unwrap_or(Space::Lps) {
        // LPS and RAS differ in the signs of x and y, whichever of the two the first markup has.
        points.iter_mut().for_each(|p| *p *= DVec3::new(-1.0, -1.0, 1.0));
        out.note_once("markups in different spaces were brought into the space of the first".into());
    }
    let mut radius = radius(markup, controls, &placed, [own, unit], out)?;
    if kind == "ClosedCurve" && points.len() > 2 {
        points.push(points[0]);
        radius.iter_mut().for_each(|r| r.push(r[0]));
    }
    let name = markup.get("name").and_then(Value::as_str).map(str::to_owned);
    out.lines.push(Line { points, radius, group: None, name });
    Ok(())
}

/// The stated space, by name or by the number that 3D Slicer gives it.
fn space(markup: &Value) -> Result<Option<Space>> {
    let text = match markup.get("coordinateSystem") {
        None | Some(Value::Null) => return Ok(None),
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string(),
    };
    match text.trim() {
        "LPS" | "1" => Ok(Some(Space::Lps)),
        "RAS" | "0" => Ok(Some(Space::Ras)),
        other => Err(Error::new("coordinateSystem", excerpt(other), "'LPS' or 'RAS'")),
    }
}

/// The stated unit; one name, or one equal name per axis. Millimetres where none is stated.
fn unit_of(subject: &str, unit: Option<&Value>) -> Result<Unit> {
    let name = match unit {
        None | Some(Value::Null) => return Ok(Unit::Millimetre),
        Some(Value::Array(axes)) if !axes.is_empty() && axes.iter().all(|axis| *axis == axes[0]) => &axes[0],
        Some(other) => other,
    };
    match name.as_str() {
        Some("") => Some(Unit::Millimetre),
        known => known.and_then(Unit::of_name),
    }
    .ok_or_else(|| Error::new(subject, excerpt(&name.to_string()), "one of um, mm, cm, dm, m"))
}

/// Control points that are being placed, or whose place was taken away, have no position of their own.
fn is_placed(control: &Value) -> bool {
    let status = control.get("positionStatus").and_then(Value::as_str).unwrap_or("defined");
    status == "defined" && control.get("position").is_some_and(|position| !position.is_null())
}

fn position(control: &Value, index: usize) -> Result<DVec3> {
    let position = control.get("position").and_then(Value::as_array);
    let numbers: Option<Vec<f64>> = position.and_then(|p| p.iter().map(Value::as_f64).collect());
    match numbers.as_deref() {
        Some([x, y, z]) => Ok(DVec3::new(*x, *y, *z)),
        _ => {
            let found = control.get("position").map(Value::to_string).unwrap_or_default();
            Err(Error::new(format!("position of control point {index}"), excerpt(&found), "3 numbers"))
        }
    }
}

/// The `Radius` measurement of the placed control points. Of the two units the first is the markup's own, the
/// second the one that is wanted.
fn radius(
    markup: &Value,
    controls: &[Value],
    placed: &[usize],
    [own, wanted]: [Unit; 2],
    out: &mut Centerlines,
) -> Result<Option<Vec<f64>>> {
    let measurements = markup.get("measurements").and_then(Value::as_array);
    let is_radius = |m: &&Value| {
        let name = m.get("name").and_then(Value::as_str).unwrap_or_default();
        name.eq_ignore_ascii_case("radius") || name == "MaximumInscribedSphereRadius"
    };
    let Some(measurement) = measurements.and_then(|list| list.iter().find(is_radius)) else {
        return Ok(None);
    };
    let Some(values) = measurement.get("controlPointValues").and_then(Value::as_array) else {
        return Ok(None);
    };
    if values.len() != controls.len() {
        let found = format!("{} values for {} control points", values.len(), controls.len());
        return Err(Error::new("measurement Radius", found, "one value per control point"));
    }
    let unit = match measurement.get("units") {
        None | Some(Value::Null) => own,
        unit => unit_of("units of the measurement Radius", unit)?,
    };
    let value = |i: &usize| {
        let number = values[*i].as_f64().map(|value| value * unit.in_units_of(wanted));
        number.ok_or_else(|| {
            Error::new(
                "measurement Radius",
                format!("{} at point {i}", values[*i]),
                "a number per control point",
            )
        })
    };
    out.note_once("radius from the measurement 'Radius'".into());
    placed.iter().map(value).collect::<Result<Vec<f64>>>().map(Some)
}
