//! Results do not depend on instruction set and threads; rendering can be stopped; and a further view
//! allocates nothing of the size of tree or volume.
#![allow(clippy::unwrap_used)]

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DVec3};
use lumencut_core::error::ErrorKind;
use lumencut_core::frame::Frame;
use lumencut_core::math::lanes::Isa;
use lumencut_core::math::leaps::LEAPS;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::{LeveledTree, Scene};
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::compare::different_pixels;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::views::view;

fn scene() -> (VesselTree, Vec<i16>, DAffine3) {
    let voxels = (0..50usize.pow(3)).map(|n| (n * 7919 % 2000) as i16 - 500).collect();
    let affine = DAffine3::from_scale(DVec3::splat(3.0)) * DAffine3::from_translation(DVec3::splat(-25.0));
    (random_tree(11, 20, 50, 2.0, 70.0).unwrap(), voxels, affine)
}

/// The default rules, the paper's, and the level choice `own` by cost only with many levels.
fn rules() -> [Settings; 3] {
    let by_cost = Settings { lumen_first: false, levels: 15, level_distance: 1.0, ..Settings::default() };
    [Settings::default(), Settings::paper(), by_cost]
}

fn render(isa: Isa, settings: &Settings) -> Frame {
    let (tree, voxels, affine) = scene();
    let volume = Volume::new(Voxels::I16(&voxels), [50; 3], [1, 50, 2500], affine).unwrap();
    let camera = view([1.0, 0.4, -0.3], [150, 101], 1.1);
    let scene = Scene::new(volume, tree);
    CpuRenderer::new(isa).render(&scene, &Request::new(&camera, settings)).unwrap()
}

fn assert_same(a: &Frame, b: &Frame, what: &str) {
    assert_eq!(different_pixels(a, b), 0, "{what}");
    assert_eq!(a.image, b.image, "{what}");
    assert!(a.value.iter().zip(&b.value).all(|(a, b)| a.to_bits() == b.to_bits()), "{what}");
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    for settings in rules() {
        let baseline = render(Isa::Baseline, &settings);
        for isa in Isa::available() {
            assert_same(&baseline, &render(isa, &settings), &format!("{isa:?}"));
        }
    }
}

/// The bit patterns of sheets, leaps and strengths.
fn details(isa: Isa, settings: &Settings) -> (Vec<[u32; 4]>, Vec<u32>, Vec<u32>) {
    let (camera, tree) = (view([1.0, 0.4, -0.3], [150, 101], 1.1), LeveledTree::new(scene().0));
    let found = CpuRenderer::new(isa).details(&tree, &Request::new(&camera, settings)).unwrap();
    let sheet = found.sheet.iter().map(|sheet| sheet.map(f32::to_bits)).collect();
    (sheet, found.leap, found.strength.iter().map(|strength| strength.to_bits()).collect())
}

#[test]
fn every_instruction_set_and_number_of_threads_gives_the_same_sheets_and_leaps() {
    for settings in rules() {
        let baseline = details(Isa::Baseline, &settings);
        assert!(baseline.1.iter().any(|leap| *leap & LEAPS != 0));
        for isa in Isa::available() {
            assert!(baseline == details(isa, &settings), "{isa:?}");
        }
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert!(baseline == pool.install(|| details(Isa::widest(), &settings)), "{threads} threads");
        }
    }
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    for settings in rules() {
        let many = render(Isa::widest(), &settings);
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let few = pool.install(|| render(Isa::widest(), &settings));
            assert_same(&many, &few, &format!("{threads} threads"));
        }
    }
}

#[test]
fn a_second_view_of_a_used_renderer_is_the_view_of_a_new_one() {
    let (tree, ..) = scene();
    let (first, second) = (view([0.0, 1.0, 0.0], [70, 70], 2.0), view([1.0, 0.0, 0.0], [40, 90], 1.0));
    let (used_scene, fresh_scene) =
        (Scene::default().with_tree(tree.clone()), Scene::default().with_tree(tree));
    let (nine, settings) = (Settings { levels: 9, ..Settings::default() }, Settings::default());
    let mut used = CpuRenderer::default();
    used.render(&used_scene, &Request::new(&first, &nine)).unwrap();
    let again = used.render(&used_scene, &Request::new(&second, &settings)).unwrap();
    let fresh = CpuRenderer::default().render(&fresh_scene, &Request::new(&second, &settings)).unwrap();
    assert_eq!(different_pixels(&again, &fresh), 0);
}

#[test]
fn a_rendering_stops_when_asked_and_the_renderer_goes_on() {
    let (tree, ..) = scene();
    let camera = view([0.0, 1.0, 0.0], [256, 256], 0.7);
    let (scene, settings) = (Scene::default().with_tree(tree), Settings::default());
    let (mut renderer, patient) = (CpuRenderer::default(), Request::new(&camera, &settings));
    let whole = renderer.render(&scene, &patient).unwrap();
    let asked = AtomicUsize::new(0);
    let stop = || asked.fetch_add(1, Ordering::Relaxed) >= 40;
    let error = renderer.render(&scene, &Request { stop: &stop, ..patient }).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Interrupted);
    let again = renderer.render(&scene, &patient).unwrap();
    assert_eq!(different_pixels(&whole, &again), 0);
}
