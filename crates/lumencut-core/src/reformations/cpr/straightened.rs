//! Straightened CPR: rows by arc length, the vessel straight in the middle, lines across it in the rotation-minimising
//! frame.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::row::{Anchor, Row, Run};
use super::surface::{SAME_PLACE, Surface};
use super::view::{PARALLEL, View, unit};
use crate::error::{Error, ErrorKind, Result};
use crate::reformations::frames::{Frames, MovingFrame};
use crate::reformations::path::Path;

/// How often an interval is halved at most to find a section: below what a number can tell.
const HALVINGS: usize = 60;

/// The space around a straightened vessel: x across the picture to the right, y into it, z along the vessel, all in mm.
/// Before and after the vessel it goes on straight.
#[derive(Clone)]
pub struct Straightened {
    sections: Arc<Sections>,
    /// Sine and cosine of the angle about the vessel.
    angle: [f64; 2],
}

/// What is known of the vessel whatever the angle.
struct Sections {
    path: Arc<Path>,
    frames: Frames,
    /// Places between which path and frame are smooth, by rising arc length.
    marks: Vec<Mark>,
}

/// A place along the vessel.
#[derive(Clone, Copy)]
struct Mark {
    at: f64,
    point: DVec3,
    frame: MovingFrame,
}

/// A section through a point: where along the vessel it is, and what the point is off its centre.
#[derive(Clone, Copy)]
struct Section {
    at: f64,
    frame: MovingFrame,
    offset: DVec3,
}

impl Straightened {
    /// # Errors
    /// [`crate::error::ErrorKind::Camera`] for vectors that are none.
    pub fn new(path: Arc<Path>, view: &View) -> Result<Self> {
        let axes = view.unturned()?;
        let tangent = path.direction()[0];
        let is_along = |v: DVec3| v.cross(tangent).length() <= PARALLEL * v.dot(tangent).abs();
        let ahead = match view.normal {
            Some(normal) => -unit("normal of the CPR", normal)?,
            // A vessel that begins along the direction of view is seen from below there.
            None if is_along(axes.ahead) => axes.up,
            None => axes.ahead,
        };
        if is_along(ahead) {
            let found = format!("{}, along the vessel's first segment {tangent}", -ahead);
            let expected = "a normal across the vessel at its first point";
            return Err(Error::new(ErrorKind::Camera, "normal of the CPR", found, expected));
        }
        let frames = Frames::new(&path, MovingFrame::looking(tangent, ahead));
        let sections = Arc::new(Sections::new(path, frames));
        Ok(Self { sections, angle: view.checked_angle()?.sin_cos().into() })
    }

    /// The same vessel turned by another finite angle (radians).
    #[must_use]
    pub fn rotated(&self, angle: f64) -> Self {
        Self { sections: Arc::clone(&self.sections), angle: angle.sin_cos().into() }
    }

    /// The length of the vessel (mm).
    pub fn length(&self) -> f64 {
        self.sections.path.length()
    }

    /// The world point (mm, LPS) at a place in the straightened space.
    pub fn world_from_straightened(&self, place: DVec3) -> DVec3 {
        let frame = self.sections.frames.at(place.z).turned(self.angle);
        self.sections.path.at(place.z) + frame.across * place.x + frame.ahead * place.y
    }

    /// Where a world point lies in the straightened space: in the section through it whose centre is nearest.
    pub fn straightened_from_world(&self, point: DVec3) -> DVec3 {
        let sections = self.sections.through(point);
        let nearest = sections.iter().min_by(|a, b| a.offset.length().total_cmp(&b.offset.length()));
        nearest.map_or(DVec3::ZERO, |section| self.place(section))
    }

    fn place(&self, section: &Section) -> DVec3 {
        let frame = section.frame.turned(self.angle);
        DVec3::new(section.offset.dot(frame.across), section.offset.dot(frame.ahead), section.at)
    }
}

impl Sections {
    fn new(path: Arc<Path>, frames: Frames) -> Self {
        let stations = frames.stations().iter().map(|station| station.at);
        let mut at: Vec<_> = path.arc_length().iter().copied().chain(stations).collect();
        at.sort_by(f64::total_cmp);
        at.dedup();
        let mark = |at| Mark { at, point: path.at(at), frame: frames.at(at) };
        Self { marks: at.into_iter().map(mark).collect(), path, frames }
    }

    /// The sections that a point lies in, at least one: before and after the vessel the sections go on straight.
    fn through(&self, point: DVec3) -> Vec<Section> {
        let mut found = Vec::new();
        let mut low = self.marks[0].ahead_of(point);
        if low < 0.0 {
            found.push(self.marks[0].beyond(point));
        }
        for ends in self.marks.windows(2) {
            let high = ends[1].ahead_of(point);
            if (low >= 0.0) != (high >= 0.0) {
                found.push(self.between([ends[0].at, ends[1].at], point));
            }
            low = high;
        }
        if low >= 0.0 {
            found.push(self.marks[self.marks.len() - 1].beyond(point));
        }
        found
    }

