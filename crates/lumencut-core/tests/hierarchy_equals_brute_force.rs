//! The hierarchy finds exactly what trying every piece finds.
#![allow(clippy::unwrap_used)]

use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::brute_force::{by_brute_force, by_hierarchy};
use lumencut_scenes::compare::different_pixels;
use lumencut_scenes::random::Random;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::settings::{paper_unfiltered, unfiltered};
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::view;

/// Directions along axes, oblique ones, and some so close to an axis that segments are nearly collinear.
const DIRECTIONS: [[f64; 3]; 8] = [
    [0.0, 1.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [1.0, 2.0, 3.0],
    [-3.0, 1.0, -0.5],
    [1e-5, 1e-5, 1.0],
    [-1.0, -1.0, 1.0],
];

/// Both rules for visibility and for levels, with and without lumen, with few and many levels, two weights.
fn rules() -> Vec<Settings> {
    let (own, paper) = (unfiltered(), paper_unfiltered());
    vec![
        own.clone(),
        paper.clone(),
        Settings { lumen_first: true, lumen_margin: 1.5, ..paper.clone() },
        Settings { preserve_lumen: false, levels: 3, ..paper.clone() },
        Settings { levels: 0, cost_weight: 100.0, ..paper.clone() },
        Settings { lumen_first: true, levels: 15, level_distance: 2.0, cost_weight: 0.0, ..paper },
        Settings { lumen_first: false, ..own.clone() },
        Settings { preserve_lumen: false, levels: 3, unknown_radius: 0.0, lumen_margin: 0.0, ..own.clone() },
        Settings { lumen_first: false, levels: 15, level_distance: 0.5, cost_weight: 1.0, ..own.clone() },
        Settings { levels: 15, level_distance: 0.5, cost_weight: 0.0, ..own },
    ]
}

fn assert_equal(tree: &VesselTree, size: [usize; 2], pixel_spacing: f64) {
    for direction in DIRECTIONS {
        let camera = view(direction, size, pixel_spacing);
        for settings in rules() {
            let differ = different_pixels(
                &by_hierarchy(tree, &camera, &settings),
                &by_brute_force(tree, &camera, &settings),
            );
            assert_eq!(differ, 0, "pixels differ from {direction:?} with {settings:?}");
        }
    }
}

#[test]
fn on_random_trees() {
    for (seed, vessels, segments) in [(1, 1, 1), (2, 3, 5), (3, 12, 60), (4, 60, 40)] {
        assert_equal(&random_tree(seed, vessels, segments, 2.0, 80.0).unwrap(), [120, 88], 1.7);
    }
}

#[test]
fn on_a_trefoil() {
    assert_equal(&trefoil(240), [128, 128], 1.2);
}

#[test]
fn on_vessels_with_collinear_runs() {
    let step = vessel(&[[-40., 0., -40.], [0., 0., -40.], [0., 0., 0.], [0., 0., 40.], [40., 0., 40.]], 3.0);
    let axis = vessel(&[[20., 9., -50.], [20., 9., 0.], [20., 9., 50.]], 2.0);
    let doubled = vessel(&[[-9., -9., 0.], [-9., -9., 0.], [9., -30., 5.], [9., -30., 5.]], 1.0);
    assert_equal(&tree(vec![step, axis, doubled]), [90, 90], 1.1);
}

#[test]
fn where_vessels_coincide_the_first_one_wins() {
    let twice = random_tree(5, 4, 30, 2.0, 60.0).unwrap();
    let vessels: Vec<_> = twice.vessels().iter().chain(twice.vessels()).cloned().collect();
    let tree = tree(vessels);
    assert_equal(&tree, [64, 64], 2.0);
    let frame = by_hierarchy(&tree, &view([1.0, 1.0, 1.0], [64, 64], 2.0), &unfiltered());
    assert!(frame.vessel.iter().all(|id| (0..4).contains(id)));
}

#[test]
fn on_images_of_any_size() {
    let tree = random_tree(6, 5, 30, 2.0, 50.0).unwrap();
    for size in [[1, 1], [1, 17], [17, 1], [16, 8], [17, 9], [15, 7], [257, 3]] {
        assert_equal(&tree, size, 0.9);
    }
}

#[test]
fn at_any_scale_and_far_from_the_origin() {
    let mut random = Random::new(9);
    for scale in [1e-3, 1.0, 1e3] {
        let shift = random.next_point() * 5e2 * scale;
        let moved = |v: &lumencut_core::vessel_tree::Vessel| {
            let points: Vec<[f64; 3]> = v.points().iter().map(|p| (*p * scale + shift).to_array()).collect();
            vessel(&points, 2.0 * scale)
        };
        let tree_of_mm = random_tree(7, 8, 40, 2.0, 50.0).unwrap();
        let tree = tree(tree_of_mm.vessels().iter().map(moved).collect());
        for settings in rules() {
            let camera = lumencut_core::camera::Camera::new(
                shift,
                glam::DVec3::new(0.3, 1.0, 0.1),
                glam::DVec3::Z,
                [60, 60],
                1.8 * scale,
            )
            .unwrap();
            let hierarchy = by_hierarchy(&tree, &camera, &settings);
            assert_eq!(different_pixels(&hierarchy, &by_brute_force(&tree, &camera, &settings)), 0);
        }
    }
}

#[test]
fn on_ten_thousand_vessels() {
    let tree = random_tree(8, 10_000, 2, 3.0, 100.0).unwrap();
    let camera = view([1.0, 0.2, 0.1], [96, 96], 2.2);
    for settings in &rules()[..2] {
        let hierarchy = by_hierarchy(&tree, &camera, settings);
        assert_eq!(different_pixels(&hierarchy, &by_brute_force(&tree, &camera, settings)), 0);
    }
}

/// A coil of 150 points within 90 mm of the origin.
fn coil() -> VesselTree {
    let point = |i: usize| {
        let t = i as f64 / 149.0;
        [90.0 * (3.0 * t + 6.0).sin(), 40.0 * (4.0 * t).cos(), 90.0 * (2.2 * t + 4.2).cos()]
    };
    tree(vec![vessel(&(0..150).map(point).collect::<Vec<_>>(), 3.0)])
}

#[test]
fn on_pixels_finer_than_the_rounding_of_the_nearest_point() {
    // Pixels of 0.02 to 0.07 mm at coordinates of 100 mm are as small as the roots of some rounding errors.
    for (size, pixel_spacing) in [([3072, 3072], 200.0 / 3072.0), ([8192, 256], 0.02), ([256, 8192], 0.02)] {
        let camera = view([0.0, 1.0, 0.0], size, pixel_spacing);
        let (hierarchy, brute) =
            (by_hierarchy(&coil(), &camera, &unfiltered()), by_brute_force(&coil(), &camera, &unfiltered()));
        assert_eq!(different_pixels(&hierarchy, &brute), 0, "{size:?}");
    }
}

#[test]
fn at_the_coarsest_pixels_a_camera_may_have() {
    let camera = view([0.0, 1.0, 0.0], [32_768, 16], 1e4);
    for settings in &rules()[..2] {
        let hierarchy = by_hierarchy(&coil(), &camera, settings);
        assert_eq!(different_pixels(&hierarchy, &by_brute_force(&coil(), &camera, settings)), 0);
    }
}
