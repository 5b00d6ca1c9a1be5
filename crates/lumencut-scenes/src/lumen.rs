//! Computes the lumen from its definition, in f64 and without code of the product, as the reference for images.

use glam::{DVec2, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::vessel_tree::{Vessel, VesselTree};

/// The depth (mm) of the nearest lumen at view (x, y): the smallest one of the pieces whose distance is at most
/// their radius.
pub fn nearest_lumen(scene: &VesselTree, camera: &Camera, x: f64, y: f64) -> Option<f64> {
    lumen_within(scene, camera, [x, y], 0.0)
}

/// The depth of [`nearest_lumen`]; `None` if rounding of the radii could change it.
pub fn certain_lumen(scene: &VesselTree, camera: &Camera, x: f64, y: f64) -> Option<f64> {
    const ROUNDING: f64 = 1e-3;
    let [wide, narrow] = [ROUNDING, -ROUNDING].map(|more| lumen_within(scene, camera, [x, y], more));
    narrow.filter(|_| narrow == wide)
}

/// The depth of the nearest lumen if all radii were larger by `more` (mm).
fn lumen_within(scene: &VesselTree, camera: &Camera, at: [f64; 2], more: f64) -> Option<f64> {
    let lumens =
        scene.vessels().iter().filter_map(|vessel| lumen_of(vessel, camera, DVec2::from_array(at), more));
    lumens.min_by(f64::total_cmp)
}

fn lumen_of(vessel: &Vessel, camera: &Camera, at: DVec2, more: f64) -> Option<f64> {
    let points: Vec<DVec3> = vessel.points().iter().map(|p| camera.view_from_world(*p)).collect();
    let to = |i: usize| at - points[i].truncate();
    let edge = |i: usize| (points[i + 1] - points[i]).truncate();
    let last = points.len() - 1;
    let radius = |i: usize| vessel.radius_or_zero(i) + more;
    let wedges = (0..=last).filter(|i| {
        let is_after = *i == 0 || to(*i).dot(edge(*i - 1)) >= 0.0;
        let is_before = *i == last || to(*i).dot(edge(*i)) <= 0.0;
        is_after && is_before && to(*i).length() <= radius(*i)
    });
    let stripes = (0..last).filter_map(|i| {
        let t = to(i).dot(edge(i)) / edge(i).length_squared();
        let distance = (to(i) - t * edge(i)).length();
        let is_lumen = (0.0..=1.0).contains(&t) && distance <= radius(i) * (1.0 - t) + radius(i + 1) * t;
        is_lumen.then(|| points[i].z + t * (points[i + 1].z - points[i].z))
    });
    wedges.map(|i| points[i].z).chain(stripes).min_by(f64::total_cmp)
}