    /// The section within an interval between two marks, at whose ends a point lies on different sides.
    fn between(&self, [mut from, mut to]: [f64; 2], point: DVec3) -> Section {
        let station = self.frames.station(from);
        let section = |at| Section { at, frame: station.frame_at(at), offset: point - self.path.at(at) };
        let is_after = |section: Section| section.offset.dot(section.frame.tangent) >= 0.0;
        let first = is_after(section(from));
        for _ in 0..HALVINGS {
            let middle = from + (to - from) / 2.0;
            if is_after(section(middle)) == first {
                from = middle;
            } else {
                to = middle;
            }
        }
        section(from + (to - from) / 2.0)
    }
}

impl Mark {
    /// How far a point lies beyond the section here, along the vessel (mm).
    fn ahead_of(&self, point: DVec3) -> f64 {
        (point - self.point).dot(self.frame.tangent)
    }

    /// The section through a point where the vessel goes on straight from here.
    fn beyond(&self, point: DVec3) -> Section {
        let along = self.ahead_of(point);
        let offset = point - self.point - self.frame.tangent * along;
        Section { at: self.at + along, frame: self.frame, offset }
    }

    /// Whether all points of a line lie on one side of the section here, or of the picture: 1 or -1, or else 0.
    fn sides(&self, line: [DVec3; 2], normal: DVec3) -> i8 {
        let [one, other] = line.map(|end| (end - self.point).dot(normal));
        if one.min(other) > SAME_PLACE { 1 } else { -i8::from(one.max(other) < -SAME_PLACE) }
    }
}

impl Surface for Straightened {
    fn height(&self) -> f64 {
        self.length()
    }

    fn reach(&self) -> f64 {
        0.0
    }

    fn row(&self, y: f64) -> Row {
        let frame = self.sections.frames.at(y).turned(self.angle);
        let anchor = Anchor { point: self.sections.path.at(y), x: 0.0, arc_length: y };
        Row { across: frame.across, ahead: frame.ahead, runs: vec![Run::at(anchor)] }
    }

    fn image_from_world(&self, point: DVec3) -> DVec2 {
        let places: Vec<_> = self.sections.through(point).iter().map(|section| self.place(section)).collect();
        // A point of the picture lies where the picture shows it, however near another part of the vessel is.
        let nearest = |shown: bool| {
            let candidates = places.iter().filter(move |place| !shown || place.y.abs() <= SAME_PLACE);
            candidates.min_by(|a, b| a.truncate().length().total_cmp(&b.truncate().length()))
        };
        nearest(true).or_else(|| nearest(false)).map_or(DVec2::ZERO, |place| DVec2::new(place.x, place.z))
    }

    fn folded(&self, y: f64, x: &[f64]) -> Vec<bool> {
        let Sections { path, frames, .. } = &*self.sections;
        let station = frames.station(y);
        let frame = station.frame_at(y).turned(self.angle);
        // How the image moves along the vessel's tangent from row to row, in the middle and per mm beside it.
        let middle = path.direction()[path.segment(y)].dot(frame.tangent);
        let aside = station.turn.cross(frame.across).dot(frame.tangent);
        let mut folded: Vec<_> = x.iter().map(|x| middle + aside * x <= 0.0).collect();
        self.mark_shown_elsewhere(y, x, &mut folded);
        folded
    }
}

impl Straightened {
    /// Marks the pixels of a row whose points the picture shows nearer to the vessel in another row.
    fn mark_shown_elsewhere(&self, y: f64, x: &[f64], folded: &mut [bool]) {
        let row = self.row(y);
        let line = [x[0], x[x.len() - 1]].map(|x| row.place(x));
        for ends in self.sections.marks.windows(2) {
            let frames = [0, 1].map(|n| ends[n].frame.turned(self.angle));
            let tangents = [0, 1].map(|n| ends[n].sides(line, frames[n].tangent));
            let picture = [0, 1].map(|n| ends[n].sides(line, frames[n].ahead));
            // The usual case: the line does not meet these sections, or not where the picture is.
            if [tangents, picture].iter().any(|[one, other]| *one != 0 && one == other) {
                continue;
            }
            for (x, folded) in x.iter().zip(&mut *folded) {
                let point = row.place(*x);
                if (ends[0].ahead_of(point) >= 0.0) != (ends[1].ahead_of(point) >= 0.0) {
                    let section = self.sections.between([ends[0].at, ends[1].at], point);
                    let place = self.place(&section);
                    *folded |= place.y.abs() <= SAME_PLACE && place.x.abs() + SAME_PLACE < x.abs();
                }
            }
        }
    }
}
