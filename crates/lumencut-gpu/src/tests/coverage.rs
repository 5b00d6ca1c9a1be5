//! Every pixel is covered: at every level that a pixel uses, some piece covers it, on every GPU of this machine.

use std::sync::Arc;

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::pipeline::Request;
use lumencut_core::scene::Scene;
use lumencut_core::settings::{MAX_LEVELS, Settings};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::settings::{paper_unfiltered, unfiltered};
use lumencut_scenes::trees::tree;

use super::every_device;
use crate::renderer::GpuRenderer;

/// Depth of the trees (mm). An uncovered pixel gets depth 0 at a level; even with a small weight, this moves
/// the pixel's depth out of the tree's range.
const TREE_DEPTH: f64 = 2e4;
/// A bound on the rounding of depths as large as `TREE_DEPTH` (mm).
const ROUNDING: f64 = 0.05;

const DIRECTIONS: [[f64; 3]; 2] = [[0.0, 1.0, 0.0], [0.31, 0.83, -0.47]];

/// Sizes and pixel spacings (mm), from much smaller than a segment to a whole tree in one pixel.
const VIEWS: [([usize; 2], f64); 7] = [
    ([1, 1], 1.0),
    ([1, 17], 0.3),
    ([17, 1], 2.0),
    ([64, 48], 1.0),
    ([33, 20], 1e-4),
    ([33, 20], 0.01),
    ([33, 20], 40.0),
];

fn view(direction: [f64; 3], size: [usize; 2], pixel_spacing: f64) -> Camera {
    let direction = DVec3::from_array(direction).normalize();
    Camera::new(direction * -TREE_DEPTH, direction, DVec3::Z, size, pixel_spacing).unwrap()
}

/// The default and the paper's rules, also with so small a level distance that levels are not blended.
fn all_settings() -> Vec<Settings> {
    let alone = |levels, rules: &Settings| Settings { levels, level_distance: 1e-3, ..rules.clone() };
    let (own, paper) = (unfiltered(), paper_unfiltered());
    let both = [&own, &paper].into_iter().flat_map(|rules| [1, 3, MAX_LEVELS].map(|n| alone(n, rules)));
    both.chain([alone(0, &own), own.clone(), paper.clone()]).collect()
}

/// A single vessel, given in coordinates of views along `direction`; no other vessel covers its gaps.
fn seen_along(direction: [f64; 3], points: &[[f64; 3]]) -> VesselTree {
    let camera = view(direction, [1, 1], 1.0);
    let place = |[x, y, z]: &[f64; 3]| camera.right() * *x + camera.up() * *y + camera.direction() * *z;
    let radii = (0..points.len()).map(|i| 0.5 + (i % 3) as f64).collect();
    tree(vec![Vessel::new(points.iter().map(place).collect(), Some(radii)).unwrap()])
}

/// Vessels that run along the view at their beginning, inside, at their end, or everywhere.
fn runs() -> Vec<Vec<[f64; 3]>> {
    let within =
        [[-20.0, 0.0, 0.0], [-10.0, 0.0, 0.0], [-10.0, 0.0, 5.0], [-10.0, 0.0, 9.0], [0.0, 8.0, 9.0]];
    let at_the_end = [[0.0, 8.0, 9.0], [10.0, -5.0, 2.0], [20.0, 0.0, 2.0], [20.0, 0.0, -7.0]];
    let first = [[5.0, 5.0, -3.0], [5.0, 5.0, 0.0], [5.0, 5.0, 4.0], [9.0, 5.0, 4.0]];
    let alone = [[-3.0, -12.0, 0.0], [-3.0, -12.0, 4.0], [-3.0, -12.0, -6.0]];
    vec![within.to_vec(), at_the_end.to_vec(), first.to_vec(), alone.to_vec()]
}

/// Segments whose projections are about as short as the limit below which they count as collinear.
fn nearly_collinear() -> Vec<Vec<[f64; 3]>> {
    let steep = |i: i32| [f64::from(i) * 1e-3 * (1.0 + 0.1 * f64::from(i % 7 - 3)), 0.0, f64::from(i % 5)];
    let round = |i: i32| [1e-3 * f64::from(i).cos(), 1e-3 * f64::from(i).sin(), f64::from(i) * 0.5];
    vec![(0..60).map(steep).collect(), (0..60).map(round).collect()]
}

/// Vessels hardly larger than a point: shorter than the shortest segment, or with steps about as short.
fn tiny() -> Vec<Vec<[f64; 3]>> {
    let line =
        |count: i32, step: f64, y: f64| (0..count).map(move |i| [f64::from(i) * step, y, 0.0]).collect();
    vec![line(2, 1e-4, 0.0), line(40, 4e-4, 3.0), line(3, 1.01e-3, -3.0), line(50, 0.999e-3, 5.0)]
}

