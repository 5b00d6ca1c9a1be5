//! The request to trace vessels through clicks, and its checks that do not need voxel values.

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lumen::lumen_model::in_words;
use crate::trace::ways::region::Stopper;
use crate::voxels::Voxels;
use lumencut_core::error::{Clicked, Error, ErrorKind, Result};

/// The vessels to trace.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clicks {
    /// At least two points per vessel, in order (mm, LPS).
    pub vessels: Vec<Vec<DVec3>>,
    /// Balls that no vessel may enter.
    pub stoppers: Vec<Stopper>,
    /// Whether tracing may cross parts without lumen, of any length, by straight bridges.
    pub bridge: bool,
    /// Existing vessels, which stay unchanged: a new vessel that meets one ends at one of its points. Confidence is
    /// ignored.
    pub beside: Vec<Centerline>,
}

/// Rejects clicks that would be invalid in any volume of this size.
pub fn check(voxels: &Voxels, clicks: &Clicks) -> Result<()> {
    let wrong = |vessel: usize, found: String, expected: &str| {
        let error = Error::new(ErrorKind::Tracing, format!("points of vessel {vessel}"), found, expected);
        Err(error.about(Clicked::Vessel(vessel)))
    };
    for (vessel, points) in clicks.vessels.iter().enumerate() {
        if points.len() < 2 {
            let found = format!("{} point(s)", points.len());
            return wrong(vessel, found, "2 or more, in order along the vessel");
        }
        for (point, place) in points.iter().enumerate() {
            let subject = || (format!("point {point} of vessel {vessel}"), Clicked::Point { vessel, point });
            check_place(voxels, *place, subject)?;
        }
        let near = 0.5 * voxels.smallest_side;
        if let Some(i) = (1..points.len()).find(|i| points[*i].distance(points[i - 1]) < near) {
            let found = format!("points {} and {i}, both {}", i - 1, in_words(points[i]));
            return wrong(vessel, found, "points that differ by more than half a voxel");
        }
    }
    for stopper in &clicks.stoppers {
        let is_usable = stopper.center.is_finite() && stopper.radius.is_finite() && stopper.radius > 0.0;
        if !is_usable {
            let found = format!("{} with radius {}", stopper.center, stopper.radius);
            let expected = "a finite position and a positive radius (mm)";
            return Err(Error::new(ErrorKind::Tracing, "stopper", found, expected));
        }
    }
    Ok(())
}

pub(crate) fn check_place(
    voxels: &Voxels,
    point: DVec3,
    subject: impl Fn() -> (String, Clicked),
) -> Result<()> {
    let wrong = |found: String, expected: String| {
        let (subject, clicked) = subject();
        Err(Error::new(ErrorKind::Tracing, subject, found, expected).about(clicked))
    };
    if !point.is_finite() {
        return wrong(format!("{point}"), "finite coordinates (mm, LPS)".to_owned());
    }
    if voxels.voxel_at(point).is_none() {
        let corner = |c: [f64; 3]| in_words(voxels.world_from_index.transform_point3(DVec3::from_array(c)));
        let last = voxels.size.map(|n| n as f64 - 1.0);
        let expected = format!("a point between its corners {} and {}", corner([0.0; 3]), corner(last));
        return wrong(format!("{}, outside the volume", in_words(point)), expected);
    }
    Ok(())
}
