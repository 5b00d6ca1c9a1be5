//! The common form of all CPR modes: a surface of lines across the vessel, as an image without pixels. A row is one
//! line, or several if the row meets the vessel several times.

use crate::math::same_place::ON_PICTURE;
use glam::{DVec2, DVec3};

use crate::error::{Error, ErrorKind};

pub(super) trait Surface: Send + Sync {
    fn height(&self) -> f64;
    /// Extent of the vessel to each side of the middle (mm).
    fn reach(&self) -> f64;
    fn row(&self, y: f64) -> Row;
    fn image_from_world(&self, point: DVec3) -> DVec2;
    fn folded(&self, y: f64, x: &[f64]) -> Vec<bool>;
}

/// Whether the first of two positions (mm aside, mm down) has precedence: the nearer one, then the upper one.
pub(super) fn comes_first([aside, y]: [f64; 2], [other_aside, other_y]: [f64; 2]) -> bool {
    let nearer = other_aside - aside;
    if nearer.abs() > ON_PICTURE { nearer > 0.0 } else { y + ON_PICTURE < other_y }
}

pub(super) fn one_row(mode: &str, mend: &str) -> Error {
    let found = format!("a vessel that lies in one row of the {mode} CPR");
    Error::new(ErrorKind::Camera, "up of the CPR", found, "a vessel of several rows").mend(mend)
}

/// A point of the vessel in a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Anchor {
    pub point: DVec3,
    /// Position in the image, to the right of the middle (mm).
    pub x: f64,
    pub arc_length: f64,
}

/// A straight part of the vessel that lies in the row, usually one point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub from: Anchor,
    pub to: Anchor,
}

impl Run {
    pub(super) fn at(anchor: Anchor) -> Self {
        Self { from: anchor, to: anchor }
    }

    fn nearest_anchor(&self, x: f64) -> Anchor {
        let along = self.to.x - self.from.x;
        let share = if along == 0.0 { 0.0 } else { ((x - self.from.x) / along).clamp(0.0, 1.0) };
        Anchor {
            point: self.from.point.lerp(self.to.point, share),
            x: self.from.x + along * share,
            arc_length: self.from.arc_length + (self.to.arc_length - self.from.arc_length) * share,
        }
    }
}

#[derive(Clone, Debug)]
pub(super) struct Row {
    /// Unit vector to the right.
    pub across: DVec3,
    /// Unit vector into the scene, along which the thickness of a slab is measured.
    pub ahead: DVec3,
    /// The places at which the row meets the vessel, at least one, by rising arc length.
    pub runs: Vec<Run>,
}

impl Row {
    /// The world point at `x` on the line through the vessel point nearest in the row; if two are equally
    /// near, through the front one.
    pub(super) fn place(&self, x: f64) -> DVec3 {
        let mut best = self.runs[0].nearest_anchor(x);
        for run in &self.runs[1..] {
            let other = run.nearest_anchor(x);
            let [far, best_far] = [&other, &best].map(|anchor| (x - anchor.x).abs());
            let is_before = || (other.point - best.point).dot(self.ahead) < 0.0;
            if far < best_far || (far == best_far && is_before()) {
                best = other;
            }
        }
        best.point + self.across * (x - best.x)
    }

    pub(super) fn place_all(&self, x: &[f64], places: &mut [DVec3]) {
        if let [Run { from, to }] = self.runs[..]
            && from.x == to.x
        {
            // Usually a row meets the vessel once, and no pixel needs a search.
            for (place, x) in places.iter_mut().zip(x) {
                *place = from.point + self.across * (x - from.x);
            }
            return;
        }
        for (place, x) in places.iter_mut().zip(x) {
            *place = self.place(*x);
        }
    }

    pub(super) fn arc_length(&self) -> f64 {
        self.runs[0].from.arc_length
    }

    pub(super) fn is_shared(&self) -> bool {
        self.runs.len() > 1 || self.runs[0].from.arc_length < self.runs[0].to.arc_length
    }
}
