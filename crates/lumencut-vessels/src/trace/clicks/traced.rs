//! What tracing gives back of one vessel.

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;

/// A centerline between clicks.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// Its points, radii and confidence.
    pub line: Centerline,
    /// Which points lie on a stretch without lumen that was bridged.
    pub bridged: Vec<bool>,
    /// The first and the last click.
    pub ends: [DVec3; 2],
}
