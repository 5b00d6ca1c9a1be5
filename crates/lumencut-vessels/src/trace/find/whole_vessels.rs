//! From linked tracks to whole vessels, from the root outwards, in parts that are ranked.

use crate::trace::find::FindRequest;
use crate::trace::find::found::FoundVessel;
use crate::trace::find::links::Link;
use crate::trace::find::scan::Scan;
use crate::trace::find::track::Track;
use lumencut_core::error::Result;

/// The vessels of linked tracks.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn of(
    _scan: &Scan,
    _tracks: &[Track],
    _links: &[Link],
    _request: &FindRequest,
) -> Result<Vec<FoundVessel>> {
    Ok(Vec::new())
}
