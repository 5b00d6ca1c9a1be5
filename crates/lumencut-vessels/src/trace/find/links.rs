//! Links from the open ends of tracks to other tracks, so that they become trees.

use crate::trace::find::scan::Scan;
use crate::trace::find::track::Track;
use lumencut_core::error::Result;
use lumencut_core::stop::Stop;

/// A link from a point of one track to a point of another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The track it comes from, and the number of its point there.
    pub from: [usize; 2],
    /// The track that it leads to, and the number of its point there.
    pub to: [usize; 2],
    /// What it costs (mm).
    pub cost: f64,
}

/// The links between tracks.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn between(_scan: &Scan, _tracks: &[Track], _stop: Stop) -> Result<Vec<Link>> {
    Ok(Vec::new())
}
