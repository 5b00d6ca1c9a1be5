//! Computes the default pitch and reach of a spiral CPR from the radii of the vessel.

use std::f64::consts::PI;

/// How far the windings reach: this factor times the largest radius, plus this margin (mm).
const REACH_FACTOR_AND_MARGIN: (f64, f64) = (1.25, 2.0);

/// The pitch, as a fraction of the usual radius.
const PITCH_RADII: f64 = 0.25;

/// How far the windings reach (mm), for a largest radius (mm).
pub fn spiral_reach(largest: f64) -> f64 {
    REACH_FACTOR_AND_MARGIN.0 * largest + REACH_FACTOR_AND_MARGIN.1
}

/// The space available to a spiral CPR.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    /// How far the windings reach (mm).
    pub radius: f64,
    /// Pixel side (mm).
    pub pixel_spacing: f64,
    /// Largest number of columns.
    pub columns: f64,
}

/// The pitch (mm): a quarter of the usual radius (mm), but at least the smallest voxel side (mm). It is larger if rows, whose
/// length is section area / pitch, would be wider than the picture.
pub fn spiral_pitch(usual: f64, smallest_side: f64, room: Room) -> f64 {
    let lengths = [room.radius, room.pixel_spacing, room.columns];
    let is_room = lengths.iter().all(|length| *length > 0.0 && length.is_finite());
    let fits =
        if is_room { PI * room.radius * room.radius / (room.columns * room.pixel_spacing) } else { 0.0 };
    smallest_side.max(PITCH_RADII * usual).max(fits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pitch_is_the_coarsest_of_voxels_radius_and_room() {
        let room = Room { radius: 10.0, pixel_spacing: 0.5, columns: 1000.0 };
        assert_eq!(spiral_pitch(4.0, 0.4, room), 1.0);
        assert_eq!(spiral_pitch(4.0, 1.5, room), 1.5);
        let narrow = Room { columns: 100.0, ..room };
        assert!((spiral_pitch(4.0, 0.4, narrow) - 2.0 * PI).abs() < 1e-12);
        // Invalid pixel sides do not limit the pitch here; the layout rejects them.
        assert_eq!(spiral_pitch(4.0, 0.4, Room { pixel_spacing: 0.0, ..room }), 1.0);
        assert_eq!(spiral_reach(4.0), 7.0);
    }
}
