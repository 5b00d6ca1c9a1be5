//! Degenerate scenes cause no panic and no invalid depth, and have the same bits however they are computed.
#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::math::lanes::Isa;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_scenes::brute_force::{by_brute_force, by_hierarchy};
use lumencut_scenes::compare::different_pixels;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::settings::{paper_unfiltered, unfiltered};
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::{front, pixel, view};

const DIRECTIONS: [[f64; 3]; 4] = [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 2.0, 3.0], [1e-5, 1e-5, 1.0]];

/// Rules without the depth filter (default, by cost only, many close levels, the paper's), and the default with it.
fn rules() -> [Settings; 5] {
    [
        unfiltered(),
        Settings { lumen_first: false, cost_weight: 1.0, ..unfiltered() },
        Settings { levels: 15, level_distance: 0.5, unknown_radius: 0.0, ..unfiltered() },
        paper_unfiltered(),
        Settings::default(),
    ]
}

fn rendered(tree: &VesselTree, camera: &Camera, settings: &Settings, isa: Isa) -> Frame {
    let scene = Scene::default().with_tree(tree.clone());
    CpuRenderer::new(isa).render(&scene, &Request::new(camera, settings)).unwrap()
}

/// Depths are numbers within the depth range of the tree.
fn assert_depths_of_the_tree(tree: &VesselTree, camera: &Camera, frame: &Frame) {
    let depths = tree.vessels().iter().flat_map(|v| v.points()).map(|p| camera.view_from_world(*p).z);
    let [low, high] = depths.fold([f64::MAX, f64::MIN], |[low, high], z| [low.min(z), high.max(z)]);
    let rounding = 1e-5 * (1.0 + high.abs().max(low.abs()));
    let range = low - rounding..=high + rounding;
    assert!(frame.depth().iter().all(|z| range.contains(&f64::from(*z))), "depths outside {range:?}");
    let vessels = 0..tree.vessels().len() as i32;
    assert!(frame.vessel.iter().all(|id| vessels.contains(id)));
    assert!(frame.distance.iter().all(|d| d.is_finite() && *d >= 0.0));
}

/// Asserts that the view equals brute force with every instruction set and number of threads.
fn assert_sound_in(tree: &VesselTree, camera: &Camera, settings: &Settings) {
    let found = by_hierarchy(tree, camera, settings);
    assert_depths_of_the_tree(tree, camera, &found);
    let what = format!("along {:?} with {settings:?}", camera.direction());
    assert_eq!(different_pixels(&found, &by_brute_force(tree, camera, settings)), 0, "brute force {what}");
    for isa in Isa::available() {
        assert_eq!(different_pixels(&found, &rendered(tree, camera, settings, isa)), 0, "{isa:?} {what}");
    }
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let few = pool.install(|| by_hierarchy(tree, camera, settings));
        assert_eq!(different_pixels(&found, &few), 0, "{threads} threads {what}");
    }
}

fn assert_sound(tree: &VesselTree, size: [usize; 2], spacing: f64) {
    for direction in DIRECTIONS {
        for settings in rules() {
            assert_sound_in(tree, &view(direction, size, spacing), &settings);
        }
    }
}

fn without_radii(tree: &VesselTree) -> VesselTree {
    let bare = |v: &Vessel| Vessel::new(v.points().to_vec(), None).unwrap();
    VesselTree::new(tree.vessels().iter().map(bare).collect()).unwrap()
}

fn ring(radius: f64, points: usize, lumen: f64) -> Vessel {
    let place = |i: usize| {
        let t = (i % points) as f64 / points as f64 * TAU;
        [radius * t.cos(), 0.3 * radius * t.sin(), radius * t.sin()]
    };
    vessel(&(0..=points).map(place).collect::<Vec<_>>(), lumen)
}

#[test]
fn vessels_without_radii() {
    let known = random_tree(81, 9, 40, 2.0, 50.0).unwrap();
    let bare = without_radii(&known);
    assert_sound(&bare, [56, 40], 2.1);
    let half = known.vessels().iter().zip(bare.vessels()).enumerate();
    assert_sound(
        &tree(half.map(|(n, (k, b))| if n % 2 == 0 { k } else { b }.clone()).collect()),
        [56, 40],
        2.1,
    );
}

#[test]
fn radii_larger_than_the_bend() {
    let hairpin =
        vessel(&[[-30., 0., 0.], [10., 4., 0.], [12., 5., 1.], [10., 6., 2.], [-30., 10., 2.]], 15.0);
    assert_sound(&tree(vec![hairpin, ring(5.0, 40, 20.0)]), [56, 40], 2.0);
    // The lumen is wider than the view, so every pixel lies in it, also far beyond the ends.
    assert_sound(&tree(vec![ring(20.0, 60, 1e6), ring(9.0, 9, 1e5)]), [40, 40], 2.0);
}

#[test]
fn of_coincident_vessels_the_first_wins_everywhere() {
    let once = random_tree(82, 4, 30, 2.0, 50.0).unwrap();
    let thrice: Vec<_> = (0..3).flat_map(|_| once.vessels().iter().cloned()).collect();
    let thrice = tree(thrice);
    assert_sound(&thrice, [56, 40], 2.0);
    for settings in rules() {
        let camera = view([1.0, 2.0, 3.0], [56, 40], 2.0);
        let [all, single] = [&thrice, &once].map(|tree| by_hierarchy(tree, &camera, &settings));
        assert_eq!(different_pixels(&all, &single), 0);
    }
}

