//! Computes cut surfaces through the hierarchy and by brute force.

use lumencut_core::brute_force;
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::math::lanes::Isa;
use lumencut_core::pipeline::{CpuRenderer, Images, Request};
use lumencut_core::scene::{LeveledTree, Scene};
use lumencut_core::settings::Settings;
use lumencut_core::stages::Stage;
use lumencut_core::stages::depth::DepthImages;
use lumencut_core::vessel_tree::VesselTree;

pub fn by_hierarchy(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    let scene = Scene::default().with_tree(tree.clone());
    CpuRenderer::default().render(&scene, &Request::new(camera, settings)).unwrap()
}

pub fn by_brute_force(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    let (renderer, request) =
        (projected(tree, camera, settings, Isa::widest()), Request::new(camera, settings));
    let pass = renderer.pass(&request);
    let pixels = pass.work.pixels();
    // These negative values would remain in pixels that brute force skips, and so reveal them.
    let (mut distance, mut depth, mut vessel) = (vec![-1.0; pixels], vec![-1.0; pixels], vec![-1; pixels]);
    brute_force::distance(&pass.work, &pass.surface, &mut distance).unwrap();
    let (depth_image, vessel_image) = (&mut depth, &mut vessel);
    let written = DepthImages {
        depth: depth_image,
        vessel: vessel_image,
        sheet: &mut [],
        blend: &mut [],
        foot: &mut [],
    };
    brute_force::depth(&pass.work, &pass.surface, &distance, written).unwrap();
    let mut images = Images { unfiltered_depth: depth, vessel, ..Images::default() };
    if settings.depth_filter {
        pass.run(Stage::DepthFilter, &mut images).unwrap();
        images.unfiltered_depth = images.depth;
    }
    let geometry = Geometry::Orthographic { camera: *camera, depth: images.unfiltered_depth };
    Frame { vessel: images.vessel, distance, ..Frame::of(geometry) }
}

/// A renderer with a projected tree, whose stages can be run separately.
pub fn projected(tree: &VesselTree, camera: &Camera, settings: &Settings, isa: Isa) -> CpuRenderer {
    let mut renderer = CpuRenderer::new(isa);
    renderer.prepare(&LeveledTree::new(tree.clone()), settings);
    renderer.project(camera, settings);
    renderer
}
