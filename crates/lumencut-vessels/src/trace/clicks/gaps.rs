//! Handles gaps, which are parts of a path without lumen. Short gaps are accepted, longer ones rejected or bridged.

use std::ops::Range;

use glam::DVec3;

use crate::trace::lumen::lumen_model::{LumenModel, in_words};
use crate::trace::ways::region::{FULL, Stopper, THIN};
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Mend};
use lumencut_core::math::arc_length::arc_lengths;

/// Longest accepted gap (mm): if the vessel continues straight, and if it turns there.
pub(crate) const LONGEST_GAP: f64 = 5.0;
const LONGEST_TURN: f64 = 1.2;

/// Maximum length of a gap (mm) that may be the wall between two vessels.
const LONGEST_WALL: f64 = 5.0;

/// Directions are taken `beside` mm (from, to) away from a gap; a cosine below `least` between them is a turn.
struct Turn {
    beside: [f64; 2],
    least: f64,
}

/// A line that crosses a wall connects two lumen centres, so its direction right next to the wall is ignored.
const TURN: Turn = Turn { beside: [0.0, 5.0], least: 0.6 };
const CROSSING: Turn = Turn { beside: [3.0, 8.0], least: 0.7 };

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Gap {
    pub points: Range<usize>,
    pub length: f64,
    /// Position in the gap where the membership in lumen is lowest.
    pub place: DVec3,
    pub value: f32,
    /// Whether the gap is too long to be accepted.
    pub is_open: bool,
}

impl Gap {
    pub(crate) fn passes(&self, way: &[DVec3], stopper: &Stopper) -> bool {
        let (from, to) = (way[self.points.start.saturating_sub(1)], way[self.points.end.min(way.len() - 1)]);
        let across = to - from;
        let share =
            ((stopper.center - from).dot(across) / across.length_squared().max(1e-12)).clamp(0.0, 1.0);
        (from + across * share).distance(stopper.center) < stopper.radius
    }
}

pub(crate) struct Line<'a, 'v> {
    voxels: &'a Voxels<'v>,
    model: &'a LumenModel,
    way: &'a [DVec3],
    lengths: Vec<f64>,
}

impl<'a, 'v> Line<'a, 'v> {
    pub(crate) fn new(voxels: &'a Voxels<'v>, model: &'a LumenModel, way: &'a [DVec3]) -> Self {
        Self { voxels, model, way, lengths: arc_lengths(way) }
    }

    /// The gaps of the path; `weak` marks the points without lumen.
    pub(crate) fn gaps(&self, weak: &[bool]) -> Vec<Gap> {
        stretches(weak).into_iter().map(|points| self.gap(points)).collect()
    }

    /// Finds where the path crosses the wall into another vessel: a short part that looks less like lumen
    /// than what surrounds it, with a turn of the line before and after it.
    pub(crate) fn crossing(&self) -> Option<Gap> {
        // Walls are darker than lumen. The cap keeps bright calcium and stents from looking like walls.
        let value = |place: &DVec3| self.voxels.at(*place).min(self.model.high as f32);
        let shares: Vec<f32> = self.way.iter().map(|place| self.model.membership(value(place))).collect();
        let below = |limit: f64| shares.iter().map(|share| f64::from(*share) < limit).collect::<Vec<_>>();
        let full: Vec<bool> = below(FULL).iter().map(|is_below| !is_below).collect();
        stretches(&below(THIN)).into_iter().map(|points| self.gap(points)).find(|gap| {
            gap.length < LONGEST_WALL
                && self.turns(gap, &CROSSING) == [true, true]
                && self.is_between_lumen(gap, &full)
        })
    }

    fn is_between_lumen(&self, gap: &Gap, full: &[bool]) -> bool {
        let (before, after) = self.beside(&gap.points);
        let near = |from: usize, n: usize| (self.lengths[n] - self.lengths[from]).abs() < LONGEST_WALL;
        (0..=before).rev().take_while(|n| near(before, *n)).any(|n| full[n])
            && (after..full.len()).take_while(|n| near(after, *n)).any(|n| full[n])
    }

    fn gap(&self, points: Range<usize>) -> Gap {
        let (before, after) = self.beside(&points);
        let length = self.lengths[after] - self.lengths[before];
        let value_of = |n: usize| self.voxels.at(self.way[n]);
        let share = |n: usize| self.model.membership(value_of(n));
        let weakest = points.clone().min_by(|a, b| share(*a).total_cmp(&share(*b))).unwrap_or(points.start);
        let mut gap =
            Gap { points, length, place: self.way[weakest], value: value_of(weakest), is_open: false };
        let limit = if self.turns(&gap, &TURN) == [false, false] { LONGEST_GAP } else { LONGEST_TURN };
        gap.is_open = length > limit;
        gap
    }

    fn beside(&self, points: &Range<usize>) -> (usize, usize) {
        (points.start.saturating_sub(1), points.end.min(self.way.len() - 1))
    }

    /// Whether the direction of the vessel before the gap, and after it, differs from that of the gap.
    fn turns(&self, gap: &Gap, turn: &Turn) -> [bool; 2] {
        let (way, lengths) = (self.way, &self.lengths);
        let (before, after) = self.beside(&gap.points);
        let across = (way[after] - way[before]).normalize_or_zero();
        let at = |length: f64| lengths.partition_point(|l| *l < length).min(way.len() - 1);
        let turns = |from: f64, to: f64| {
            let along = way[at(to)] - way[at(from)];
            along.length_squared() > 0.0 && along.normalize().dot(across) < turn.least
        };
        let [near, far] = turn.beside;
        let (first, last) = (lengths[before], lengths[after]);
        [turns(first - far, first - near), turns(last + near, last + far)]
    }
}

fn stretches(marked: &[bool]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut i = 0;
    while i < marked.len() {
        let end = (i..marked.len()).find(|n| !marked[*n]).unwrap_or(marked.len());
        if end > i {
            found.push(i..end);
        }
        i = end + 1;
    }
    found
}

pub(crate) fn no_lumen(between: [DVec3; 2], gap: &Gap, model: &LumenModel) -> Error {
    let value = model.polarity.turned(f64::from(gap.value));
    let found = format!(
        "{:.1} mm between them that do not look like lumen, least at {}, where the volume has {:.0}",
        gap.length,
        in_words(gap.place),
        value
    );
    Error::new(ErrorKind::Tracing, subject(between), found, expected(model))
        .mend("add a point where the vessel continues")
        .mended_by(Mend::Bridge)
        .at(gap.place, value)
}

pub(crate) fn no_way(between: [DVec3; 2], model: &LumenModel) -> Error {
    let found = "no path between them within reach that avoids forbidden places";
    Error::new(ErrorKind::Tracing, subject(between), found, expected(model))
        .mend("add points along the vessel, or remove stoppers")
}

fn subject([from, to]: [DVec3; 2]) -> String {
    format!("points {} and {}", in_words(from), in_words(to))
}

fn expected(model: &LumenModel) -> String {
    format!("lumen of about {} between them", range(model))
}

fn range(model: &LumenModel) -> String {
    let unit = if model.is_hounsfield { " HU" } else { "" };
    let ends = [model.low, model.high].map(|value| model.polarity.turned(value).round());
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    if low < high { format!("{low} to {high}{unit}") } else { format!("{low}{unit}") }
}