/// Vessels whose pieces have borders through pixel centres: along rows, columns and diagonals, in both directions.
fn through_pixels() -> Vec<Vec<[f64; 3]>> {
    let steps = [[0.5, 0.5, 0.0], [4.5, 0.5, 1.0], [4.5, 4.5, 2.0], [8.5, 8.5, 0.0], [0.5, 0.5, 3.0]];
    let back = [[-9.5, 0.5, 1.0], [-3.5, 0.5, 2.0], [-9.5, 0.5, 3.0], [-3.5, -5.5, 4.0], [-3.5, 6.5, 5.0]];
    vec![steps.to_vec(), back.to_vec()]
}

fn trees(direction: [f64; 3]) -> Vec<(&'static str, VesselTree)> {
    let made = [
        ("runs", runs()),
        ("nearly collinear", nearly_collinear()),
        ("tiny", tiny()),
        ("through pixels", through_pixels()),
    ];
    let random = [(1, 1.5, 60.0), (1, 0.01, 0.3), (1, 25.0, 400.0), (6, 1.5, 60.0)];
    let random = random.into_iter().zip(5..).map(|((vessels, step, extent), seed)| {
        ("random", random_tree(seed, vessels, 50, step, extent).unwrap())
    });
    made.iter()
        .flat_map(|(name, vessels)| vessels.iter().map(|points| (*name, seen_along(direction, points))))
        .chain(random)
        .collect()
}

fn depth_range(tree: &VesselTree, camera: &Camera) -> [f64; 2] {
    let points = tree.vessels().iter().flat_map(|vessel| vessel.points());
    let depths = points.map(|point| camera.view_from_world(*point).z);
    depths.fold([f64::MAX, f64::MIN], |[low, high], depth| [low.min(depth), high.max(depth)])
}

/// The pixels whose depth lies outside the range of the tree, or whose vessel is not one of the tree's.
fn uncovered(depth: &[f32], vessel: &[i32], [low, high]: [f64; 2], vessels: usize) -> Vec<usize> {
    let range = low - ROUNDING..=high + ROUNDING;
    let is_covered =
        |p: &usize| range.contains(&f64::from(depth[*p])) && (0..vessels as i32).contains(&vessel[*p]);
    assert_eq!(depth.len(), vessel.len());
    (0..depth.len()).filter(|p| !is_covered(p)).collect()
}

/// Renders a tree in all views; returns the number of pixels.
fn cover(renderer: &mut GpuRenderer, name: &str, tree: &VesselTree, direction: [f64; 3]) -> usize {
    let scene = Scene::default().with_tree(tree.clone());
    let mut pixels = 0;
    for (size, spacing) in VIEWS {
        let camera = view(direction, size, spacing);
        let range = depth_range(tree, &camera);
        for settings in all_settings() {
            let request = Request::new(&camera, &settings);
            let frame = pollster::block_on(renderer.render(&scene, &request)).unwrap();
            let left = uncovered(frame.depth(), &frame.vessel, range, tree.vessels().len());
            let (levels, spacing) = (settings.levels, camera.pixel_spacing());
            assert!(
                left.is_empty(),
                "{name} along {direction:?}, {size:?} pixels of {spacing} mm, {levels} levels: {} uncovered, the first \
                 at {} with depth {} of {range:?}",
                left.len(),
                left[0],
                frame.depth()[left[0]]
            );
            assert!(frame.distance.iter().all(|d| (0.0..1e6).contains(d)), "{name}: distances");
            pixels += frame.depth().len();
        }
    }
    pixels
}

#[test]
fn no_pixel_is_left_uncovered_on_any_gpu() {
    for device in every_device() {
        // One renderer, since compiling its shaders takes longer than rendering.
        let (mut renderer, mut pixels) = (GpuRenderer::new(Arc::clone(&device)), 0);
        for direction in DIRECTIONS {
            for (name, tree) in trees(direction) {
                pixels += cover(&mut renderer, name, &tree, direction);
            }
        }
        let found = device.description();
        println!("{} by {}: {pixels} pixels, all covered", found.name, found.backend);
        assert!(pixels > 100_000);
    }
}

#[test]
fn a_pixel_without_a_winner_at_one_level_is_seen() {
    // At a level with 3 % of the weight, no piece covers the pixel.
    let depths = [2e4f32, 2e4 * 0.97, 0.0, 2e4, f32::NAN];
    let vessels = [0, 0, 0, 2, 1];
    assert_eq!(uncovered(&depths, &vessels, [2e4 - 400.0, 2e4 + 400.0], 2), [1, 2, 3, 4]);
}
