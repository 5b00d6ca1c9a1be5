//! Messages about two scans that a viewer shows next to each other: the motion between them, and a vessel measured in both.

use glam::{DMat3, DVec3};
use lumencut_vessels::measure::comparison::compare;
use lumencut_vessels::measure::comparison::rigid::Motion;
use serde::{Deserialize, Serialize};

use crate::comparison::Compared;
use crate::profile_record::ProfileRecord;
use crate::report::comparison::{comparison_chart, comparison_html};
use crate::report::scale::Axis;
use crate::scan_identity::{ScanIdentity, doubts};
use crate::study::failure::{Failure, Result};

type Vector = [f64; 3];

/// Scans that share at least this part of the smaller one are taken to have the same coordinates.
const SHARED: f64 = 0.5;

const UNNAMED: [&str; 2] = ["earlier scan", "later scan"];

/// A rigid motion (mm, LPS): a point times `rotation`, plus `shift`.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Motion"))]
pub(crate) struct MotionMessage {
    /// The rows of the matrix.
    #[cfg_attr(test, ts(type = "[Vector, Vector, Vector]"))]
    rotation: [Vector; 3],
    shift: Vector,
}

impl From<Motion> for MotionMessage {
    fn from(motion: Motion) -> Self {
        let rows = DMat3::from_quat(motion.rotation).transpose();
        Self { rotation: rows.to_cols_array_2d(), shift: motion.translation.to_array() }
    }
}

impl MotionMessage {
    /// The motion from one scan to another. Pairs of points that belong together determine it; without a pair it is none for scans in
    /// the same place, and otherwise from centre to centre.
    pub(super) fn between(corners: &[Vec<Vector>; 2], pairs: &[[Vector; 2]]) -> Result<Self> {
        if !pairs.is_empty() {
            let pairs: Vec<[DVec3; 2]> = pairs.iter().map(|pair| pair.map(DVec3::from)).collect();
            return Ok(Motion::of_pairs(&pairs)?.into());
        }
        let [one, other] = corners.each_ref().map(|points| Extent::of(points));
        if one.shared(&other) >= SHARED * one.volume().min(other.volume()) {
            return Ok(Motion::NONE.into());
        }
        Ok(Motion { translation: other.middle() - one.middle(), ..Motion::NONE }.into())
    }
}

/// The box around a scan.
struct Extent {
    low: DVec3,
    high: DVec3,
}

impl Extent {
    fn of(corners: &[Vector]) -> Self {
        let points = || corners.iter().copied().map(DVec3::from);
        Self {
            low: points().fold(DVec3::INFINITY, DVec3::min),
            high: points().fold(DVec3::NEG_INFINITY, DVec3::max),
        }
    }

    fn volume(&self) -> f64 {
        (self.high - self.low).max(DVec3::ZERO).element_product()
    }

    fn shared(&self, other: &Self) -> f64 {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }.volume()
    }

    fn middle(&self) -> DVec3 {
        self.low.midpoint(self.high)
    }
}

/// A vessel measured in an earlier and a later scan.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ScansToCompare"))]
pub(crate) struct ScansMessage {
    /// The records of both profiles, as `profile_record` answers them.
    records: [String; 2],
    /// Places that belong together (arc lengths on both vessels, mm).
    pairs: Vec<[f64; 2]>,
    vessel: String,
    /// What the scans are called.
    scans: [String; 2],
    identities: [ScanIdentity; 2],
    /// Whether scans of two patients are compared.
    other_patient: bool,
    /// Whether scans and patients are named.
    is_named: bool,
    /// Pictures of the earlier and the later scan for the report (PNG in base64); may be empty.
    pictures: Vec<String>,
}

/// The lumen of a vessel in two scans, compared.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ComparedScans {
    /// Doubts, changes, the typical difference, and how the vessels were matched.
    sentences: Vec<String>,
    /// Arc lengths on the earlier and on the later vessel (mm) that belong together; null beyond its ends.
    #[cfg_attr(test, ts(type = "Array<[number, number | null]>"))]
    places: Vec<[f64; 2]>,
    /// The motion from the earlier scan to the later one.
    motion: MotionMessage,
    /// Diameters and differences as SVG, and their axis of arc lengths on the earlier vessel (plot pixels).
    chart: String,
    axis: Axis,
}

impl ScansMessage {
    /// The comparison, with charts of this size (plot pixels).
    pub(super) fn answer(&self, size: [f64; 2]) -> Result<ComparedScans> {
        self.compared(|compared| {
            let (chart, axis) = comparison_chart(compared, size);
            Ok(ComparedScans {
                sentences: compared.lines(),
                places: compared.comparison.places.iter().map(|place| place.at).collect(),
                motion: compared.comparison.matching.motion.into(),
                chart,
                axis,
            })
        })
    }

    /// The comparison as the content of a file: `csv`, `json` or `html`.
    pub(super) fn file(&self, kind: &str) -> Result<String> {
        self.compared(|compared| match kind {
            "csv" => Ok(compared.csv()),
            "json" => Ok(compared.json()),
            "html" => Ok(comparison_html(std::slice::from_ref(compared))?),
            other => Err(Failure::of_message("kind of the file", &other, "csv, json or html")),
        })
    }

    fn compared<T>(&self, work: impl FnOnce(&Compared) -> Result<T>) -> Result<T> {
        let doubts = doubts(&self.identities, self.other_patient, self.is_named)?;
        let profile = |which: usize| ProfileRecord::read(&self.records[which])?.profile();
        let [(earlier, _), (later, _)] = [profile(0)?, profile(1)?];
        let comparison = compare(&earlier, &later, &self.pairs)?;
        let vessel = self.vessel.clone();
        let scans = if self.is_named { self.scans.clone() } else { UNNAMED.map(str::to_owned) };
        let pictures = self.pictures.clone();
        work(&Compared { vessel, scans, comparison: &comparison, doubts, pictures })
    }
}

#[cfg(test)]
#[path = "tests/two_scans.rs"]
mod tests;
