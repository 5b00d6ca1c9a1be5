//! A view that fits a vessel at every amount of uncurling.

use std::sync::Arc;

use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::uncurl::Uncurl;
use lumencut_core::vessel_tree::Vessel;

use crate::views::{fitted, spacing_for};

/// The fraction of the image that the vessel fills.
const FILLED_FRACTION: f64 = 0.9;

/// Number of sampled amounts from 0 to 1.
const SAMPLED_AMOUNTS: usize = 17;

/// The camera centred on a vessel that shows all of it at every amount of uncurling. Direction, up and size stay.
/// Fails with [`lumencut_core::error::ErrorKind::VesselTree`] for a vessel without length,
/// [`lumencut_core::error::ErrorKind::Settings`] for an invalid smoothing (mm).
pub fn fitted_uncurling(camera: &Camera, vessel: &Vessel, smoothing: f64) -> Result<Camera> {
    let path = Arc::new(CenterlinePath::new(vessel, smoothing)?);
    let middle = fitted(camera, vessel.points())?;
    let mut reach = [0.0f64; 2];
    for step in 0..SAMPLED_AMOUNTS {
        let amount = step as f64 / (SAMPLED_AMOUNTS - 1) as f64;
        let extent = Uncurl::new(Arc::clone(&path), middle, amount, None)?.extent();
        reach = [reach[0].max(extent.x), reach[1].max(extent.y)];
    }
    let spacing = spacing_for(&middle, reach.map(|side| 2.0 * side), FILLED_FRACTION);
    let made = Camera::new(middle.center(), middle.direction(), middle.up(), middle.size(), spacing)?;
    made.with_axes(middle.direction(), middle.right(), middle.up())
}

#[cfg(test)]
#[path = "tests/uncurling.rs"]
mod tests;
