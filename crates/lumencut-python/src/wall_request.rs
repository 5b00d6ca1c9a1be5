//! The wall level as Python requests it.

use lumencut::measure::wall_level::WallRequest;

/// The request for a level and its standard deviation; level 0 means no wall.
pub(crate) fn wall_request(wall: Option<[f64; 2]>) -> WallRequest {
    match wall {
        None => WallRequest::Automatic,
        Some([_, 0.0]) => WallRequest::Off,
        Some(level) => WallRequest::Level(level),
    }
}
