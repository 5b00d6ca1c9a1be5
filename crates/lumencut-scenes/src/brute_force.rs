//! Cut surfaces through the hierarchy, and against every piece.

use lumencut_core::brute_force;
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::Renderer;
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::VesselTree;

use crate::views::on_cpu;

/// Depth, vessel and distance through the hierarchy.
pub fn by_hierarchy(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    Renderer::new(tree.clone()).cut_surface(camera, settings, &|| false).unwrap()
}

/// Depth, vessel and distance against every piece.
pub fn by_brute_force(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    let mut renderer = Renderer::new(tree.clone());
    let mut frame = by_hierarchy(tree, camera, settings);
    let surface = renderer.project(camera, settings);
    let view = on_cpu(camera);
    // What the hierarchy found is no longer there: a pixel that brute force leaves out is seen.
    frame.distance.fill(-1.0);
    frame.depth.fill(-1.0);
    frame.vessel.fill(-1);
    brute_force::distance(&view, surface.finest(), &mut frame.distance).unwrap();
    brute_force::depth(&view, &surface, &frame.distance, &mut frame.depth, &mut frame.vessel).unwrap();
    frame
}
