//! Straightened CPR: rows follow the arc length, in the rotation-minimising frame of the vessel.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::roll::Roll;
use super::sections::{Section, Sections};
use super::surface::{Anchor, Row, Run, Surface, comes_first};
use super::view::{PARALLEL, View, unit};
use crate::error::{Error, ErrorKind, Result};
use crate::math::centerline_path::CenterlinePath;
use crate::math::frames::{Frames, MovingFrame};
use crate::math::same_place::ON_PICTURE;

/// Space around a straightened vessel and its straight extension: x right, y into the picture, z along (mm).
#[derive(Clone)]
pub struct Straightened {
    sections: Arc<Sections>,
    angle: Angle,
}

#[derive(Clone)]
enum Angle {
    /// A constant angle: its sine and cosine.
    Even([f64; 2]),
    Rolled(Arc<Roll>),
}

impl Angle {
    fn at(&self, at: f64) -> [f64; 2] {
        match self {
            Self::Even(angle) => *angle,
            Self::Rolled(roll) => roll.angle(at).sin_cos().into(),
        }
    }

    fn even(&self) -> Option<[f64; 2]> {
        match self {
            Self::Even(angle) => Some(*angle),
            Self::Rolled(_) => None,
        }
    }
}

impl Straightened {
    /// Fails with [`crate::error::ErrorKind::Camera`] for zero or non-finite vectors.
    pub fn new(path: Arc<CenterlinePath>, view: &View) -> Result<Self> {
        let axes = view.unturned()?;
        let tangent = path.direction()[0];
        let is_along = |v: DVec3| v.cross(tangent).length() <= PARALLEL * v.dot(tangent).abs();
        let ahead = match view.normal {
            Some(normal) => -unit("normal of the CPR", normal)?,
            // If a vessel begins along the direction of view, its beginning is seen from below.
            None if is_along(axes.ahead) => axes.up,
            None => axes.ahead,
        };
        if is_along(ahead) {
            let found = format!("{}, along the vessel's first segment {tangent}", -ahead);
            let expected = "a normal that is not parallel to the vessel at its first point";
            return Err(Error::new(ErrorKind::Camera, "normal of the CPR", found, expected));
        }
        let frames = Frames::new(&path, MovingFrame::looking(tangent, ahead));
        let sections = Arc::new(Sections::new(path, frames));
        Ok(Self { sections, angle: Angle::Even(view.checked_angle()?.sin_cos().into()) })
    }

    /// The same vessel turned by another finite angle (radians).
    #[must_use]
    pub fn rotated(&self, angle: f64) -> Self {
        Self { sections: Arc::clone(&self.sections), angle: Angle::Even(angle.sin_cos().into()) }
    }

    /// The same vessel with one angle per section.
    #[must_use]
    pub fn rolled(&self, roll: Roll) -> Self {
        Self { sections: Arc::clone(&self.sections), angle: Angle::Rolled(Arc::new(roll)) }
    }

    /// The length of the vessel (mm).
    pub fn length(&self) -> f64 {
        self.sections.path.length()
    }

    /// The world point (mm, LPS) at a position in the straightened space.
    pub fn world_from_straightened(&self, place: DVec3) -> DVec3 {
        let frame = self.frame(place.z);
        self.sections.path.at(place.z) + frame.across * place.x + frame.ahead * place.y
    }

    /// The straightened position of a world point, in the section that contains it with the nearest centre.
    pub fn straightened_from_world(&self, point: DVec3) -> DVec3 {
        let sections = self.sections.through(point);
        let nearest = sections.iter().min_by(|a, b| a.offset.length().total_cmp(&b.offset.length()));
        nearest.map_or(DVec3::ZERO, |section| self.place(section))
    }

    /// The frame of the section at an arc length (mm), turned as the picture is.
    pub fn frame(&self, at: f64) -> MovingFrame {
        self.sections.frames.at(at).turned(self.angle.at(at))
    }

    /// Movement of a point at an offset (mm), per mm along the vessel: 1 on a straight run, 0 where
    /// neighbouring sections meet.
    pub fn advance(&self, at: f64, offset: DVec2) -> f64 {
        let Sections { path, frames, .. } = &*self.sections;
        let station = frames.station(at);
        let frame = station.frame_at(at).turned(self.angle.at(at));
        let radial = frame.across * offset.x + frame.ahead * offset.y;
        path.direction()[path.segment(at)].dot(frame.tangent) + station.turn.cross(radial).dot(frame.tangent)
    }

    fn place(&self, section: &Section) -> DVec3 {
        let frame = section.frame.turned(self.angle.at(section.at));
        DVec3::new(section.offset.dot(frame.across), section.offset.dot(frame.ahead), section.at)
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
        let frame = self.frame(y);
        let anchor = Anchor { point: self.sections.path.at(y), x: 0.0, arc_length: y };
        Row { across: frame.across, ahead: frame.ahead, runs: vec![Run::at(anchor)] }
    }

    fn image_from_world(&self, point: DVec3) -> DVec2 {
        let places: Vec<_> = self.sections.through(point).iter().map(|section| self.place(section)).collect();
        let within = -ON_PICTURE..=self.length() + ON_PICTURE;
        // A point in the picture's plane is shown at its place there, even if another part of the vessel is nearer.
        let shown = places.iter().filter(|place| place.y.abs() <= ON_PICTURE && within.contains(&place.z));
        let first = shown.reduce(|best, place| {
            let [one, other] = [place, best].map(|place| [place.x.abs(), place.z]);
            if comes_first(one, other) { place } else { best }
        });
        let centre = |place: &&DVec3| place.truncate().length();
        let nearest = || places.iter().min_by(|a, b| centre(a).total_cmp(&centre(b)));
        first.or_else(nearest).map_or(DVec2::ZERO, |place| DVec2::new(place.x, place.z))
    }

    fn folded(&self, y: f64, x: &[f64]) -> Vec<bool> {
        // How far each pixel's point moves per mm of the vessel.
        let moves: Vec<_> = x.iter().map(|x| self.advance(y, DVec2::new(*x, 0.0))).collect();
        let mut folded: Vec<_> = moves.iter().map(|moves| *moves <= 0.0).collect();
        self.mark_shown_elsewhere(y, x, &moves, &mut folded);
        folded
    }
}

impl Straightened {
    /// Marks the pixels of a row whose points lie in another row too, which also shows them.
    fn mark_shown_elsewhere(&self, y: f64, x: &[f64], moves: &[f64], folded: &mut [bool]) {
        let row = self.row(y);
        let line = [x[0], x[x.len() - 1]].map(|x| row.place(x));
        let mut found = Vec::new();
        for n in 0..self.sections.intervals() {
            if self.sections.is_apart(n, line, self.angle.even()) {
                continue;
            }
            for ((x, moves), folded) in x.iter().zip(moves).zip(&mut *folded) {
                if *folded || self.sections.holds_no_other(n, y, *x, *moves) {
                    continue;
                }
                found.clear();
                self.sections.within(n, row.place(*x), &mut found);
                for place in found.iter().map(|section| self.place(section)) {
                    let belongs_there = comes_first([place.x.abs(), place.z], [x.abs(), y]);
                    *folded |= place.y.abs() <= ON_PICTURE && belongs_there;
                }
            }
        }
    }
}
