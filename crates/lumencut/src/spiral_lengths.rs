//! How fine and how wide a spiral CPR is where nobody says it: by the radii of its vessel.

use std::f64::consts::PI;

/// How far beyond the largest radius the windings reach: a share of it, and a length (mm).
const BEYOND: (f64, f64) = (1.25, 2.0);

/// Neighbouring windings are this share of the usual radius apart.
const FINE: f64 = 0.25;

/// How far from a vessel the windings reach (mm), by its largest radius (mm).
pub fn spiral_reach(largest: f64) -> f64 {
    BEYOND.0 * largest + BEYOND.1
}

/// The room that a spiral CPR has.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    /// How far from the vessel the windings reach (mm).
    pub radius: f64,
    /// The side of a pixel (mm).
    pub pixel_spacing: f64,
    /// The most columns.
    pub columns: f64,
}

/// The distance of neighbouring windings (mm): a quarter of the usual radius of the vessel (mm), but no less than the smallest side
/// of a voxel (mm), and no less than what fits into the room, as a row is as long as its section's area divided by the pitch.
pub fn spiral_pitch(usual: f64, smallest_side: f64, room: Room) -> f64 {
    let lengths = [room.radius, room.pixel_spacing, room.columns];
    let is_room = lengths.iter().all(|length| *length > 0.0 && length.is_finite());
    let fits =
        if is_room { PI * room.radius * room.radius / (room.columns * room.pixel_spacing) } else { 0.0 };
    smallest_side.max(FINE * usual).max(fits)
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
        // What is no room bounds nothing: making the layout refuses it.
        assert_eq!(spiral_pitch(4.0, 0.4, Room { pixel_spacing: 0.0, ..room }), 1.0);
        assert_eq!(spiral_reach(4.0), 7.0);
    }
}
