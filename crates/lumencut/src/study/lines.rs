//! Stores the page's lines by number. A line is immutable: every edit makes a new line, so that it can be undone.

use std::sync::Arc;

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::vessel_tree::Vessel;
use lumencut_io as centerlines;
use lumencut_vessels::trace::clicks::Traced;
use lumencut_vessels::trace::lines::centerline::Centerline;
use serde::{Deserialize, Serialize};

use crate::study::failure::Result;
use crate::study::outlines::Contour;

/// A vessel line: its points, with radius, confidence, bridging and moves by hand of each point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// At least two points (mm, LPS).
    pub points: Vec<DVec3>,
    /// The radius at each point (mm), NaN if unknown; None if unknown everywhere.
    pub radius: Option<Vec<f64>>,
    /// The confidence of each point (0 to 1) of a traced line.
    pub confidence: Option<Vec<f64>>,
    /// Whether each point lies on a bridged stretch without lumen, if known.
    pub bridged: Option<Vec<bool>>,
    /// Whether the reader moved each point by hand; None if none was moved.
    pub by_hand: Option<Vec<bool>>,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct LineContent {
    /// At least two points (mm, LPS).
    points: Vec<[f64; 3]>,
    /// Radius (mm); null if unknown, for all points or for one.
    radius: Option<Vec<Option<f64>>>,
    /// The confidence of each point (0 to 1) of a traced line.
    confidence: Option<Vec<f64>>,
    /// Whether each point lies on a bridged stretch without lumen, if known.
    bridged: Option<Vec<bool>>,
    /// Whether the reader moved each point by hand; null if none was moved.
    #[serde(default)]
    by_hand: Option<Vec<bool>>,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct NamedLine {
    pub line: usize,
    /// Name; may be empty.
    pub name: String,
}

/// A line in a viewer's list. A hidden line is not drawn but is measured together with the others, so hiding changes no number.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ListedLine {
    pub line: usize,
    /// Name; may be empty.
    pub name: String,
    pub(crate) hidden: bool,
    /// Contours that were drawn by hand on the line.
    #[serde(default)]
    pub(crate) contours: Vec<Contour>,
}

impl Line {
    /// The vessel for the core; it states unknown radii as 0 if others are known. Fails with an error of kind `vessel
    /// tree` for invalid points or radii.
    pub fn vessel(&self) -> Result<Vessel> {
        Ok(Vessel::new(self.points.clone(), self.known_radius())?)
    }

    pub(crate) fn in_file(&self, name: &str) -> centerlines::Line {
        centerlines::Line {
            points: self.points.clone(),
            radius: self.known_radius(),
            name: (!name.is_empty()).then(|| name.to_owned()),
            confidence: self.confidence.clone(),
            by_hand: self.by_hand.clone(),
            ..centerlines::Line::default()
        }
    }

    /// The line in the form in which traced vessels can join it. Its width is zero if its radius is unknown.
    pub(crate) fn met(&self) -> Centerline {
        let radius = self.known_radius().unwrap_or_else(|| vec![0.0; self.points.len()]);
        Centerline { points: self.points.clone(), radius, confidence: Vec::new() }
    }

    /// The radius at each point (mm), 0 if unknown; None if unknown everywhere.
    pub fn known_radius(&self) -> Option<Vec<f64>> {
        let radius = self.radius.as_ref().filter(|radius| radius.iter().any(|r| !r.is_nan()))?;
        Some(radius.iter().map(|r| if r.is_nan() { 0.0 } else { *r }).collect())
    }

    pub(crate) fn content(&self) -> LineContent {
        let known = |radius: &f64| (!radius.is_nan()).then_some(*radius);
        LineContent {
            points: self.points.iter().map(|point| point.to_array()).collect(),
            radius: self.radius.as_ref().map(|radius| radius.iter().map(known).collect()),
            confidence: self.confidence.clone(),
            bridged: self.bridged.clone(),
            by_hand: self.by_hand.clone(),
        }
    }

    /// Arc lengths (mm) of the ends of each stretch that the reader moved.
    pub(crate) fn stretches_by_hand(&self) -> Vec<[f64; 2]> {
        let by_hand = self.by_hand.as_deref().unwrap_or_default();
        let lengths = arc_lengths(&self.points);
        let mut stretches: Vec<[f64; 2]> = Vec::new();
        for (n, length) in lengths.iter().enumerate().filter(|(n, _)| by_hand.get(*n) == Some(&true)) {
            match stretches.last_mut() {
                Some(last) if n > 0 && by_hand[n - 1] => last[1] = *length,
                _ => stretches.push([*length; 2]),
            }
        }
        stretches
    }

    fn check(&self) -> Result<()> {
        self.vessel()?;
        let count = self.points.len();
        let lengths = [
            ("radius", self.radius.as_ref().map(Vec::len)),
            ("confidence", self.confidence.as_ref().map(Vec::len)),
            ("bridged", self.bridged.as_ref().map(Vec::len)),
            ("by hand", self.by_hand.as_ref().map(Vec::len)),
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
            by_hand: content.by_hand,
        }
    }
}

impl From<Centerline> for Line {
    fn from(Centerline { points, radius, confidence }: Centerline) -> Self {
        let confidence = (!confidence.is_empty()).then_some(confidence);
        Self { points, radius: Some(radius), confidence, ..Self::default() }
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

pub(crate) fn wrong(what: &str, found: String, expected: &str) -> Error {
    Error::new(ErrorKind::VesselTree, format!("{what} of the line"), found, expected)
}

#[derive(Debug, Default)]
pub(crate) struct Lines {
    /// Number of lines in earlier studies; line numbers are never used again.
    before: usize,
    held: Vec<Arc<Line>>,
}

impl Lines {
    /// Adds a line and returns the number that it gets.
    pub(crate) fn add(&mut self, line: Line) -> Result<usize> {
        line.check()?;
        self.held.push(Arc::new(line));
        Ok(self.before + self.held.len() - 1)
    }

    pub(crate) fn get(&self, number: usize) -> Result<Arc<Line>> {
        let line = number.checked_sub(self.before).and_then(|place| self.held.get(place));
        line.cloned().ok_or_else(|| {
            let error = wrong("number", number.to_string(), "the number of a line of the open scan");
            error.mend("open the scan again").into()
        })
    }

    pub(crate) fn clear(&mut self) {
        self.before += self.held.len();
        self.held.clear();
    }
}
