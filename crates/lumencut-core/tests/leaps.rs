//! Depth jumps compared with closed forms: they lie where one surface hides another, and nowhere else.
#![allow(clippy::unwrap_used)]

use lumencut_core::camera::Camera;
use lumencut_core::math::lanes::Isa;
use lumencut_core::math::leaps::{
    DOWNWARDS, LEAPS, LINE_DOWNWARDS, LINE_TO_THE_RIGHT, LUMEN, TO_THE_RIGHT, WALL,
};
use lumencut_core::pipeline::{CpuRenderer, Request, SurfaceDetails};
use lumencut_core::scene::LeveledTree;
use lumencut_core::settings::{LevelChoice, Settings};
use lumencut_core::stages::Work;
use lumencut_core::stages::depth::{Sheet, WALL_GAP};
use lumencut_core::stages::leap::{LeapParameters, leap};
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::brute_force::by_hierarchy;
use lumencut_scenes::lumen::certain_lumen;
use lumencut_scenes::random::Random;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::tolerances::CLOSED_FORM;
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::{front, view};

const SIZE: [usize; 2] = [40, 60];

fn details(scene: &VesselTree, camera: &Camera, settings: &Settings) -> SurfaceDetails {
    let scene = LeveledTree::new(scene.clone());
    CpuRenderer::default().details(&scene, &Request::new(camera, settings)).unwrap()
}

fn leaps(scene: &VesselTree, camera: &Camera) -> Vec<u32> {
    details(scene, camera, &Settings::default()).leap.iter().map(|bits| bits & LEAPS).collect()
}

fn tube(height: f64, depth: f64, radius: f64) -> lumencut_core::vessel_tree::Vessel {
    vessel(&[[-500.0, depth, height], [500.0, depth, height]], radius)
}

#[test]
fn a_near_tube_before_a_far_one_leaps_exactly_along_its_border() {
    let scene = tree(vec![tube(0.0, 100.0, 20.0), tube(0.0, 0.0, 5.0)]);
    let camera = front(SIZE, 0.5);
    let border = |j: usize| camera.view_y(j).abs() < 5.0;
    let expected = |p: usize| {
        let j = p / SIZE[0];
        // The depths differ by 100 mm, which is more than the 40 mm diameter of the larger tube.
        if j + 1 < SIZE[1] && border(j) != border(j + 1) { DOWNWARDS } else { 0 }
    };
    let found = leaps(&scene, &camera);
    assert_eq!(found, (0..found.len()).map(expected).collect::<Vec<_>>());
    assert_eq!(found.iter().filter(|leap| **leap != 0).count(), 2 * SIZE[0]);
}

#[test]
fn leaps_to_the_right_are_those_downwards_of_the_view_turned_by_a_right_angle() {
    let scene = random_tree(71, 12, 50, 2.0, 50.0).unwrap();
    let tall = Camera::new(glam::DVec3::ZERO, glam::DVec3::Y, glam::DVec3::Z, SIZE, 1.5).unwrap();
    let wide =
        Camera::new(glam::DVec3::ZERO, glam::DVec3::Y, glam::DVec3::X, [SIZE[1], SIZE[0]], 1.5).unwrap();
    // Turned by 90°: rows from the top become columns from the right, and columns become rows.
    let (a, b) = (leaps(&scene, &tall), leaps(&scene, &wide));
    let turned = |i: usize, j: usize| b[(SIZE[0] - 1 - i) * SIZE[1] + j];
    let mut seen = 0;
    for (j, i) in (0..SIZE[1] - 1).flat_map(|j| (0..SIZE[0]).map(move |i| (j, i))) {
        let down = a[j * SIZE[0] + i] & DOWNWARDS != 0;
        seen += usize::from(down);
        assert_eq!(down, turned(i, j) & TO_THE_RIGHT != 0, "at {i}, {j}");
    }
    assert!(seen > 50, "only {seen} leaps");
}

#[test]
fn the_sheet_of_a_straight_tube_is_its_slope_and_radius_negative_beside_the_lumen_without_a_gap() {
    // The depth rises 40 mm over 80 mm to the right and 40 mm upwards: (80, 40) · 40 / (80² + 40²).
    let slanted = tree(vec![vessel(&[[-80., -40., -40.], [0.; 3], [80., 40., 40.]], 3.0)]);
    let slope = [0.4f32, 0.2];
    let camera = front(SIZE, 1.0);
    for (level_choice, lumen_first) in [
        (LevelChoice::Own, true),
        (LevelChoice::Own, false),
        (LevelChoice::Nearest, true),
        (LevelChoice::Nearest, false),
    ] {
        let settings = Settings { level_choice, lumen_first, ..Settings::default() };
        for (p, sheet) in details(&slanted, &camera, &settings).sheet.iter().enumerate() {
            let (x, y) = (camera.view_x(p % SIZE[0]), camera.view_y(p / SIZE[0]));
            let is_lumen = (2.0 * y - x).abs() < 3.0 * 5f64.sqrt();
            let radius = if is_lumen { 3.0 } else { -3.0 };
            // In lumen and wall, the gap states the place along the vessel: here the foot, from the end at (-80, -40).
            let along = ((x + 80.0) * 2.0 + y + 40.0) / 5f64.sqrt() * 1.2f64.sqrt();
            let is_wall = (2.0 * y - x).abs() < 4.0 * 5f64.sqrt();
            let gap = if is_wall { WALL_GAP - along as f32 } else { 0.0 };
            CLOSED_FORM.assert_same(sheet, &[slope[0], slope[1], radius, gap], "sheet");
        }
    }
}

