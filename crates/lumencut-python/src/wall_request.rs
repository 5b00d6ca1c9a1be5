//! The level of walls as Python asks for it.

use lumencut::measure::wall_level::WallRequest;

/// The level of walls from a level and its standard deviation; one of 0 says that there is no wall.
pub(crate) fn wall_request(wall: Option<[f64; 2]>) -> WallRequest {
    match wall {
        None => WallRequest::Automatic,
        Some([_, 0.0]) => WallRequest::Off,
        Some(level) => WallRequest::Level(level),
    }
}
