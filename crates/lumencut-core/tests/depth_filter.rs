//! The depth filter within zones, compared pixel by pixel with its rule, and images that it must not change.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;

use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::depth_filter::{DepthFilterParameters, depth_filter};
use lumencut_scenes::random::Random;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::tolerances::{FILTERED_DEPTH, PLANE};
use lumencut_scenes::views::{front, on_cpu, view};
use lumencut_scenes::zones::Zones;

const SIZES: [[usize; 2]; 5] = [[1, 1], [1, 17], [17, 1], [16, 8], [40, 33]];

fn filtered(size: [usize; 2], depth: &[f32], vessel: &[i32], depth_leap: f64) -> Vec<f32> {
    let parameters = DepthFilterParameters::of(&Settings { depth_leap, ..Settings::default() });
    let mut smoothed = vec![f32::NAN; depth.len()];
    depth_filter(&on_cpu(&front(size, 1.0)), &parameters, depth, Some(vessel), &mut smoothed).unwrap();
    smoothed
}

fn image(size: [usize; 2], depth: impl Fn(f32, f32) -> f32) -> Vec<f32> {
    (0..size[0] * size[1]).map(|p| depth((p % size[0]) as f32, (p / size[0]) as f32)).collect()
}

/// The rule along one axis in f64: the mean of a pixel and the pairs that count, and the number of pairs.
fn mean_along(
    size: [usize; 2],
    step: [isize; 2],
    depth: &[f32],
    vessel: &[i32],
    leap: f64,
) -> Vec<(f32, usize)> {
    let place = |x: isize, y: isize| {
        let is_inside = (0..size[0] as isize).contains(&x) && (0..size[1] as isize).contains(&y);
        is_inside.then(|| y as usize * size[0] + x as usize)
    };
    let variance = 8.0 * 2f64.ln() / std::f64::consts::PI.powi(2);
    let of_pixel = |p: usize| {
        let at = |k: isize| place((p % size[0]) as isize + k * step[0], (p / size[0]) as isize + k * step[1]);
        let is_own = |k: isize| at(k).is_some_and(|q| vessel[q] == vessel[p]);
        let z = |k: isize| f64::from(depth[at(k).unwrap()]);
        let counts = |k: &isize| {
            (1..=*k).all(|n| is_own(n) && is_own(-n)) && (z(-k) + z(*k) - 2.0 * z(0)).abs() < leap
        };
        let pairs: Vec<isize> = (1..=3).filter(counts).collect();
        let weight = |k: isize| (-((k * k) as f64) / (2.0 * variance)).exp();
        let all = || std::iter::once(0).chain(pairs.iter().flat_map(|k| [-k, *k]));
        let mean = all().map(|k| weight(k) * z(k)).sum::<f64>() / all().map(weight).sum::<f64>();
        (mean as f32, pairs.len())
    };
    (0..depth.len()).map(of_pixel).collect()
}

#[test]
fn it_is_the_rule_applied_pixel_by_pixel() {
    let mut seen = BTreeSet::new();
    for (seed, size) in (0..).zip(SIZES) {
        for leap in [0.2, 1.0, 50.0] {
            let Zones { depth, vessel } = Zones::new(seed, size);
            let columns = mean_along(size, [0, 1], &depth, &vessel, leap);
            let between: Vec<f32> = columns.iter().map(|(z, _)| *z).collect();
            let rows = mean_along(size, [1, 0], &between, &vessel, leap);
            let expected: Vec<f32> = rows.iter().map(|(z, _)| *z).collect();
            let found = filtered(size, &depth, &vessel, leap);
            FILTERED_DEPTH.assert_same(&found, &expected, &format!("{size:?}, leap {leap}"));
            seen.extend(columns.iter().chain(&rows).map(|(_, pairs)| *pairs));
        }
    }
    assert!(seen.into_iter().eq(0..=3), "every number of pairs");
}