#[test]
fn a_vessel_wholly_within_the_lumen_of_another() {
    let tube =
        |depth: f64, radius: f64| vessel(&[[-40., depth, 0.], [0., depth, 0.], [40., depth, 0.]], radius);
    let camera = front([40, 60], 0.5);
    for (depth, expected) in [(-5.0, [1, 1, 0, 0]), (5.0, [0; 4]), (0.0, [0; 4])] {
        let scene = tree(vec![tube(0.0, 10.0), tube(depth, 2.0)]);
        let frame = by_hierarchy(&scene, &camera, &unfiltered());
        // The inner lumen wins if it is nearer; its wall ranks after the outer lumen.
        assert_eq!([0.25, 1.75, 2.25, 9.75].map(|y| frame.vessel[pixel(&frame, 0.25, y)]), expected);
        assert_sound(&scene, [56, 40], 2.0);
    }
}

#[test]
fn a_thousand_vessels_that_share_a_point() {
    let spoke = |n: usize| {
        let (turn, rise) = (n as f64 * 2.399_963, n as f64 / 500.0 - 1.0);
        let flat = (1.0 - rise * rise).sqrt();
        let end = DVec3::new(flat * turn.cos(), flat * turn.sin(), rise) * 40.0;
        vessel(&[[0.0; 3], (end * 0.5).to_array(), end.to_array()], 1.5)
    };
    let star = tree((0..1000).map(spoke).collect());
    for settings in rules() {
        assert_sound_in(&star, &view([1.0, 2.0, 3.0], [40, 32], 2.5), &settings);
    }
}

#[test]
fn ten_thousand_vessels() {
    let scene = random_tree(83, 10_000, 8, 3.0, 100.0).unwrap();
    for settings in [unfiltered(), Settings::default()] {
        assert_sound_in(&scene, &view([1.0, 0.2, 0.1], [32, 24], 6.0), &settings);
    }
}

#[test]
fn images_of_one_pixel_and_of_one_row() {
    let scene = random_tree(84, 6, 30, 2.0, 40.0).unwrap();
    for size in [[1, 1], [1, 9], [9, 1]] {
        for spacing in [1e-3, 1.0, 1e4] {
            assert_sound(&scene, size, spacing);
        }
    }
}

#[test]
fn vessels_of_two_points() {
    let pairs =
        [[[-30., 0., 0.], [30., 9., 9.]], [[5., -20., 5.], [5., 20., 5.]], [[0., 0., 20.], [0., 0., -20.]]];
    assert_sound(&tree(pairs.iter().map(|points| vessel(points, 3.0)).collect()), [56, 40], 1.5);
    assert_sound(&tree(vec![vessel(&pairs[0], 0.0)]), [56, 40], 1.5);
}

#[test]
fn vessels_whose_levels_collapse_to_one_point() {
    assert_sound(&tree(vec![ring(20.0, 50, 2.0)]), [56, 40], 2.0);
    let small = tree(vec![ring(20.0, 3, 2.0), ring(1e-3, 20, 0.5), ring(1e-5, 20, 0.5)]);
    assert_sound(&small, [56, 40], 2.0);
}

#[test]
fn vessels_whose_points_are_all_the_same() {
    let point = vessel(&[[3., 4., 5.]; 7], 2.0);
    assert_sound(&tree(vec![point.clone()]), [56, 40], 1.0);
    let doubled =
        vessel(&[[-9., -9., 0.], [-9., -9., 0.], [9., -30., 5.], [9., -30., 5.], [9., 30., 5.]], 1.0);
    assert_sound(&tree(vec![doubled, point]), [56, 40], 1.0);
}

/// A tree with coordinates of about 50 mm, scaled and shifted.
fn moved(tree: &VesselTree, scale: f64, shift: DVec3) -> VesselTree {
    let moved = |v: &Vessel| {
        let points = v.points().iter().map(|p| *p * scale + shift).collect();
        Vessel::new(points, v.radius().map(|radii| radii.iter().map(|r| r * scale).collect())).unwrap()
    };
    VesselTree::new(tree.vessels().iter().map(moved).collect()).unwrap()
}

#[test]
fn huge_and_tiny_vessels_far_from_the_origin() {
    let scene = random_tree(85, 6, 30, 2.0, 50.0).unwrap();
    for (scale, shift) in [(1e-4, 0.0), (1e-2, 300.0), (100.0, 5e3), (3e3, 0.0), (1.0, 9e5)] {
        let (scene, shift) = (moved(&scene, scale, DVec3::splat(shift)), DVec3::splat(shift));
        for direction in DIRECTIONS.map(DVec3::from_array) {
            let camera =
                Camera::new(shift, direction, DVec3::new(0.6, 0.8, 0.0), [40, 32], 3.0 * scale).unwrap();
            rules().iter().for_each(|settings| assert_sound_in(&scene, &camera, settings));
        }
    }
}
