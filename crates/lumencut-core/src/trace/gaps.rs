//! Stretches of a way that show no lumen: short ones are passed, others refused or bridged.

use std::ops::Range;

use glam::DVec3;

use super::lumen_model::{LumenModel, at};
use super::path::arc_lengths;
use super::voxels::Voxels;
use crate::error::{Error, ErrorKind};

/// A stretch without lumen that is passed (mm): where the vessel goes on in the same direction, and elsewhere.
pub const LONGEST_GAP: f64 = 5.0;
const LONGEST_TURN: f64 = 1.2;

/// A turn within a gap: the cosine between the vessel before or after it and the gap itself.
const SAME_DIRECTION: f64 = 0.6;

/// How far before and after a gap the direction of the vessel is looked at (mm).
const BESIDE: f64 = 5.0;

/// A stretch of a way that shows no lumen.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Its points of the way.
    pub points: Range<usize>,
    /// Its length (mm).
    pub length: f64,
    /// Where it shows least.
    pub place: DVec3,
    /// What the volume has there.
    pub value: f32,
    /// Whether it is too long to be passed.
    pub is_open: bool,
}

/// The gaps of a way; `weak` says which of its points show no lumen.
pub fn gaps(voxels: &Voxels, model: &LumenModel, way: &[DVec3], weak: &[bool]) -> Vec<Gap> {
    let lengths = arc_lengths(way);
    let mut found = Vec::new();
    let mut i = 0;
    while i < way.len() {
        let end = (i..way.len()).find(|n| !weak[*n]).unwrap_or(way.len());
        if end > i {
            found.push(gap(voxels, model, way, &lengths, i..end));
        }
        i = end + 1;
    }
    found
}

fn gap(voxels: &Voxels, model: &LumenModel, way: &[DVec3], lengths: &[f64], points: Range<usize>) -> Gap {
    let last = way.len() - 1;
    let (before, after) = (points.start.saturating_sub(1), points.end.min(last));
    let length = lengths[after] - lengths[before];
    let value_of = |n: usize| voxels.at(way[n]);
    let share = |n: usize| model.membership(value_of(n));
    let weakest = points.clone().min_by(|a, b| share(*a).total_cmp(&share(*b))).unwrap_or(points.start);
    let limit = if goes_on(way, lengths, before, after) { LONGEST_GAP } else { LONGEST_TURN };
    Gap { points, length, place: way[weakest], value: value_of(weakest), is_open: length > limit }
}

/// Whether the vessel before and after a gap runs in the direction of the gap.
fn goes_on(way: &[DVec3], lengths: &[f64], before: usize, after: usize) -> bool {
    let first = lengths.partition_point(|l| *l < lengths[before] - BESIDE);
    let last = lengths.partition_point(|l| *l <= lengths[after] + BESIDE) - 1;
    let across = (way[after] - way[before]).normalize_or_zero();
    let same = |from: usize, to: usize| {
        from == to || (way[to] - way[from]).normalize_or_zero().dot(across) > SAME_DIRECTION
    };
    same(first, before) && same(after, last)
}

/// The error for a gap that is too long.
pub fn no_lumen(between: [DVec3; 2], gap: &Gap, model: &LumenModel) -> Error {
    let found = format!(
        "{:.1} mm without lumen between them, weakest at {}, where the volume has {:.0}",
        gap.length,
        at(gap.place),
        gap.value
    );
    Error::new(ErrorKind::Tracing, subject(between), found, expected(model)).mend(
        "add a point where the vessel goes on, or ask for a bridge where it is occluded",
    )
}

/// The error for two points between which nothing was found at all.
pub fn no_way(between: [DVec3; 2], model: &LumenModel) -> Error {
    let found = "no way between them that leaves out what is forbidden and stays within reach";
    Error::new(ErrorKind::Tracing, subject(between), found, expected(model))
        .mend("add points along the vessel, or take stoppers away")
}

fn subject([from, to]: [DVec3; 2]) -> String {
    format!("points {} and {}", at(from), at(to))
}

fn expected(model: &LumenModel) -> String {
    format!("lumen of about {} all the way", range(model))
}

fn range(model: &LumenModel) -> String {
    let unit = if model.is_hounsfield { " HU" } else { "" };
    let (low, high) = (model.low.round(), model.high.round());
    if low < high { format!("{low} to {high}{unit}") } else { format!("{low}{unit}") }
}
