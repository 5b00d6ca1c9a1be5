//! Scenes and views that several tests share.
#![allow(dead_code, clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::brute_force;
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::math::lanes::Isa;
use lumencut_core::pipeline::Renderer;
use lumencut_core::settings::Settings;
use lumencut_core::stages::View;
use lumencut_core::vessel_tree::{Vessel, VesselTree};

/// Settings whose depth is the winner's own: no filter.
pub fn plain() -> Settings {
    Settings { depth_filter: false, ..Settings::default() }
}

pub fn view(direction: [f64; 3], size: [usize; 2], pixel_spacing: f64) -> Camera {
    let direction = DVec3::from_array(direction);
    let up = if direction.cross(DVec3::Z).length() < 1e-3 { DVec3::Y } else { DVec3::Z };
    Camera::new(DVec3::ZERO, direction, up, size, pixel_spacing).unwrap()
}

pub fn vessel(points: &[[f64; 3]], radius: f64) -> Vessel {
    let points: Vec<DVec3> = points.iter().map(|p| DVec3::from_array(*p)).collect();
    let radii = vec![radius; points.len()];
    Vessel::new(points, Some(radii)).unwrap()
}

pub fn tree(vessels: Vec<Vessel>) -> VesselTree {
    VesselTree::new(vessels).unwrap()
}

/// A trefoil knot of half size about 60 mm.
pub fn trefoil(points: usize) -> VesselTree {
    let knot = |i: usize| {
        let t = i as f64 / points as f64 * std::f64::consts::TAU;
        let (x, y) = (t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos());
        [20.0 * x, -20.0 * (3.0 * t).sin(), 20.0 * y]
    };
    tree(vec![vessel(&(0..=points).map(knot).collect::<Vec<_>>(), 4.0)])
}

/// Depth, vessel and distance through the hierarchy.
pub fn by_hierarchy(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    Renderer::new(tree.clone()).cut_surface(camera, settings, &|| false).unwrap()
}

/// Depth, vessel and distance against every piece.
pub fn by_brute_force(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    let mut renderer = Renderer::new(tree.clone());
    let mut frame = by_hierarchy(tree, camera, settings);
    let surface = renderer.project(camera, settings);
    let view = View { camera, isa: Isa::widest(), stop: &|| false };
    frame.distance.fill(-1.0);
    frame.depth.fill(-1.0);
    frame.vessel.fill(-1);
    brute_force::distance(&view, surface.finest(), &mut frame.distance).unwrap();
    brute_force::depth(&view, &surface, &frame.distance, &mut frame.depth, &mut frame.vessel).unwrap();
    frame
}

/// The number of pixels that differ in any bit of depth, vessel or distance.
pub fn differences(a: &Frame, b: &Frame) -> usize {
    let bits = |v: &[f32], p: usize| v[p].to_bits();
    let differ = |p: &usize| {
        bits(&a.depth, *p) != bits(&b.depth, *p)
            || bits(&a.distance, *p) != bits(&b.distance, *p)
            || a.vessel[*p] != b.vessel[*p]
    };
    assert_eq!(a.depth.len(), b.depth.len());
    (0..a.depth.len()).filter(differ).count()
}

/// The depth at the pixel whose centre is nearest to view (x, y).
pub fn at(frame: &Frame, values: &[f32], x: f64, y: f64) -> f32 {
    values[pixel(frame, x, y)]
}

/// The pixel whose centre is nearest to view (x, y).
pub fn pixel(frame: &Frame, x: f64, y: f64) -> usize {
    let ([width, height], s) = (frame.camera.size(), frame.camera.pixel_spacing());
    let i = (x / s + width as f64 / 2.0 - 0.5).round() as usize;
    let j = (height as f64 / 2.0 - 0.5 - y / s).round() as usize;
    j * width + i
}
