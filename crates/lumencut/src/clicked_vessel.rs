//! Decides whether a click selects a vessel, and at which place.

use glam::{DVec2, DVec3};
use lumencut_core::math::arc_length::point_at;
use lumencut_core::vessel_tree::Vessel;

use crate::vessel_views::radius_at;

/// A click selects a vessel up to this far outside its wall: in mm or in pixels, whichever is farther.
const CLICK_MARGIN_MM: f64 = 2.0;
const CLICK_MARGIN_PX: f64 = 4.0;

/// Whether a click selects the vessel: in its lumen or close to its wall. `pixel_spacing` is the pixel side (mm).
pub fn is_clicked(vessel: &Vessel, point: DVec3, pixel_spacing: f64) -> bool {
    let at = nearest_arc_length(vessel, point);
    let reach = CLICK_MARGIN_MM.max(CLICK_MARGIN_PX * pixel_spacing);
    point.distance(point_at(vessel.points(), vessel.arc_length(), at)) <= radius_at(vessel, at) + reach
}

/// The arc length (mm) of the place on a vessel that is nearest to a point.
pub fn nearest_arc_length(vessel: &Vessel, point: DVec3) -> f64 {
    let (points, along) = (vessel.points(), vessel.arc_length());
    let mut best = DVec2::new(f64::MAX, 0.0);
    for (i, ends) in points.windows(2).enumerate() {
        let way = ends[1] - ends[0];
        let t = ((point - ends[0]).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let distance = point.distance(ends[0] + way * t);
        if distance < best.x {
            best = DVec2::new(distance, along[i] + t * (along[i + 1] - along[i]));
        }
    }
    best.y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_click_in_a_lumen_or_a_little_beside_it_means_the_vessel() {
        let points = vec![DVec3::ZERO, DVec3::X * 10.0, DVec3::X * 30.0];
        let vessel = Vessel::new(points, Some(vec![3.0; 3])).expect("a vessel");
        let at = |y: f64| DVec3::new(12.0, y, 0.0);
        assert!((nearest_arc_length(&vessel, at(9.0)) - 12.0).abs() < 1e-9);
        assert!(is_clicked(&vessel, at(4.9), 0.1) && !is_clicked(&vessel, at(5.1), 0.1));
        assert!(is_clicked(&vessel, at(6.9), 1.0) && !is_clicked(&vessel, at(7.1), 1.0));
    }
}
