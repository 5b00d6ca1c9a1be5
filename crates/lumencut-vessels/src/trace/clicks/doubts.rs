//! Doubts about a traced line, in words: it may leave its vessel, or nothing guides it.

use std::ops::Range;

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::nearest_point;
use crate::trace::lumen::level_change::level_change;
use crate::trace::lumen::lumen_model::quantile;
use crate::trace::lumen::own_axis::runs_across;
use crate::trace::lumen::wall_crossing::{WallCrossing, wall_crossings};
use crate::trace::lumen::wander::wandering;
use crate::voxels::Voxels;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::polarity::Polarity;

/// A line between two clicks is a detour if it is longer than their distance by more than this factor.
const DETOUR: f64 = 2.0;

/// A line does not run across its lumen if its ends are farther apart than this many radii.
const LONG: f64 = 4.0;

/// Places of one kind of doubt that lie at most this far apart (mm) are one part.
const APART: f64 = 20.0;

/// A doubt about a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// A sentence that states the reason.
    pub words: String,
    /// The reason in short: the same for all doubts of one kind.
    pub kind: &'static str,
    /// The arc length (mm) from which, or up to which, the line is doubtful; None for the whole line.
    pub at: Option<f64>,
}

/// A line with what is known about its tracing.
#[derive(Clone, Copy, Debug)]
pub struct Doubted<'a> {
    /// The line with its radii.
    pub line: &'a Centerline,
    /// Whether each point lies where no lumen is seen; empty if unknown.
    pub bridged: &'a [bool],
    /// The clicks in order (mm, LPS), if the line was traced between clicks.
    pub clicks: &'a [DVec3],
}

impl Doubted<'_> {
    /// The doubts about the line in the volume in which it was traced.
    pub fn doubts(&self, voxels: &Voxels) -> Vec<Doubt> {
        if self.runs_across(voxels) {
            let words = "The path runs across the lumen, not along it: click in another slice.".to_owned();
            return vec![Doubt { words, kind: "runs across the lumen", at: None }];
        }
        let lengths = arc_lengths(&self.line.points);
        let change = level_change(voxels, self.line).map(|change| {
            let at = lengths[change.at];
            let [before, after] = change.levels.map(|level| voxels.polarity.turned(level));
            let why = format!("the brightness of the lumen changes there from {before:.0} to {after:.0}");
            let cause = match voxels.polarity {
                Polarity::Bright => "another lumen, or fading contrast medium",
                Polarity::Dark => "another lumen, or a leak",
            };
            let words = format!("Doubtful from {at:.0} mm on: {why}: {cause}.");
            Doubt { words, kind: "changes its brightness", at: Some(at) }
        });
        let crossed = self.crossed(voxels, &lengths);
        let wander =
            stretches(&wandering(self.line), |from, to| lengths[to] - lengths[from] <= self.line.radius[to]);
        let wander = wander.first().map(|part| wanders([lengths[part.start], lengths[part.end - 1]]));
        let detours = self.detours(&lengths);
        change
            .into_iter()
            .chain(crossed)
            .chain(wander)
            .chain(detours)
            .chain(self.guesses(voxels, &lengths))
            .collect()
    }

    fn runs_across(&self, voxels: &Voxels) -> bool {
        let [first, .., last] = self.clicks else { return false };
        let widest = self.line.radius.iter().copied().fold(0.0, f64::max);
        let is_long = widest > 0.0 && first.distance(*last) > LONG * widest;
        !is_long && runs_across(voxels, [*first, *last])
    }

    /// One doubt for each part with crossings, since nothing may be wrong between distant ones.
    fn crossed(&self, voxels: &Voxels, lengths: &[f64]) -> Vec<Doubt> {
        let mut crossings = wall_crossings(voxels, self.line);
        crossings.retain(|crossing| self.bridged.get(crossing.at) != Some(&true));
        let tell = |part: &[WallCrossing]| {
            let [from, to] = [part[0].at, part[part.len() - 1].at].map(|n| lengths[n]);
            let place =
                if to > from { format!("from {from:.0} to {to:.0} mm") } else { format!("at {from:.0} mm") };
            let [beside, within] = part[0].levels.map(|level| voxels.polarity.turned(level));
            let sheet = if voxels.polarity == Polarity::Dark { "bright" } else { "dark" };
            let why = format!(
                "the line crosses a {sheet} sheet ({within:.0} between {beside:.0}), a flap or a wall"
            );
            let words = format!("Doubtful {place}: {why}: perhaps another vessel or lumen.");
            Doubt { words, kind: "crosses a flap or wall", at: Some(from) }
        };
        crossings.chunk_by(|a, b| lengths[b.at] - lengths[a.at] <= APART).map(tell).collect()
    }

    fn detours(&self, lengths: &[f64]) -> Vec<Doubt> {
        let at = |click: &DVec3| lengths[nearest_point(&self.line.points, *click)];
        let pairs = self
            .clicks
            .windows(2)
            .map(|pair| ((at(&pair[1]) - at(&pair[0])).abs(), pair[0].distance(pair[1])));
        let detours = pairs.filter(|(way, distance)| *way > DETOUR * distance);
        let words = detours.map(|(way, distance)| {
            format!("Doubtful: the line is {way:.0} mm long between points {distance:.0} mm apart: check its way, and add points along it.")
        });
        words.map(|words| Doubt { words, kind: "makes a detour", at: None }).collect()
    }

    fn guesses(&self, voxels: &Voxels, lengths: &[f64]) -> Vec<Doubt> {
        let tell = |part: &Range<usize>| {
            let places = part.clone().filter(|n| self.bridged[*n]).map(|n| self.line.points[n]);
            let mut values: Vec<f32> = places.map(|place| voxels.shown_at(place) as f32).collect();
            values.sort_unstable_by(f32::total_cmp);
            let [from, to] = [part.start, part.end - 1].map(|n| lengths[n]);
            let why = format!("no clear lumen is seen there (about {:.0})", quantile(&values, 0.5));
            let words = format!("Doubtful from {from:.0} to {to:.0} mm: {why}, so the line is a guess.");
            Doubt { words, kind: "has no clear lumen", at: Some(from) }
        };
        let parts = stretches(self.bridged, |from, to| lengths[to] - lengths[from] <= APART);
        parts.iter().map(tell).collect()
    }
}

fn stretches(marked: &[bool], goes_on: impl Fn(usize, usize) -> bool) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    for n in (0..marked.len()).filter(|n| marked[*n]) {
        match found.last_mut() {
            Some(run) if goes_on(run.end - 1, n) => run.end = n + 1,
            _ => found.push(n..n + 1),
        }
    }
    found
}

fn wanders([from, to]: [f64; 2]) -> Doubt {
    let why = "the line turns in less than the width of the vessel there";
    let (words, at) = if from > 0.0 {
        (format!("Doubtful from {from:.0} mm on: {why}."), from)
    } else {
        (format!("Doubtful up to {to:.0} mm: {why}."), to)
    };
    Doubt { words, kind: "turns too tightly", at: Some(at) }
}
