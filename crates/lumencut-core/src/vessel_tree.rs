//! Vessels and the tree they form: unbranched centerlines in world space (LPS, mm).

use glam::DVec3;

use crate::error::{Error, ErrorKind, Result};
use crate::math::arc_length::arc_lengths;

/// The largest coordinate (mm) of points and cameras: one kilometre.
pub const MAX_COORDINATE: f64 = 1e6;

/// One unbranched centerline with optional radii, in world space (LPS, mm).
#[derive(Clone, Debug, PartialEq)]
pub struct Vessel {
    points: Vec<DVec3>,
    radius: Option<Vec<f64>>,
    arc_length: Vec<f64>,
}

impl Vessel {
    /// A vessel with at least two finite points and, if radii are given, one finite radius ≥ 0 per point.
    /// Fails with [`ErrorKind::VesselTree`].
    pub fn new(points: Vec<DVec3>, radius: Option<Vec<f64>>) -> Result<Self> {
        let wrong = |subject: &str, found: String, expected: &str| {
            Err(Error::new(ErrorKind::VesselTree, subject, found, expected))
        };
        if points.len() < 2 {
            return wrong("points of the vessel", format!("{} point(s)", points.len()), "at least 2 points");
        }
        if let Some(i) = points.iter().position(|p| !p.is_finite() || p.abs().max_element() > MAX_COORDINATE)
        {
            let found = format!("{} at point {i}", points[i]);
            return wrong("points of the vessel", found, "finite coordinates within 1e6 mm of the origin");
        }
        if let Some(radius) = &radius {
            if radius.len() != points.len() {
                let found = format!("{} radii for {} points", radius.len(), points.len());
                return wrong("radius of the vessel", found, "one radius per point");
            }
            if let Some(i) = radius.iter().position(|r| !(0.0..=MAX_COORDINATE).contains(r)) {
                let found = format!("{} at point {i}", radius[i]);
                return wrong("radius of the vessel", found, "finite radii between 0 and 1e6 mm");
            }
        }
        Ok(Self::from_checked(points, radius))
    }

    /// A vessel whose parts satisfy [`Vessel::new`] by construction.
    pub(crate) fn from_checked(points: Vec<DVec3>, radius: Option<Vec<f64>>) -> Self {
        let arc_length = arc_lengths(&points);
        Self { points, radius, arc_length }
    }

    /// A coarser level of a vessel; `arc_length` is that of the vessel itself (mm, never falling).
    pub(crate) fn coarser(points: Vec<DVec3>, radius: Option<Vec<f64>>, arc_length: Vec<f64>) -> Self {
        Self { points, radius, arc_length }
    }

    /// The points (mm, LPS), at least two.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The radius at each point (mm), if known.
    pub fn radius(&self) -> Option<&[f64]> {
        self.radius.as_deref()
    }

    /// Arc length of each point (mm); for levels of detail that of the original vessel, filtered like points.
    pub fn arc_length(&self) -> &[f64] {
        &self.arc_length
    }

    /// The radius at point `i` (mm), 0 if unknown.
    pub fn radius_or_zero(&self, i: usize) -> f64 {
        self.radius.as_ref().map_or(0.0, |r| r[i])
    }
}

/// Vessels that may share end points; the index is the id. Forests, cycles and separate parts are allowed.
#[derive(Clone, Debug, PartialEq)]
pub struct VesselTree {
    vessels: Vec<Vessel>,
}

impl VesselTree {
    /// A tree of these vessels. Fails with [`ErrorKind::VesselTree`] for none, or more than 2³⁰ points.
    pub fn new(vessels: Vec<Vessel>) -> Result<Self> {
        let points: usize = vessels.iter().map(|v| v.points.len()).sum();
        if vessels.is_empty() || points > 1 << 30 {
            let found = format!("{} vessels with {points} points", vessels.len());
            return Err(Error::new(
                ErrorKind::VesselTree,
                "vessel tree",
                found,
                "1 or more vessels, at most 2^30 points",
            ));
        }
        Ok(Self { vessels })
    }

    /// A tree from vessels that satisfy [`VesselTree::new`] by construction.
    pub(crate) fn from_checked(vessels: Vec<Vessel>) -> Self {
        Self { vessels }
    }

    /// The vessels; the index is the vessel's id.
    pub fn vessels(&self) -> &[Vessel] {
        &self.vessels
    }

    /// The number of segments of all vessels.
    pub fn segment_count(&self) -> usize {
        self.vessels.iter().map(|v| v.points.len() - 1).sum()
    }

    /// The corners of the axis-aligned box around all points (mm, LPS).
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let points = self.vessels.iter().flat_map(|v| &v.points);
        points.fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(*p), high.max(*p)))
    }
}
