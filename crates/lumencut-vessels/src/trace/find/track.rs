//! Tracks of tubes: centre points, each with the radius, level and contrast of the lumen there.

use glam::DVec3;

use crate::trace::find::quantiles::{lower_median, median};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TrackPoint {
    /// Centre (mm, LPS).
    pub place: DVec3,
    /// Unit vector along the tube.
    pub direction: DVec3,
    /// Radius (mm).
    pub radius: f64,
    /// Intensity level of the lumen, in the unit of the volume.
    pub level: f64,
    /// Contrast to the surrounding tissue, in the unit of the volume.
    pub contrast: f64,
    /// Fraction of rays with a wall about one radius away.
    pub closure: f64,
    /// Whether the section at this point looks like that of a tube.
    pub(crate) is_good: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// The points of the track, at least two.
    pub points: Vec<TrackPoint>,
    /// Confidence that the track is a vessel, 0 to 1.
    pub confidence: f64,
    /// Main reason for doubt, if any.
    pub doubt: Option<TrackDoubt>,
}

/// Why a track may not be a vessel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackDoubt {
    /// The surroundings are bright on most sides, as in bone.
    BrightSides,
    /// The section is flat, like that of a plate of bone.
    Flat,
    /// The inside is uneven, like marrow.
    Uneven,
    /// The track is pale and wide, like an organ.
    PaleAndWide,
    /// The track is short.
    Short,
    /// The radius varies between sections.
    Rough,
    /// The contrast is low.
    Faint,
    /// Few walls are visible.
    Open,
    /// The vessel bridges a gap.
    Gap,
    /// No part of the scan has sure vessels as long as in an angiography.
    Scarce,
}

impl Track {
    pub(crate) fn length(&self) -> f64 {
        length(&self.points)
    }

    pub(crate) fn radius(&self) -> f64 {
        median(&mut self.points.iter().map(|point| point.radius).collect::<Vec<_>>()).unwrap_or(0.0)
    }
}

pub(crate) fn length(points: &[TrackPoint]) -> f64 {
    points.windows(2).map(|pair| pair[0].place.distance(pair[1].place)).sum()
}

/// Lower median of one property of the points; 0 if there are none.
pub(crate) fn usual<'p>(points: impl IntoIterator<Item = &'p TrackPoint>, of: fn(&TrackPoint) -> f64) -> f64 {
    lower_median(&mut points.into_iter().map(of).collect::<Vec<_>>()).unwrap_or(0.0)
}
