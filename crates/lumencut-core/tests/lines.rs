//! Lines at depth jumps compared with closed forms: their width and side; and lines leave lumens free.
#![allow(clippy::unwrap_used)]

use lumencut_core::camera::Camera;
use lumencut_core::math::leaps::{DOWNWARDS, LEAPS, LINE_TO_THE_RIGHT, LUMEN, TO_THE_RIGHT};
use lumencut_core::pipeline::{CpuRenderer, Request, SurfaceDetails};
use lumencut_core::scene::LeveledTree;
use lumencut_core::settings::{Focus, Settings};
use lumencut_core::stages::silhouette::{SilhouetteParameters, silhouette_of_leaps};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::{front, on_cpu, view};

const SIZE: [usize; 2] = [60, 80];
/// Pixel spacings (mm), and the width of a line there in pixels: 1 mm, clamped to 0.5 to 1.5 pixels.
const WIDTHS: [(f64, f32); 6] = [(0.05, 1.5), (0.5, 1.5), (0.8, 1.25), (1.0, 1.0), (1.6, 0.625), (2.5, 0.5)];
/// A bound on the rounding of a sum of strengths.
const ROUNDING: f32 = 1e-4;

fn details(scene: &VesselTree, camera: &Camera, settings: &Settings) -> SurfaceDetails {
    let scene = LeveledTree::new(scene.clone());
    let everywhere = Settings { silhouette_reach: None, ..settings.clone() };
    CpuRenderer::default().details(&scene, &Request::new(camera, &everywhere)).unwrap()
}

fn tube(height: f64, depth: f64, radius: f64) -> Vessel {
    vessel(&[[-900.0, depth, height], [900.0, depth, height]], radius)
}

/// The strengths of the middle column, from the top.
fn column(strength: &[f32]) -> Vec<f32> {
    strength.iter().skip(SIZE[0] / 2).step_by(SIZE[0]).copied().collect()
}

#[test]
fn a_line_on_a_far_lumen_is_1_mm_wide_within_half_a_pixel_and_one_and_a_half() {
    for (spacing, width) in WIDTHS {
        // The border of the near tube lies between two rows; behind it, the far tube's lumen is everywhere.
        let radius = 12.0 * spacing;
        let scene = tree(vec![tube(0.0, 400.0, 90.0), tube(0.0, 0.0, radius)]);
        let camera = front(SIZE, spacing);
        let strength = column(&details(&scene, &camera, &Settings::default()).strength);
        let first = (0..SIZE[1]).find(|j| camera.view_y(*j) < radius).unwrap();
        let expected = |beyond: usize| match beyond {
            0 => width.min(1.0),
            1 => (width - 1.0).max(0.0),
            _ => 0.0,
        };
        for (j, found) in strength.iter().enumerate() {
            let is_near_lumen = (first..first + 24).contains(&j);
            let rows_beyond = if j < first { first - 1 - j } else { j.saturating_sub(first + 24) };
            let expected = if is_near_lumen { 0.0 } else { expected(rows_beyond) };
            assert!((found - expected).abs() < ROUNDING, "{spacing} mm, row {j}: {found}, {expected}");
        }
    }
}

#[test]
fn a_line_between_surroundings_is_as_wide_and_lies_on_the_farther_side() {
    for (spacing, width) in WIDTHS {
        let scene = tree(vec![tube(16.0 * spacing, 0.0, spacing), tube(-16.0 * spacing, 30.0, spacing)]);
        // Walls would add depth jumps, and a low cost would move the border.
        let settings = Settings { lumen_margin: 0.0, cost_weight: 1e4, ..Settings::default() };
        let SurfaceDetails { leap, strength, .. } = details(&scene, &front(SIZE, spacing), &settings);
        let (leap, strength) = (&leap[SIZE[0] / 2..], column(&strength));
        let border = (0..SIZE[1] - 1).find(|j| leap[j * SIZE[0]] & LEAPS != 0).unwrap();
        assert!((strength.iter().sum::<f32>() - width).abs() < ROUNDING, "{spacing} mm: {strength:?}");
        assert!((strength[border + 1] - width.min(1.0)).abs() < ROUNDING, "{spacing} mm: {strength:?}");
        assert!(strength[..=border].iter().all(|s| *s == 0.0), "the nearer side: {strength:?}");
    }
}