#[test]
fn planes_stay_planes_to_the_borders_of_image_and_zones() {
    for (seed, size) in (0..).zip(SIZES) {
        let vessel = Zones::new(seed, size).vessel;
        for zones in [vec![4; vessel.len()], vessel] {
            let exact = image(size, |x, y| 0.5 * x - 1.25 * y + 96.0);
            assert_eq!(filtered(size, &exact, &zones, 1.0), exact, "{size:?}: numbers of few digits");
            let steep = image(size, |x, y| 3.1 * x - 4.7 * y + 130.3);
            PLANE.assert_same(&filtered(size, &steep, &zones, 1.0), &steep, &format!("{size:?}"));
        }
    }
}

#[test]
fn a_step_within_a_zone_stays_a_step() {
    let size = [40, 33];
    for is_across in [true, false] {
        let step = |x: f32, y: f32| if (if is_across { x } else { y }) < 16.0 { 0.0 } else { 5.0 };
        let depth = image(size, |x, y| 0.25 * x + 0.5 * y + step(x, y));
        assert_eq!(filtered(size, &depth, &[7; 1320], 1.0), depth);
        assert_ne!(filtered(size, &depth, &[7; 1320], 6.0), depth, "a step that is no leap");
    }
}

#[test]
fn what_stands_alone_is_untouched() {
    let mut random = Random::new(5);
    let noise = random.image(1320, -200.0, 200.0);
    let lone: Vec<i32> = (0..1320).collect();
    assert_eq!(filtered([40, 33], &noise, &lone, 1e6), noise, "every pixel a zone");
    assert_eq!(filtered([1, 1], &noise[..1], &[3], 1e6), noise[..1], "a lone pixel");
    assert_eq!(filtered([40, 33], &noise, &[3; 1320], 0.0), noise, "every bend a leap");
    let (stripes, rows) = (random.image(40, -200.0, 200.0), random.image(33, -200.0, 200.0));
    let across = image([40, 33], |x, _| stripes[x as usize]);
    let columns: Vec<i32> = (0..1320).map(|p| p % 40).collect();
    assert_eq!(filtered([40, 33], &across, &columns, 1e6), across, "zones one pixel wide");
    let down = image([40, 33], |_, y| rows[y as usize]);
    let lines: Vec<i32> = (0..1320).map(|p| p / 40).collect();
    assert_eq!(filtered([40, 33], &down, &lines, 1e6), down, "zones one pixel high");
}

#[test]
fn a_zone_knows_nothing_of_its_neighbours() {
    let size = [40, 33];
    let Zones { depth, vessel } = Zones::new(8, size);
    let before = filtered(size, &depth, &vessel, 50.0);
    let moved: Vec<f32> =
        depth.iter().zip(&vessel).map(|(z, v)| if *v == 1 { z - 300.0 } else { *z }).collect();
    let after = filtered(size, &moved, &vessel, 50.0);
    assert!(vessel.contains(&1) && vessel.contains(&0));
    for p in (0..depth.len()).filter(|p| vessel[*p] != 1) {
        assert_eq!(before[p].to_bits(), after[p].to_bits(), "pixel {p}");
    }
}

#[test]
fn the_settings_choose_it() {
    let (tree, camera) = (random_tree(6, 8, 60, 2.0, 70.0).unwrap(), view([1.0, 0.4, -0.3], [90, 70], 1.6));
    let scene = Scene::default().with_tree(tree);
    let render = |settings: &Settings| {
        CpuRenderer::default().render(&scene, &Request::new(&camera, settings)).unwrap()
    };
    for lumen_first in [false, true] {
        let raw = Settings { lumen_first, depth_filter: false, ..Settings::default() };
        let found = render(&raw);
        for depth_leap in [0.0, 0.2, 5.0] {
            let zones = Settings { depth_filter: true, zone_filter: true, depth_leap, ..raw.clone() };
            let expected = filtered(camera.size(), found.depth(), &found.vessel, depth_leap);
            assert_eq!(render(&zones).depth(), expected);
            assert_eq!(expected == found.depth(), depth_leap == 0.0);
            let plain = Settings { zone_filter: false, ..zones };
            assert_ne!(render(&plain).depth(), expected);
        }
    }
}
