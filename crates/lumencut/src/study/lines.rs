//! The lines that the page works with, by number. A line never changes: every edit makes another one, so that undo shows the
//! former.

use std::sync::Arc;

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::vessel_tree::Vessel;
use lumencut_io as centerlines;
use lumencut_vessels::trace::clicks::traced::Traced;
use lumencut_vessels::trace::lines::centerline::Centerline;
use serde::{Deserialize, Serialize};

use crate::study::failure::Result;

/// A line, and what is known at each of its points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// At least two points (mm, LPS).
    pub points: Vec<DVec3>,
    /// The radius at each point (mm), no number where it is not known; none where it is known nowhere.
    pub radius: Option<Vec<f64>>,
    /// How sure each point is, 0 to 1, where the line was traced.
    pub confidence: Option<Vec<f64>>,
    /// Which points lie on a stretch without lumen that was bridged, where that is known.
    pub bridged: Option<Vec<bool>>,
}

/// A line as the page has it; `null` stands for a radius that is not known.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct LineContent {
    /// At least two.
    points: Vec<[f64; 3]>,
    /// mm; null where it is not known, of all points or of one
    radius: Option<Vec<Option<f64>>>,
    /// How sure each point is, from 0 to 1, where the line was traced.
    confidence: Option<Vec<f64>>,
    /// Which points lie on a stretch without lumen that was bridged, where that is known.
    bridged: Option<Vec<bool>>,
}

/// A line with the name under which it is shown and saved.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct NamedLine {
    /// Its number.
    pub line: usize,
    /// Its name; empty where it has none.
    pub name: String,
}

/// A line as a viewer lists it. One that is hidden is not drawn; it is measured among all the same, so that hiding a vessel changes
/// no number.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ListedLine {
    /// Its number.
    pub line: usize,
    /// Its name; empty where it has none.
    pub name: String,
    /// Whether it is hidden.
    pub(crate) hidden: bool,
}

impl Line {
    /// The vessel of the core: radii that are not known are 0 beside others that are.
    ///
    /// # Errors
    /// `vessel tree` for points or radii that are none.
    pub fn vessel(&self) -> Result<Vessel> {
        Ok(Vessel::new(self.points.clone(), self.known_radius())?)
    }

    /// The line as a file holds it.
    pub(crate) fn in_file(&self, name: &str) -> centerlines::Line {
        centerlines::Line {
            points: self.points.clone(),
            radius: self.known_radius(),
            name: (!name.is_empty()).then(|| name.to_owned()),
            confidence: self.confidence.clone(),
            ..centerlines::Line::default()
        }
    }

    /// The line as tracing meets it; of no width where its radius is not known.
    pub(crate) fn met(&self) -> Centerline {
        let radius = self.known_radius().unwrap_or_else(|| vec![0.0; self.points.len()]);
        Centerline { points: self.points.clone(), radius, confidence: Vec::new() }
    }

    /// The radius at each point (mm), 0 where it is not known beside others; none where it is known nowhere.
    pub fn known_radius(&self) -> Option<Vec<f64>> {
        let radius = self.radius.as_ref().filter(|radius| radius.iter().any(|r| !r.is_nan()))?;
        Some(radius.iter().map(|r| if r.is_nan() { 0.0 } else { *r }).collect())
    }

    /// As the page has it.
    pub(crate) fn content(&self) -> LineContent {
        let known = |radius: &f64| (!radius.is_nan()).then_some(*radius);
        LineContent {
            points: self.points.iter().map(|point| point.to_array()).collect(),
            radius: self.radius.as_ref().map(|radius| radius.iter().map(known).collect()),
            confidence: self.confidence.clone(),
            bridged: self.bridged.clone(),
        }
    }

    /// Checks that it is a line.
    ///
    /// # Errors
    /// `vessel tree` for too few points, numbers that are none, and not one of them for each point.
    fn check(&self) -> Result<()> {
        self.vessel()?;
        let count = self.points.len();
        let lengths = [
            ("radius", self.radius.as_ref().map(Vec::len)),
            ("confidence", self.confidence.as_ref().map(Vec::len)),
            ("bridged", self.bridged.as_ref().map(Vec::len)),
        ];
        for (name, length) in lengths {
            if let Some(length) = length.filter(|length| *length != count) {
                return Err(wrong(name, format!("{length} for {count} points"), "one for each point").into());
            }
        }
        let odd = self.confidence.iter().flatten().find(|sure| !(0.0..=1.0).contains(*sure));
        odd.map_or(Ok(()), |odd| Err(wrong("confidence", odd.to_string(), "from 0 to 1").into()))
    }
}

impl From<LineContent> for Line {
    fn from(content: LineContent) -> Self {
        let known = |radius: &Option<f64>| radius.unwrap_or(f64::NAN);
        Self {
            points: content.points.into_iter().map(DVec3::from_array).collect(),
            radius: content.radius.map(|radius| radius.iter().map(known).collect()),
            confidence: content.confidence,
            bridged: content.bridged,
        }
    }
}

impl From<Centerline> for Line {
    fn from(Centerline { points, radius, confidence }: Centerline) -> Self {
        let confidence = (!confidence.is_empty()).then_some(confidence);
        Self { points, radius: Some(radius), confidence, bridged: None }
    }
}

impl From<Traced> for Line {
    fn from(traced: Traced) -> Self {
        Self { bridged: Some(traced.bridged), ..Self::from(traced.line) }
    }
}

impl From<&Vessel> for Line {
    fn from(vessel: &Vessel) -> Self {
        let radius = vessel.radius().map(<[f64]>::to_vec);
        Self { points: vessel.points().to_vec(), radius, ..Self::default() }
    }
}

/// What is wrong with a line.
pub(crate) fn wrong(what: &str, found: String, expected: &str) -> Error {
    Error::new(ErrorKind::VesselTree, format!("{what} of the line"), found, expected)
}

/// All lines of the study that is open.
#[derive(Debug, Default)]
pub(crate) struct Lines {
    /// How many there were in earlier studies: no number stands for two lines.
    before: usize,
    held: Vec<Arc<Line>>,
}

impl Lines {
    /// Takes over a line; gives its number.
    ///
    /// # Errors
    /// `vessel tree` for what is no line.
    pub(crate) fn add(&mut self, line: Line) -> Result<usize> {
        line.check()?;
        self.held.push(Arc::new(line));
        Ok(self.before + self.held.len() - 1)
    }

    /// The line of a number.
    ///
    /// # Errors
    /// `vessel tree` for a number that stands for none.
    pub(crate) fn get(&self, number: usize) -> Result<Arc<Line>> {
        let line = number.checked_sub(self.before).and_then(|place| self.held.get(place));
        line.cloned().ok_or_else(|| {
            let error = wrong("number", number.to_string(), "the number of a line of the open scan");
            error.mend("open the scan again").into()
        })
    }

    /// Forgets all of them.
    pub(crate) fn clear(&mut self) {
        self.before += self.held.len();
        self.held.clear();
    }
}
