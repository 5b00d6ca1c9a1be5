//! Converts the wall level that Python requests.

use lumencut::measure::wall::WallRequest;

/// Converts a wall level and its standard deviation; a standard deviation of 0 means that no walls are separated.
pub(crate) fn wall_request(wall: Option<[f64; 2]>) -> WallRequest {
    match wall {
        None => WallRequest::Automatic,
        Some([_, 0.0]) => WallRequest::Off,
        Some(level) => WallRequest::Level(level),
    }
}
