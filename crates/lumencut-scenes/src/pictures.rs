//! Renders frames of scenes.

use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::Volume;

/// A frame with all images of a view, computed on the CPU.
pub fn render(scene: &Scene, camera: &Camera, settings: &Settings, stop: Stop) -> Result<Frame> {
    CpuRenderer::default().render(scene, &Request { stop, ..Request::new(camera, settings) })
}

pub fn picture(volume: Volume, tree: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    render(&Scene::new(volume, tree.clone()), camera, settings, &|| false).unwrap()
}

/// Renders the context of a volume without vessels.
pub fn context_alone(volume: Volume, camera: &Camera, settings: &Settings, stop: Stop) -> Result<Frame> {
    render(&Scene::default().with_volume(volume), camera, settings, stop)
}

/// The depths of a frame, to be changed by the caller.
pub fn depth_of(frame: &mut Frame) -> &mut [f32] {
    match &mut frame.geometry {
        Geometry::Orthographic { depth, .. } => depth,
        Geometry::Curved(_) => &mut [],
    }
}
