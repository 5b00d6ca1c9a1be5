//! The sections across a straightened vessel, and the search for those that contain a world point.

use std::sync::Arc;

use glam::DVec3;

use crate::math::centerline_path::CenterlinePath;
use crate::math::frames::{Frames, MovingFrame, Station};
use crate::math::same_place::ON_PICTURE;

/// The largest number of bisections in the search for a section; this many reach the resolution of an f64.
const BISECTIONS: usize = 60;

const MAX_TURN_RADIANS: f64 = 0.1;

/// The sections of a vessel, independent of the angle from which it is seen.
pub(super) struct Sections {
    pub path: Arc<CenterlinePath>,
    pub frames: Frames,
    /// Rising arc lengths; between neighbouring ones path and frame are smooth.
    marks: Vec<Mark>,
}

#[derive(Clone, Copy)]
struct Mark {
    at: f64,
    point: DVec3,
    frame: MovingFrame,
}

/// A section through a point, and the offset of the point from its centre.
#[derive(Clone, Copy)]
pub(super) struct Section {
    pub at: f64,
    pub frame: MovingFrame,
    pub offset: DVec3,
}

impl Section {
    fn ahead(&self) -> f64 {
        self.offset.dot(self.frame.tangent)
    }
}

impl Sections {
    pub(super) fn new(path: Arc<CenterlinePath>, frames: Frames) -> Self {
        let mut at = path.arc_length().to_vec();
        for ends in frames.stations().windows(2) {
            let [from, to] = [ends[0].at, ends[1].at];
            let parts = (ends[0].turn.length() * (to - from) / MAX_TURN_RADIANS).ceil().max(1.0);
            // At most 32 parts, since no turn is larger than half a circle.
            at.extend((0..parts as usize).map(|part| from + (to - from) * (part as f64 / parts)));
        }
        at.extend(frames.stations().last().map(|station| station.at));
        at.sort_by(f64::total_cmp);
        at.dedup();
        let mark = |at| Mark { at, point: path.at(at), frame: frames.at(at) };
        Self { marks: at.into_iter().map(mark).collect(), path, frames }
    }

    pub(super) fn intervals(&self) -> usize {
        self.marks.len() - 1
    }

    /// The sections that contain a point: at least one, since sections continue straight beyond the vessel.
    pub(super) fn through(&self, point: DVec3) -> Vec<Section> {
        let mut found = Vec::new();
        let [first, last] = [self.marks[0], self.marks[self.intervals()]];
        if first.section(point).ahead() < 0.0 {
            found.push(first.beyond(point));
        }
        for n in 0..self.intervals() {
            self.within(n, point, &mut found);
        }
        if last.section(point).ahead() >= 0.0 {
            found.push(last.beyond(point));
        }
        found
    }

    pub(super) fn within(&self, n: usize, point: DVec3, found: &mut Vec<Section>) {
        let ends = [self.marks[n], self.marks[n + 1]];
        let [low, high] = ends.map(|mark| mark.section(point).ahead());
        let [from, to] = ends.map(|mark| mark.at);
        if (low >= 0.0) != (high >= 0.0) {
            found.push(self.crossing(from, to, point));
            return;
        }
        let station = self.frames.station(from);
        if station.turn == DVec3::ZERO {
            return;
        }
        // Sections turn in between, so a point on the same side of both end sections may lie in two sections.
        let direction = self.path.direction()[self.path.segment(from)];
        let [start, end] = ends.map(|mark| mark.section(point).change(station, direction));
        let approaches = if low >= 0.0 { start < 0.0 && end > 0.0 } else { start > 0.0 && end < 0.0 };
        if !approaches {
            return;
        }
        let turning =
            |at: f64| (self.section(station, at, point).change(station, direction) > 0.0) == (start > 0.0);
        let middle = halved(from, to, turning);
        if (self.section(station, middle, point).ahead() >= 0.0) != (low >= 0.0) {
            found.push(self.crossing(from, middle, point));
            found.push(self.crossing(middle, to, point));
        }
    }

    fn section(&self, station: &Station, at: f64, point: DVec3) -> Section {
        Section { at, frame: station.frame_at(at), offset: point - self.path.at(at) }
    }

    /// The section that contains a point, between two arc lengths whose sections have it on different sides.
    fn crossing(&self, from: f64, to: f64, point: DVec3) -> Section {
        let station = self.frames.station(from);
        let is_after = |at: f64| self.section(station, at, point).ahead() >= 0.0;
        let first = is_after(from);
        let at = halved(from, to, |at| is_after(at) == first);
        self.section(station, at, point)
    }

    /// Whether a line certainly meets no section of interval `n` (between two marks), in the picture from
    /// `angle` or any. Within an interval, sections differ from those at its ends by at most the margin.
    pub(super) fn is_apart(&self, n: usize, line: [DVec3; 2], angle: Option<[f64; 2]>) -> bool {
        let ends = [self.marks[n], self.marks[n + 1]];
        let length = ends[1].at - ends[0].at;
        let turn = self.frames.station(ends[0].at).turn.length() * length;
        let reach = line.map(|end| end.distance(ends[0].point));
        let margin = ON_PICTURE + turn * (turn * (reach[0].max(reach[1]) + length) + 2.0 * length) / 8.0;
        let same = |normals: [DVec3; 2]| {
            let sides = [0, 1].map(|n| ends[n].side(line, normals[n], margin));
            sides[0] != 0 && sides[0] == sides[1]
        };
        let ahead = |angle: [f64; 2]| ends.map(|mark| mark.frame.turned(angle).ahead);
        same(ends.map(|mark| mark.frame.tangent)) || angle.is_some_and(|angle| same(ahead(angle)))
    }

    /// Whether interval `n` contains the section at `at`, and surely no other one through a point `aside` mm
    /// off. The image, which moves by `moves` per mm, then never reverses in the interval.
    pub(super) fn holds_no_other(&self, n: usize, at: f64, aside: f64, moves: f64) -> bool {
        let [from, to] = [self.marks[n].at, self.marks[n + 1].at];
        let rate = self.frames.station(from).turn.length();
        from <= at && at <= to && moves > rate * (to - from) * (aside.abs() * rate + 2.0)
    }
}

impl Section {
    /// Change, per mm along the vessel, of the distance by which the point lies ahead of the section.
    fn change(&self, station: &Station, direction: DVec3) -> f64 {
        self.offset.dot(station.turn.cross(self.frame.tangent)) - direction.dot(self.frame.tangent)
    }
}

/// Bisects for the position at which a condition that holds at `from` and not at `to` changes.
fn halved(mut from: f64, mut to: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = from + (to - from) / 2.0;
        if holds(middle) {
            from = middle;
        } else {
            to = middle;
        }
    }
    from + (to - from) / 2.0
}

impl Mark {
    fn section(&self, point: DVec3) -> Section {
        Section { at: self.at, frame: self.frame, offset: point - self.point }
    }

    fn beyond(&self, point: DVec3) -> Section {
        let here = self.section(point);
        let along = here.ahead();
        Section { at: self.at + along, offset: here.offset - self.frame.tangent * along, ..here }
    }

    /// On which side of a plane through the centre a line lies, by more than `margin`: 1, −1, or 0 for neither.
    fn side(&self, line: [DVec3; 2], normal: DVec3, margin: f64) -> i8 {
        let [one, other] = line.map(|end| (end - self.point).dot(normal));
        if one.min(other) > margin { 1 } else { -i8::from(one.max(other) < -margin) }
    }
}
