//! Reads 3D Slicer markups (`.mrk.json`): Curve, ClosedCurve and Line.

use glam::DVec3;

use crate::centerlines::{Centerlines, JOINED_MARK, Line};
use crate::error::{Error, Result, excerpt};
use crate::json::Json;
use crate::placed_points::{has_place, note_left_out};
use crate::space::Space;
use crate::unit::Unit;

/// Maximum number of other markup types that an error message names.
const MOST_NAMED: usize = 8;

/// One line per curve or line, through its control points, in the unit of the first markup.
pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let root = Json::of(bytes).map_err(|error| {
        Error::truncated("", format!("damaged JSON ({error})"), "a 3D Slicer markups file")
    })?;
    let [markups, joined] = root.fields(["markups", JOINED_MARK]);
    let joined = joined.is_some_and(|joined| joined.raw() == "true");
    let mut out = Centerlines { joined, ..Centerlines::of("3D Slicer markups") };
    let (mut others, mut unplaced) = (Others::default(), 0);
    let take = |i, value| {
        let markup = Markup::of(value);
        let kind = markup.kind.and_then(Json::text);
        match kind.as_deref().unwrap_or("unnamed type") {
            kind @ ("Curve" | "ClosedCurve" | "Line") => {
                let line = markup_line(&markup, kind, &mut out);
                unplaced += line.map_err(|error| error.in_file(&format!("markup {i}")))?;
                Ok(())
            }
            kind => {
                others.add(kind);
                Ok(())
            }
        }
    };
    markups
        .and_then(|markups| markups.each(take))
        .unwrap_or_else(|| Err(Error::new("markups", "no list", "a 3D Slicer markups file with a list")))?;
    if out.lines.is_empty() && others.count > 0 {
        let expected = "a markup of type Curve, ClosedCurve or Line";
        return Err(Error::new("markups", others.text(), expected));
    }
    note_left_out(&mut out, unplaced, "control point(s) without a position", "with one")?;
    if others.count > 0 {
        out.notes.push(format!("markups other than curves were ignored: {}", others.text()));
    }
    // Files that this crate writes are read back unchanged.
    if out.joined { out.tidy() } else { out.without_zero_radii().tidy() }
}

#[derive(Default)]
struct Others {
    named: Vec<String>,
    count: usize,
}

impl Others {
    fn add(&mut self, kind: &str) {
        self.count += 1;
        if self.named.len() < MOST_NAMED {
            self.named.push(excerpt(kind));
        }
    }

    fn text(&self) -> String {
        let named = self.named.join(", ");
        match self.count - self.named.len() {
            0 => named,
            more => format!("{named} and {more} more"),
        }
    }
}

struct Markup<'a> {
    kind: Option<Json<'a>>,
    name: Option<Json<'a>>,
    space: Option<Json<'a>>,
    unit: Option<Json<'a>>,
    controls: Option<Json<'a>>,
    measurements: Option<Json<'a>>,
}

impl<'a> Markup<'a> {
    fn of(value: Json<'a>) -> Self {
        let names = ["type", "name", "coordinateSystem", "coordinateUnits", "controlPoints", "measurements"];
        let [kind, name, space, unit, controls, measurements] = value.fields(names);
        Self { kind, name, space, unit, controls, measurements }
    }
}

/// Adds the line of a markup. Returns the number of its points without a position.
fn markup_line(markup: &Markup, kind: &str, out: &mut Centerlines) -> Result<usize> {
    let space = space(markup.space)?;
    let own = unit_of("coordinateUnits", markup.unit)?;
    let unit = *out.unit.get_or_insert(own);
    if unit != own {
        out.note_once(format!(
            "markups in different units were converted to {}, the unit of the first",
            unit.name()
        ));
    }
    let Controls { mut points, placed } = Controls::of(markup.controls, own.in_units_of(unit))?;
    let unplaced = placed.len() - points.len();
    if out.lines.is_empty() {
        out.space = space;
    } else if space.unwrap_or(Space::Lps) != out.space.unwrap_or(Space::Lps) {
        // LPS and RAS differ in the signs of x and y.
        points.iter_mut().for_each(|p| *p *= DVec3::new(-1.0, -1.0, 1.0));
        out.note_once("markups in different coordinate systems were converted to that of the first".into());
    }
    let mut radius = radius(markup.measurements, &placed, [own, unit])?;
    if radius.is_some() {
        out.note_once("radius from the measurement 'Radius'".into());
    }
    if kind == "ClosedCurve" && points.len() > 2 {
        points.push(points[0]);
        radius.iter_mut().for_each(|r| r.push(r[0]));
    }
    if kind != "Line" && !out.joined && points.windows(3).any(is_corner) {
        out.note_once(
            "distant control points were joined by straight lines; 3D Slicer may show a smooth curve".into(),
        );
    }
    out.lines.push(Line { points, radius, name: markup.name.and_then(Json::text), ..Line::default() });
    Ok(unplaced)
}

