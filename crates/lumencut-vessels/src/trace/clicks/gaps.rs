//! Stretches of a way that show no lumen: short ones are passed, others refused or bridged.

use std::ops::Range;

use glam::DVec3;

use crate::trace::lumen::lumen_model::{LumenModel, in_words};
use crate::trace::ways::region::{FULL, Stopper, THIN};
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Mend};
use lumencut_core::math::arc_length::arc_lengths;

/// A stretch without lumen that is passed (mm): where the vessel goes on in the same direction, and elsewhere.
pub(crate) const LONGEST_GAP: f64 = 5.0;
const LONGEST_TURN: f64 = 1.2;

/// The thickest wall between two vessels that a way might cross unseen (mm).
const LONGEST_WALL: f64 = 5.0;

/// What is a turn: how far from a gap the direction of the vessel is looked at (mm), and the cosine of the least turn.
struct Turn {
    beside: [f64; 2],
    least: f64,
}

/// A turn at a gap, and one from one vessel into another: the line goes from the middle of the one to that of the other, so
/// that next to the wall its direction is that of the crossing.
const TURN: Turn = Turn { beside: [0.0, 5.0], least: 0.6 };
const CROSSING: Turn = Turn { beside: [3.0, 8.0], least: 0.7 };

/// A stretch of a way that shows no lumen.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Gap {
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

impl Gap {
    /// Whether the straight line over the gap passes a stopper.
    pub(crate) fn passes(&self, way: &[DVec3], stopper: &Stopper) -> bool {
        let (from, to) = (way[self.points.start.saturating_sub(1)], way[self.points.end.min(way.len() - 1)]);
        let across = to - from;
        let share =
            ((stopper.center - from).dot(across) / across.length_squared().max(1e-12)).clamp(0.0, 1.0);
        (from + across * share).distance(stopper.center) < stopper.radius
    }
}

/// A way, to look for gaps in it.
pub(crate) struct Line<'a, 'v> {
    voxels: &'a Voxels<'v>,
    model: &'a LumenModel,
    way: &'a [DVec3],
    lengths: Vec<f64>,
}

impl<'a, 'v> Line<'a, 'v> {
    /// A way through a volume.
    pub(crate) fn new(voxels: &'a Voxels<'v>, model: &'a LumenModel, way: &'a [DVec3]) -> Self {
        Self { voxels, model, way, lengths: arc_lengths(way) }
    }

    /// The gaps; `weak` says which points show no lumen.
    pub(crate) fn gaps(&self, weak: &[bool]) -> Vec<Gap> {
        stretches(weak).into_iter().map(|points| self.gap(points)).collect()
    }

    /// Where a centerline crosses from one vessel to another through the wall between them: it turns on both sides of a
    /// short stretch that looks less like lumen than what is just before and after.
    pub(crate) fn crossing(&self) -> Option<Gap> {
        // Walls are darker than lumen; calcium and stents in them are brighter and say nothing of a crossing.
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

    /// The points before and after a stretch.
    fn beside(&self, points: &Range<usize>) -> (usize, usize) {
        (points.start.saturating_sub(1), points.end.min(self.way.len() - 1))
    }

    /// Whether the vessel runs in another direction than the gap, before it and after it.
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

/// The stretches of points that are marked.
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

/// The error for a gap that is too long.
pub(crate) fn no_lumen(between: [DVec3; 2], gap: &Gap, model: &LumenModel) -> Error {
    let found = format!(
        "{:.1} mm between them that do not look like lumen, least at {}, where the volume has {:.0}",
        gap.length,
        in_words(gap.place),
        gap.value
    );
    Error::new(ErrorKind::Tracing, subject(between), found, expected(model))
        .mend("add a point where the vessel goes on")
        .mended_by(Mend::Bridge)
        .at(gap.place, f64::from(gap.value))
}

/// The error for two points between which nothing was found at all.
pub(crate) fn no_way(between: [DVec3; 2], model: &LumenModel) -> Error {
    let found = "no way between them that leaves out what is forbidden and stays within reach";
    Error::new(ErrorKind::Tracing, subject(between), found, expected(model))
        .mend("add points along the vessel, or take stoppers away")
}

fn subject([from, to]: [DVec3; 2]) -> String {
    format!("points {} and {}", in_words(from), in_words(to))
}

fn expected(model: &LumenModel) -> String {
    format!("lumen of about {} all the way", range(model))
}

fn range(model: &LumenModel) -> String {
    let unit = if model.is_hounsfield { " HU" } else { "" };
    let (low, high) = (model.low.round(), model.high.round());
    if low < high { format!("{low} to {high}{unit}") } else { format!("{low}{unit}") }
}
