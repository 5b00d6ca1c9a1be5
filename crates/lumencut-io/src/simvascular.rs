//! Reads SimVascular paths (`.pth`).

use glam::DVec3;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::centerlines::{Centerlines, Line};
use crate::error::{Error, Result, excerpt};
use crate::unit::Unit;
use crate::xml::{self, Attributes};

const EXPECTED: &str = "a SimVascular path file";

/// One line per path, at its first time step. Older files have two root elements, `format` and `path`. Files
/// do not state a unit; SimVascular models are usually in cm.
pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader::from_str(&text);
    let mut walk = Walk::default();
    loop {
        match reader.read_event().map_err(|error| xml::damaged(&reader, &error, EXPECTED))? {
            Event::Start(element) => walk.open(&element)?,
            Event::Empty(element) => {
                walk.open(&element)?;
                walk.open.pop();
            }
            Event::End(_) => drop(walk.open.pop()),
            Event::DocType(_) => return Err(xml::document_type(EXPECTED)),
            Event::Eof => break,
            _ => {}
        }
    }
    if let Some(name) = walk.open.last() {
        let found = format!("no end of the element {}", excerpt(name));
        return Err(Error::truncated("", found, EXPECTED));
    }
    walk.centerlines()
}

#[derive(Default)]
struct Path {
    points: Vec<DVec3>,
    control_points: Vec<DVec3>,
}

#[derive(Default)]
struct Walk {
    /// Names of the elements that enclose the current one.
    open: Vec<String>,
    paths: Vec<Path>,
    time_steps: usize,
    later_time_steps: usize,
}

impl Walk {
    fn open(&mut self, element: &BytesStart) -> Result<()> {
        let name = xml::name_at_depth(element, self.open.len(), EXPECTED)?;
        let attributes = xml::attributes(element, EXPECTED)?;
        if self.open.is_empty() {
            self.time_steps = 0;
        }
        let parent = self.open.last().map_or("", String::as_str);
        match (name.as_str(), parent) {
            ("timestep", _) => {
                self.time_steps += 1;
                self.later_time_steps += usize::from(self.time_steps > 1);
            }
            ("path_element", _) if self.time_steps <= 1 => self.paths.push(Path::default()),
            ("pos", "path_point") | ("point", "control_points") => self.point(&name, &attributes)?,
            _ => {}
        }
        self.open.push(name);
        Ok(())
    }

    fn point(&mut self, element: &str, attributes: &Attributes) -> Result<()> {
        let inside = self.open.iter().any(|name| name == "path_element");
        let Some(path) = self.paths.last_mut().filter(|_| inside && self.time_steps <= 1) else {
            return Ok(());
        };
        let known = if element == "pos" { &mut path.points } else { &mut path.control_points };
        let coordinate = |axis: &str| {
            let text = attributes.get(axis).unwrap_or_default();
            text.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(|| {
                let subject = format!("{axis} of <{element}> {}", known.len());
                Error::new(subject, excerpt(text), "a finite number")
            })
        };
        let point = DVec3::new(coordinate("x")?, coordinate("y")?, coordinate("z")?);
        known.push(point);
        Ok(())
    }

    fn centerlines(self) -> Result<Centerlines> {
        let mut out = Centerlines::of("SimVascular path");
        out.conventional_unit = Some(Unit::Centimetre);
        if self.paths.is_empty() {
            return Err(Error::new("", "XML without a path_element", EXPECTED));
        }
        if self.later_time_steps > 0 {
            let count = self.later_time_steps;
            out.notes.push(format!("{count} time step(s) after the first were ignored"));
        }
        for path in self.paths {
            let points = if path.points.is_empty() {
                out.note_once("no path points: straight lines through the control points".into());
                path.control_points
            } else {
                path.points
            };
            out.lines.push(Line { points, ..Line::default() });
        }
        out.tidy()
    }
}
