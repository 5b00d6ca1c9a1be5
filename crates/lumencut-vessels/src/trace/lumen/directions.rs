//! Directions that cover half a sphere, and the principal axis of weighted directions.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

const ROUNDS: usize = 50;

/// Unit vectors that the golden angle spreads evenly over half a sphere.
pub(crate) fn half_sphere(count: u32) -> impl Iterator<Item = DVec3> {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |n| {
        let z = (f64::from(n) + 0.5) / f64::from(count);
        let (sine, cosine) = (golden * f64::from(n)).sin_cos();
        let flat = (1.0 - z * z).sqrt();
        DVec3::new(flat * cosine, flat * sine, z)
    })
}

/// Principal axis of weighted directions, by power iteration from `start`; None if all weights are 0.
pub(crate) fn longest_axis(weighted: impl Iterator<Item = (DVec3, f64)>, start: DVec3) -> Option<DVec3> {
    let spread = weighted.fold(DMat3::ZERO, |sum, (way, weight)| {
        sum + DMat3::from_cols(way * way.x, way * way.y, way * way.z) * weight
    });
    (0..ROUNDS).try_fold(start, |axis, _| (spread * axis).try_normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_is_the_direction_in_which_most_weight_lies() {
        let axis = DVec3::new(0.48, 0.6, 0.64);
        let weighted = || half_sphere(200).map(|way| (way, way.dot(axis).powi(8)));
        let found = longest_axis(weighted(), DVec3::X).expect("weights");
        assert!(found.dot(axis).abs() > 0.999, "{found}");
        assert_eq!(longest_axis(weighted().map(|(way, _)| (way, 0.0)), DVec3::X), None);
    }

    #[test]
    fn the_directions_are_unit_vectors_and_lie_on_all_sides() {
        let mean = half_sphere(200).sum::<DVec3>() / 200.0;
        assert!(half_sphere(200).all(|way| way.is_normalized()));
        // Points spread evenly over a half sphere have their mean half a radius above its centre.
        assert!(mean.distance(DVec3::Z / 2.0) < 0.02, "{mean}");
    }
}