#[test]
fn a_line_beside_a_far_lumen_leaves_it_free() {
    // Without a wall, the surroundings of the near tube end at the lumen of the far one.
    let settings = Settings { lumen_margin: 0.0, ..Settings::default() };
    for (spacing, width) in WIDTHS {
        let scene = tree(vec![tube(25.0 * spacing, 0.0, spacing), tube(0.0, 900.0 * spacing, 8.0 * spacing)]);
        let SurfaceDetails { leap, strength, .. } = details(&scene, &front(SIZE, spacing), &settings);
        let lumens: Vec<f32> =
            (0..leap.len()).filter(|p| leap[*p] & LUMEN != 0).map(|p| strength[p]).collect();
        assert!(lumens.len() > 10 * SIZE[0] && lumens.iter().all(|s| *s == 0.0), "{spacing} mm");
        let total: f32 = column(&strength).iter().sum();
        assert!(total > width - ROUNDING, "{spacing} mm: {total}");
    }
}

#[test]
fn a_line_is_as_wide_in_every_direction() {
    for (spacing, width) in WIDTHS {
        for degrees in [0, 10, 20, 30, 45, 60, 80, 90] {
            let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
            let aside = |across: f64, depth: f64| {
                let (x, z) = (-sine * across, cosine * across);
                vessel(
                    &[
                        [x - 900.0 * cosine, depth, z - 900.0 * sine],
                        [x + 900.0 * cosine, depth, z + 900.0 * sine],
                    ],
                    spacing,
                )
            };
            // The border between the two vessels' surroundings crosses the middle of the picture.
            let scene = tree(vec![aside(500.0 * spacing, 0.0), aside(-500.0 * spacing, 30.0)]);
            let settings = Settings { levels: 0, cost_weight: 1e4, ..Settings::default() };
            let size = [80, 80];
            let strength = details(&scene, &front(size, spacing), &settings).strength;
            let length = 80.0 / sine.max(cosine) as f32;
            let found = strength.iter().sum::<f32>() / length;
            assert!(
                (found / width - 1.0).abs() < 0.12,
                "{spacing} mm, {degrees}°: {found} of {width} pixels"
            );
        }
    }
}

/// Distance (pixels) of a lumen pixel from a depth jump to a nearer lumen, along its row or column.
fn to_a_nearer_lumen(leap: &[u32], depth: &[f32], [i, j]: [usize; 2]) -> Option<usize> {
    let at = |i: isize, j: isize| {
        let is_inside = (0..SIZE[0] as isize).contains(&i) && (0..SIZE[1] as isize).contains(&j);
        is_inside.then(|| (j as usize) * SIZE[0] + i as usize)
    };
    let mut steps = vec![];
    for [x, y] in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
        for n in 0..3isize {
            let places = (
                at(i as isize + n * x, j as isize + n * y),
                at(i as isize + (n + 1) * x, j as isize + (n + 1) * y),
            );
            let (Some(here), Some(there)) = places else { break };
            if leap[here] & leap[there] & LUMEN == 0 {
                break;
            }
            let bit = if y == 0 { TO_THE_RIGHT } else { DOWNWARDS };
            if leap[here.min(there)] & bit != 0 {
                if depth[there] < depth[here] {
                    steps.push(n as usize);
                }
                break;
            }
        }
    }
    steps.into_iter().min()
}

