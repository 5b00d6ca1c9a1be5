//! Tubes as they are tracked: points along the middle, each with its local lumen.

use glam::DVec3;

use crate::trace::find::quantiles::{lower_median, median};

/// A point of a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackPoint {
    /// Where the middle of the lumen lies (mm, LPS).
    pub place: DVec3,
    /// Where the tube leads to (unit vector).
    pub direction: DVec3,
    /// The radius of the lumen (mm).
    pub radius: f64,
    /// The level of the lumen and how far that lies above the tissue around it, in the unit of the volume.
    pub level: f64,
    /// See `level`.
    pub contrast: f64,
    /// The share of rays across the tube that meet a wall about one radius away.
    pub closure: f64,
    /// Whether its cross-section is that of a tube that goes on.
    pub is_good: bool,
}

/// A tube.
#[derive(Clone, Debug)]
pub struct Track {
    /// Its points, at least two.
    pub points: Vec<TrackPoint>,
    /// How sure it is that this is a vessel, 0 to 1.
    pub confidence: f64,
    /// What speaks against a vessel most; none where nothing does.
    pub doubt: Option<TrackDoubt>,
}

/// Why a track may be no vessel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackDoubt {
    /// Its surroundings are bright on most sides, as in bone.
    BrightSides,
    /// Its cross-section is flat, as a plate of bone is.
    Flat,
    /// Its inside is uneven, as marrow is.
    Uneven,
    /// It is pale and wide, as organs are.
    PaleAndWide,
    /// It is short.
    Short,
    /// Its radius changes from section to section.
    Rough,
    /// Its contrast is low.
    Faint,
    /// Few of its walls are seen.
    Open,
    /// It bridges a gap between others.
    Gap,
    /// No part of the scan has sure vessels as long as an angiography has.
    Scarce,
}

impl Track {
    /// The length, in the unit of its places.
    pub fn length(&self) -> f64 {
        length(&self.points)
    }

    /// The median radius.
    pub fn radius(&self) -> f64 {
        median(&mut self.points.iter().map(|point| point.radius).collect::<Vec<_>>()).unwrap_or(0.0)
    }
}

/// The length of a line of points, in the unit of their places.
pub fn length(points: &[TrackPoint]) -> f64 {
    points.windows(2).map(|pair| pair[0].place.distance(pair[1].place)).sum()
}

/// What some points have as a rule: the lower median; 0 of no points.
pub fn usual<'p>(points: impl IntoIterator<Item = &'p TrackPoint>, of: fn(&TrackPoint) -> f64) -> f64 {
    lower_median(&mut points.into_iter().map(of).collect::<Vec<_>>()).unwrap_or(0.0)
}
