//! Views of a turn on the GPU, which follow the view before as on the CPU.

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::steady::Before;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_scenes::compare::assert_equal;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::views::view;

use super::shared;
use crate::renderer::GpuRenderer;

#[test]
fn a_view_follows_the_view_before_as_on_the_cpu() {
    let Some(device) = shared() else { return };
    let scene = Scene::default().with_tree(random_tree(71, 12, 50, 2.0, 50.0).unwrap());
    let first = view([0.3, 1.0, 0.2], [160, 120], 0.7);
    let direction = first.direction() + DVec3::new(0.02, 0.0, 0.01);
    let next = Camera::new(first.center(), direction, first.up(), [150, 110], 0.75).unwrap();
    let images = ImageSet::of(&[Image::Depth, Image::Vessel]);
    let mut gpu = GpuRenderer::new(device.clone());
    for paper in [false, true] {
        for depth_filter in [true, false] {
            let rules = if paper { Settings::paper() } else { Settings::default() };
            let settings = Settings { turning_limit: Some(4.0), depth_filter, ..rules };
            let still = Request { images, ..Request::new(&first, &settings) };
            let depth = CpuRenderer::default().render(&scene, &still).unwrap().depth().to_vec();
            let before = Some(Before { camera: &first, depth: &depth });
            let turned = Request { images, before, ..Request::new(&next, &settings) };
            let expected = CpuRenderer::default().render(&scene, &turned).unwrap();
            let alone = CpuRenderer::default().render(&scene, &Request { before: None, ..turned }).unwrap();
            assert_ne!(expected.depth(), alone.depth());
            assert_equal(&pollster::block_on(gpu.render(&scene, &turned)).unwrap(), &expected);
        }
    }
}