#[test]
fn within_lumen_and_wall_nothing_is_blended() {
    let scene = random_tree(74, 9, 50, 2.0, 50.0).unwrap();
    let camera = view([0.3, 1.0, 0.2], SIZE, 1.8);
    let gaps = details(&scene, &camera, &Settings::default()).sheet;
    let lumens = (0..SIZE[0] * SIZE[1]).filter(|p| {
        let (x, y) = (camera.view_x(p % SIZE[0]), camera.view_y(p / SIZE[0]));
        certain_lumen(&scene, &camera, x, y).is_some()
    });
    assert!(lumens.clone().count() > 200 && lumens.clone().all(|p| gaps[p][3] <= WALL_GAP));
    assert!(gaps.iter().any(|sheet| sheet[3] > 1.0), "nothing is blended anywhere");
}

#[test]
fn a_steep_vessel_that_goes_on_has_no_leap_to_the_borders_of_the_image() {
    // The depth rises 40 mm per mm, so up to 40 mm from pixel to pixel.
    for [x, z] in [[50., 0.], [0., 50.], [-30., 40.]] {
        let steep = tree(vec![vessel(&[[-x, -2000., -z], [0.; 3], [x, 2000., z]], 2.0)]);
        for (size, spacing) in [(SIZE, 0.2), (SIZE, 1.0), ([1, 1], 1.0), ([1, 17], 1.0), ([17, 1], 1.0)] {
            let found = leaps(&steep, &front(size, spacing));
            assert!(found.iter().all(|leap| *leap == 0), "{size:?}, {spacing} mm, {x}, {z}");
        }
    }
}

#[test]
fn vessels_that_meet_end_to_end_have_a_border_without_leap() {
    let ends = [[-60., -30., -10.], [0., 0., 0.], [60., 30., 10.]];
    let scene = tree(vec![vessel(&ends[..2], 3.0), vessel(&ends[1..], 3.0)]);
    let camera = front(SIZE, 1.0);
    let zones = by_hierarchy(&scene, &camera, &Settings::default()).vessel;
    assert!(zones.contains(&0) && zones.contains(&1));
    assert!(leaps(&scene, &camera).iter().all(|leap| *leap == 0));
}

#[test]
fn a_leap_is_more_than_the_larger_diameter_and_more_than_two_mm() {
    for (radii, largest_step) in
        [([0.5, 0.5], 2.0), ([0.0, 0.0], 2.0), ([3.0, 3.0], 6.0), ([3.0, 1.0], 6.0), ([1.0, 4.0], 8.0)]
    {
        for apart in [-1.01, -0.99, 0.99, 1.01] {
            let depth: f64 = apart * largest_step;
            let scene = tree(vec![tube(8.0, 0.0, radii[0]), tube(-8.0, depth, radii[1])]);
            let found = leaps(&scene, &front(SIZE, 0.5));
            let expected = if apart.abs() > 1.0 { SIZE[0] } else { 0 };
            assert_eq!(found.iter().filter(|leap| **leap != 0).count(), expected, "{radii:?}, {depth} mm");
        }
    }
}

/// Random depths (mm), and sheets whose slopes explain some of the changes.
fn noise(random: &mut Random, pixels: usize) -> (Vec<f32>, Vec<Sheet>) {
    let sheet = |random: &mut Random| {
        let [x, y] = [0; 2].map(|_| random.between(-6.0, 6.0));
        [x, y, random.between(-3.0, 3.0), 0.0]
    };
    let depth = random.image(pixels, -8.0, 8.0);
    (depth, (0..pixels).map(|_| sheet(random)).collect())
}

/// The rule in f64: whether a change between two pixels is a depth jump; `None` if rounding could decide.
fn stated(change: f32, sheets: [Sheet; 2], step: [f64; 2]) -> Option<bool> {
    let over = sheets.map(|[x, y, radius, _]| {
        let expected = f64::from(x) * step[0] + f64::from(y) * step[1];
        (f64::from(change) - expected).abs() - (2.0 * f64::from(radius.abs())).max(2.0)
    });
    let is_certain = over.iter().all(|over| over.abs() > 1e-4);
    is_certain.then(|| over.iter().all(|over| *over > 0.0))
}

