//! The far rim compared with closed forms: on the farther side alone, and never on lumen or wall.
#![allow(clippy::unwrap_used)]

use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::math::leaps::{LUMEN, WALL};
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::{front, view};

const SIZE: [usize; 2] = [24, 60];
/// How much a pixel is darkened, the last of its shares.
const SHADE: usize = 3;

fn shown(scene: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    let scene = Scene::default().with_tree(scene.clone());
    let images = ImageSet::of(&[Image::Depth, Image::Leap, Image::Focus]);
    CpuRenderer::default().render(&scene, &Request { images, ..Request::new(camera, settings) }).unwrap()
}

#[test]
fn of_two_planes_the_farther_one_has_a_rim_that_ends_after_its_width() {
    // Surroundings of straight vessels are planes. The nearer one reaches 30 mm / (2 · 10) beyond the middle.
    let line = |height, depth| vessel(&[[-500.0, depth, height], [500.0, depth, height]], 2.0);
    let planes = tree(vec![line(20.0, 0.0), line(-20.0, 30.0)]);
    for (spacing, width) in [(1.0, 2.5), (0.3, 5.0), (0.1, 8.0)] {
        let settings = Settings { silhouette_reach: Some(1.0), ..Settings::default() };
        let frame = shown(&planes, &front(SIZE, spacing), &settings);
        let deep = |p: usize| frame.depth()[p] > 15.0;
        let border = (0..SIZE[1]).find(|j| deep(j * SIZE[0])).unwrap();
        for (p, share) in frame.focus.iter().enumerate() {
            let away = (p / SIZE[0]) as f32 - border as f32;
            let expected = if deep(p) { 0.3 * (1.0 - away / width).max(0.0) } else { 0.0 };
            assert!((share[SHADE] - expected).abs() < 1e-6, "{spacing} mm, {away}: {share:?}");
        }
    }
}

#[test]
fn lumen_and_wall_keep_their_grey_whatever_lies_around() {
    let scene = random_tree(71, 12, 50, 2.0, 50.0).unwrap();
    let camera = view([0.3, 1.0, 0.2], [160, 120], 0.7);
    // Without a reach, lines fade out right at the lumen, so only the tier of the key spares the wall.
    let settings = Settings { silhouette_reach: Some(0.0), far_rim: 1.0, ..Settings::default() };
    let frame = shown(&scene, &camera, &settings);
    let is_dark = |bits: u32| {
        let pixels = frame.leap.iter().zip(&frame.focus);
        pixels.filter(|(leap, share)| *leap & (LUMEN | WALL) == bits && share[SHADE] > 0.0).count()
    };
    assert!(is_dark(0) > 100, "{}", is_dark(0));
    assert_eq!([is_dark(LUMEN), is_dark(WALL)], [0; 2]);
    assert!(frame.leap.iter().any(|leap| leap & WALL != 0));
}

#[test]
fn without_lines_that_fade_out_there_is_no_rim() {
    let scene = random_tree(71, 12, 50, 2.0, 50.0).unwrap();
    let camera = view([0.3, 1.0, 0.2], [160, 120], 0.7);
    let some = Settings { silhouette_reach: Some(1.0), ..Settings::default() };
    for settings in [
        Settings { far_rim: 0.0, ..some.clone() },
        Settings { silhouettes: false, ..some.clone() },
        Settings { silhouette_reach: None, ..some.clone() },
        Settings { silhouette_reach: Some(1e5), ..some },
        Settings::paper(),
    ] {
        let frame = shown(&scene, &camera, &settings);
        assert!(frame.focus.iter().all(|share| share[SHADE] == 0.0));
    }
}