/// Whether the line turns by more than 30°.
fn is_corner(points: &[DVec3]) -> bool {
    let [before, behind] = [points[1] - points[0], points[2] - points[1]];
    before.dot(behind) < 0.75_f64.sqrt() * before.length() * behind.length()
}

/// The space: its name, or the number that 3D Slicer uses for it.
fn space(stated: Option<Json>) -> Result<Option<Space>> {
    let Some(stated) = stated else { return Ok(None) };
    let text = stated.text().unwrap_or_else(|| stated.raw().to_owned());
    match text.trim() {
        "LPS" | "1" => Ok(Some(Space::Lps)),
        "RAS" | "0" => Ok(Some(Space::Ras)),
        other => Err(Error::new("coordinateSystem", excerpt(other), "'LPS' or 'RAS'")),
    }
}

/// The unit: a name, equal names per axis, or a UCUM code such as `["mm", "UCUM", "millimeter"]`; default mm.
fn unit_of(subject: &str, stated: Option<Json>) -> Result<Unit> {
    let Some(stated) = stated else { return Ok(Unit::Millimetre) };
    let (mut first, mut alike, mut coded) = (None, true, false);
    let axes = stated.each(|i, axis| {
        coded |= i == 1 && axis.text().as_deref() == Some("UCUM");
        alike &= coded || first.get_or_insert(axis).raw() == axis.raw();
        Ok(())
    });
    let name = first.filter(|_| axes.is_some() && alike).unwrap_or(stated);
    match name.text().as_deref() {
        Some("") => Some(Unit::Millimetre),
        known => known.and_then(Unit::of_name),
    }
    .ok_or_else(|| Error::new(subject, excerpt(name.raw()), "one of um, mm, cm, dm, m"))
}

#[derive(Default)]
struct Controls {
    points: Vec<DVec3>,
    /// Whether each point has a position.
    placed: Vec<bool>,
}

impl Controls {
    fn of(list: Option<Json>, factor: f64) -> Result<Self> {
        let mut out = Self::default();
        let take = |i, control: Json| {
            let [status, position] = control.fields(["positionStatus", "position"]);
            let status = status.map(|status| status.text().unwrap_or_else(|| status.raw().to_owned()));
            let defined = status.map_or(Ok(true), |status| has_place(status.trim()));
            let subject = || format!("positionStatus of control point {i}");
            let defined = defined.map_err(|error| error.in_file(&subject()))?;
            let place = position.filter(|_| defined);
            out.placed.push(place.is_some());
            if let Some(place) = place {
                out.points.push(position_of(place, i)? * factor);
            }
            Ok(())
        };
        list.and_then(|list| list.each(take)).transpose()?;
        Ok(out)
    }
}

fn position_of(place: Json, index: usize) -> Result<DVec3> {
    place.three_numbers().map(DVec3::from).ok_or_else(|| {
        Error::new(format!("position of control point {index}"), excerpt(place.raw()), "3 numbers")
    })
}

/// The measurement `Radius` of the `placed` points, converted from unit `own` to `wanted`. Null becomes NaN.
fn radius(measurements: Option<Json>, placed: &[bool], [own, wanted]: [Unit; 2]) -> Result<Option<Vec<f64>>> {
    let Some([values, stated]) = measurements.and_then(measured_radius) else { return Ok(None) };
    let Some(count) = values.and_then(|values| values.each(|_, _| Ok(()))).transpose()? else {
        return Ok(None);
    };
    if count != placed.len() {
        let found = format!("{count} values for {} control points", placed.len());
        return Err(Error::new("measurement Radius", found, "one value per control point"));
    }
    let unit = match stated.filter(|unit| unit.text().as_deref() != Some("")) {
        None => own,
        unit => unit_of("units of the measurement Radius", unit)?,
    };
    let mut out = Vec::new();
    let take = |i: usize, value: Json| {
        if placed[i] {
            let wrong = || {
                Error::new(
                    "measurement Radius",
                    format!("{} at point {i}", excerpt(value.raw())),
                    "a number per control point",
                )
            };
            let known = if value.raw() == "null" { Some(f64::NAN) } else { value.number() };
            out.push(known.ok_or_else(wrong)? * unit.in_units_of(wanted));
        }
        Ok(())
    };
    values.and_then(|values| values.each(take)).transpose()?;
    Ok(Some(out))
}

fn measured_radius(measurements: Json) -> Option<[Option<Json>; 2]> {
    let mut found = None;
    measurements.each(|_, measurement| {
        let [name, values, unit] = measurement.fields(["name", "controlPointValues", "units"]);
        let name = name.and_then(Json::text).unwrap_or_default();
        if name.eq_ignore_ascii_case("radius") || name == "MaximumInscribedSphereRadius" {
            found.get_or_insert([values, unit]);
        }
        Ok(())
    });
    found
}