#[test]
fn no_line_covers_a_lumen_but_where_it_ends_at_a_nearer_one() {
    let scene = random_tree(75, 14, 60, 3.0, 50.0).unwrap();
    let (mut covered, mut free) = (0, 0);
    for (spacing, directions) in [(0.6, [0.3, 1.0, 0.2]), (1.8, [1.0, 0.2, 0.1]), (3.0, [0.1, 0.4, 1.0])] {
        let (camera, settings) =
            (view(directions, SIZE, spacing), Settings { depth_filter: false, ..Settings::default() });
        let SurfaceDetails { leap, strength, .. } = details(&scene, &camera, &settings);
        let depth = lumencut_scenes::brute_force::by_hierarchy(&scene, &camera, &settings);
        let width = (1.0 / spacing).clamp(0.5, 1.5) as f32;
        for p in (0..leap.len()).filter(|p| leap[*p] & LUMEN != 0) {
            let expected = match to_a_nearer_lumen(&leap, depth.depth(), [p % SIZE[0], p / SIZE[0]]) {
                Some(0) => width.min(1.0),
                Some(1) => (width - 1.0).max(0.0),
                _ => 0.0,
            };
            assert!(
                (strength[p] - expected).abs() < ROUNDING,
                "{spacing} mm, pixel {p}: {}, {expected}",
                strength[p]
            );
            if expected > 0.0 { covered += 1 } else { free += 1 }
        }
    }
    assert!(covered > 30 && free > 1000, "{covered} covered, {free} free");
}

/// The strengths of a row of six pixels with one depth jump in the middle, whose line lies to its right.
fn beside_one_leap(lumens: [bool; 6], value: [f32; 6]) -> Vec<f32> {
    let camera = front([6, 1], 1.0);
    let mut leap: Vec<u32> = lumens.iter().map(|lumen| if *lumen { LUMEN } else { 0 }).collect();
    leap[2] |= TO_THE_RIGHT | LINE_TO_THE_RIGHT;
    let mut strength = vec![9.0; 6];
    let parameters = SilhouetteParameters::new(&Settings::default(), &camera);
    silhouette_of_leaps(&on_cpu(&camera), &parameters, &leap, &value, &mut strength).unwrap();
    strength
}

#[test]
fn a_line_that_would_lie_where_nothing_is_shown_lies_on_the_other_side_unless_that_is_lumen() {
    let (none, nan) = ([false; 6], f32::NAN);
    let lumen = [true, true, true, false, false, false];
    assert_eq!(beside_one_leap(none, [5.0; 6]), [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    assert_eq!(beside_one_leap(none, [5.0, 5.0, 5.0, nan, nan, nan]), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    assert_eq!(beside_one_leap(lumen, [5.0, 5.0, 5.0, nan, nan, nan]), [0.0; 6]);
    assert_eq!(beside_one_leap(none, [nan, nan, nan, 5.0, 5.0, 5.0]), [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    assert_eq!(beside_one_leap(none, [nan; 6]), [0.0; 6]);
}

#[test]
fn lines_are_measured_as_a_picture_draws_them() {
    // The border between the zones is 16 mm from both walls; the line lies in the row of pixels behind it.
    let scene = LeveledTree::new(tree(vec![tube(17.0, 0.0, 1.0), tube(-17.0, 30.0, 1.0)]));
    let camera = front(SIZE, 1.0);
    let strongest = |reach: Option<f64>, focus: Option<Focus>| {
        let settings = Settings {
            lumen_margin: 0.0,
            cost_weight: 1e4,
            silhouette_reach: reach,
            focus,
            ..Settings::default()
        };
        let request = Request::new(&camera, &settings);
        let strength = CpuRenderer::default().details(&scene, &request).unwrap().strength;
        strength.into_iter().fold(0.0, f32::max)
    };
    assert_eq!(strongest(None, None), 1.0);
    assert_eq!(strongest(Some(7.0), None), 0.0);
    // The wall of the far tube is 15.5 mm away there, so a reach of 10 mm leaves 1 - S(0.55) of the line.
    let share = 1.0 - 0.55f32.powi(2) * (3.0 - 1.1);
    assert!((strongest(Some(10.0), None) - share).abs() < 1e-3);
    assert_eq!(strongest(None, Some(Focus { margin: 2.0, fade: 6.0 })), 0.0);
}
