//! Outlines in the plane of a section: corners in the order of their direction.

use glam::DVec2;

use crate::measure::section::rays::{RAYS, direction};

/// Area (mm²) and centroid; None for an outline without area.
pub(crate) fn area_and_middle(corners: &[DVec2]) -> Option<(f64, DVec2)> {
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for (n, a) in corners.iter().enumerate() {
        let b = corners[(n + 1) % corners.len()];
        let triangle = 0.5 * a.perp_dot(b);
        area += triangle;
        moment += (*a + b) * (triangle / 3.0);
    }
    (area.abs() > f64::EPSILON).then(|| (area.abs(), moment / area))
}

/// Distance (mm) at which each ray from `center` leaves the outline for the last time; 0 if it does not meet it.
pub(crate) fn exits(corners: &[DVec2], center: DVec2) -> Vec<f64> {
    let exit = |ray: usize| {
        let towards = direction(ray);
        let met = |n: usize| {
            let a = corners[n] - center;
            let side = corners[(n + 1) % corners.len()] - corners[n];
            let across = towards.perp_dot(side);
            let (away, along) = (a.perp_dot(side) / across, a.perp_dot(towards) / across);
            (away > 0.0 && (0.0..1.0).contains(&along)).then_some(away)
        };
        (0..corners.len()).filter_map(met).fold(0.0, f64::max)
    };
    (0..RAYS).map(exit).collect()
}

/// The corners at these distances from `center`, one per ray.
pub(crate) fn corners_at(center: DVec2, radii: &[f64]) -> Vec<DVec2> {
    radii.iter().enumerate().map(|(ray, radius)| center + direction(ray) * *radius).collect()
}

/// Area as a fraction of the area of the convex hull: 1 without dents.
pub(crate) fn solidity(corners: &[DVec2]) -> f64 {
    area_and_middle(corners).map_or(0.0, |(area, _)| area) / hull_area(corners)
}

/// Area of the convex hull of some points (mm²).
pub(crate) fn hull_area(corners: &[DVec2]) -> f64 {
    let mut sorted = corners.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut hull: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = hull[..]
                && (b - a).perp_dot(*point - b) <= 0.0
            {
                hull.pop();
            }
            hull.push(*point);
        }
        hull.pop();
        hull
    };
    let hull = [half(&mut sorted.iter()), half(&mut sorted.iter().rev())].concat();
    area_and_middle(&hull).map_or(0.0, |(area, _)| area)
}