#[test]
fn the_leap_image_is_the_rule_applied_pixel_by_pixel_at_any_size() {
    let mut random = Random::new(72);
    for size in [[1, 1], [1, 17], [17, 1], [16, 8], [40, 33]] {
        let [width, height] = size;
        let (camera, (depth, sheet)) = (front(size, 0.7), noise(&mut random, width * height));
        let by = |isa: Isa| {
            let mut found = vec![9; depth.len()];
            let work = Work { size, isa, stop: &|| false, progress: None };
            leap(&work, &LeapParameters::new(&camera), (&depth, &vec![0; depth.len()]), &sheet, &mut found)
                .unwrap();
            found
        };
        let found = by(Isa::Baseline);
        assert!(Isa::available().into_iter().all(|isa| by(isa) == found), "{size:?}");
        for (p, leap) in found.iter().enumerate() {
            assert_eq!(leap & !(LEAPS | LINE_TO_THE_RIGHT | LINE_DOWNWARDS | LUMEN | WALL), 0);
            let is_lumen = |p: usize| sheet[p][2] > 0.0;
            assert_eq!(leap & LUMEN != 0, is_lumen(p));
            let ways = [
                (TO_THE_RIGHT, LINE_TO_THE_RIGHT, p % width + 1 < width, 1, [0.7, 0.0]),
                (DOWNWARDS, LINE_DOWNWARDS, p / width + 1 < height, width, [0.0, -0.7]),
            ];
            for (bit, line, has_neighbour, ahead, step) in ways {
                let to = if has_neighbour { p + ahead } else { p };
                let rule = if has_neighbour {
                    stated(depth[to] - depth[p], [sheet[p], sheet[to]], step)
                } else {
                    Some(false)
                };
                assert!(rule.is_none_or(|rule| rule == (leap & bit != 0)), "{size:?}, pixel {p}, bit {bit}");
                let beyond = if is_lumen(p) == is_lumen(to) { depth[to] > depth[p] } else { is_lumen(p) };
                assert_eq!(leap & line != 0, beyond && leap & bit != 0, "{size:?}, pixel {p}, bit {line}");
            }
        }
        assert_eq!(found.iter().any(|leap| *leap & LEAPS != 0), width * height > 1, "{size:?}");
    }
}

#[test]
fn folds_of_a_lumen_that_runs_along_the_view_are_no_leaps() {
    // Two pixels of lumens with a radius of 3 mm, 1 mm apart: a change of more than 6 mm is a leap.
    let leaps = |deeper: f32, along: f32, vessels: [i32; 2], radii: [f32; 2]| {
        let gaps = [WALL_GAP - 50.0, WALL_GAP - 50.0 - along];
        let sheet = [0, 1].map(|n| [0.0, 0.0, radii[n], gaps[n]]);
        let (camera, mut found) = (front([2, 1], 1.0), vec![0; 2]);
        let work = Work { size: [2, 1], isa: Isa::widest(), stop: &|| false, progress: None };
        let parameters = LeapParameters::new(&camera);
        leap(&work, &parameters, (&[0.0, deeper], &vessels), &sheet, &mut found).unwrap();
        found[0] & LEAPS != 0
    };
    let lumen = [3.0; 2];
    for sign in [-1.0, 1.0] {
        // At most 1 / 0.9 as far along the vessel as in depth, and at most two diameters deep.
        assert!(!leaps(sign * 9.0, 9.9, [4, 4], lumen) && !leaps(sign * 12.0, -12.5, [4, 4], lumen));
        assert!(leaps(sign * 9.0, 10.1, [4, 4], lumen), "bends");
        assert!(leaps(sign * 9.0, 60.0, [4, 4], lumen), "comes back in front of itself");
        assert!(leaps(sign * 12.1, 12.5, [4, 4], lumen), "more than two diameters");
        assert!(leaps(sign * 9.0, 9.5, [4, 5], lumen), "two vessels");
        assert!(leaps(sign * 9.0, 9.5, [4, 4], [3.0, -3.0]), "the wall on one side");
    }
}

#[test]
fn the_leaps_of_a_view_are_those_of_its_depth_and_sheet() {
    let scene = random_tree(73, 12, 50, 2.0, 50.0).unwrap();
    for level_choice in [LevelChoice::Own, LevelChoice::Nearest] {
        for (size, spacing) in [([1, 1], 1.0), ([1, 60], 1.5), ([60, 1], 1.5), ([60, 50], 1.5)] {
            let camera = view([1.0, 0.3, 0.2], size, spacing);
            let settings = Settings { level_choice, depth_filter: false, ..Settings::default() };
            let SurfaceDetails { sheet, leap: found, strength, .. } = details(&scene, &camera, &settings);
            let depth = by_hierarchy(&scene, &camera, &settings);
            let mut expected = vec![9; found.len()];
            let work = Work { size, isa: Isa::widest(), stop: &|| false, progress: None };
            let places = (depth.depth(), &depth.vessel[..]);
            leap(&work, &LeapParameters::new(&camera), places, &sheet, &mut expected).unwrap();
            assert_eq!(found, expected, "{size:?}");
            assert!(strength.iter().all(|s| (0.0..=1.0001).contains(s)));
        }
    }
}
