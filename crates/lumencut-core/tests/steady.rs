//! Views of a turn that follow the view before: closed forms, and exact lumen and wall.
#![allow(clippy::unwrap_used)]

use glam::{DQuat, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::math::leaps::{LUMEN, WALL};
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::steady::Before;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::views::view;

const LIMIT: f64 = 4.0;

fn turned(camera: &Camera, degrees: f64) -> Camera {
    let turn = DQuat::from_axis_angle(camera.up(), degrees.to_radians());
    let direction: DVec3 = turn * camera.direction();
    Camera::new(camera.center(), direction, camera.up(), camera.size(), camera.pixel_spacing()).unwrap()
}

fn shown(scene: &Scene, camera: &Camera, settings: &Settings, before: Option<Before>) -> Frame {
    let images = ImageSet::of(&[Image::Depth, Image::Vessel, Image::Leap]);
    let request = Request { images, before, ..Request::new(camera, settings) };
    CpuRenderer::default().render(scene, &request).unwrap()
}

#[test]
fn a_turned_view_keeps_lumen_and_wall_and_changes_the_rest_slowly() {
    let scene = Scene::default().with_tree(random_tree(71, 12, 50, 2.0, 50.0).unwrap());
    let first = view([0.3, 1.0, 0.2], [160, 120], 0.7);
    let steady = Settings { turning_limit: Some(LIMIT), ..Settings::default() };
    for depth_filter in [true, false] {
        let steady = Settings { depth_filter, ..steady.clone() };
        let still = shown(&scene, &first, &steady, None);
        let next = turned(&first, 1.0);
        let plain = shown(&scene, &next, &steady, None);
        let before = Before { camera: &first, depth: still.depth() };
        let held = shown(&scene, &next, &steady, Some(before));
        let (mut inside, mut moved, mut jumps) = (0, 0, [0; 2]);
        for p in 0..held.depth().len() {
            let (z, was, alone) = (held.depth()[p], still.depth()[p], plain.depth()[p]);
            if plain.leap[p] & (LUMEN | WALL) != 0 {
                assert_eq!((z.to_bits(), held.vessel[p]), (alone.to_bits(), plain.vessel[p]), "{p}");
                inside += 1;
            } else {
                moved += usize::from(z != alone);
                // It lies between the view before and the still view.
                assert!(
                    (was.min(alone) - 1e-3..=was.max(alone) + 1e-3).contains(&z),
                    "{p}: {was} {z} {alone}"
                );
            }
            jumps[0] += usize::from((alone - was).abs() > LIMIT as f32 + 0.01);
            jumps[1] += usize::from((z - was).abs() > LIMIT as f32 + 0.01);
        }
        assert!(inside > 500 && moved > 200, "{inside} {moved}");
        assert!(4 * jumps[1] < 3 * jumps[0], "{jumps:?}");
    }
}

#[test]
fn without_limit_or_view_before_a_view_depends_on_the_camera_alone() {
    let scene = Scene::default().with_tree(random_tree(5, 8, 40, 2.0, 40.0).unwrap());
    let (first, settings) = (view([0.3, 1.0, 0.2], [80, 60], 1.0), Settings::default());
    let next = turned(&first, 1.0);
    let plain = shown(&scene, &next, &settings, None);
    let still = shown(&scene, &first, &settings, None);
    let before = Before { camera: &first, depth: still.depth() };
    assert_eq!(shown(&scene, &next, &settings, Some(before)).depth(), plain.depth());
    let steady = Settings { turning_limit: Some(LIMIT), ..settings };
    assert_eq!(shown(&scene, &next, &steady, None).depth(), plain.depth());
    let short = Before { camera: &first, depth: &[0.0; 7] };
    assert_eq!(shown(&scene, &next, &steady, Some(short)).depth(), plain.depth());
    // A half turn allows any change, up to rounding.
    let far = turned(&first, 180.0);
    let [held, alone] = [Some(before), None].map(|before| shown(&scene, &far, &steady, before));
    assert!(held.depth().iter().zip(alone.depth()).all(|(a, b)| (a - b).abs() < 1e-4));
}

#[test]
fn a_moved_view_finds_the_depth_of_the_view_before_at_its_own_pixels() {
    let camera = view([0.0, 1.0, 0.0], [4, 3], 2.0);
    let depth: Vec<f32> = (0..12).map(|n| n as f32).collect();
    let before = Before { camera: &camera, depth: &depth };
    assert_eq!(before.seen_by(&camera), depth);
    let place = camera.center() + 2.0 * camera.right() - 2.0 * camera.up() + 5.0 * camera.direction();
    let moved = Camera::new(place, camera.direction(), camera.up(), [4, 3], 2.0).unwrap();
    let expected = [5, 6, 7, 7, 9, 10, 11, 11, 9, 10, 11, 11].map(|n| n as f32 - 5.0);
    assert_eq!(before.seen_by(&moved), expected);
    let finer = Camera::new(camera.center(), camera.direction(), camera.up(), [8, 6], 1.0).unwrap();
    let expected: Vec<f32> = (0..48).map(|n| (n / 8 / 2 * 4 + n % 8 / 2) as f32).collect();
    assert_eq!(before.seen_by(&finer), expected);
}
