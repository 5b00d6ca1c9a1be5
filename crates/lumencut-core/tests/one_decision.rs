//! One decision per pixel: only the vessel that the pixel shows on the finest level gives its depth.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::{LevelChoice, Settings};
use lumencut_core::stages::levels::levels;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_scenes::brute_force::by_hierarchy;
use lumencut_scenes::lumen::{certain_lumen, nearest_lumen};
use lumencut_scenes::random::Random;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::settings::unfiltered;
use lumencut_scenes::tolerances::{CLOSED_FORM, FILTERED_LUMEN, LUMEN};
use lumencut_scenes::trees::{tree, trefoil};
use lumencut_scenes::views::{front, view};

const DIRECTIONS: [[f64; 3]; 4] = [[0.0, 1.0, 0.0], [1.0, 0.3, 0.2], [-1.0, 2.0, 3.0], [0.2, -0.1, -1.0]];

/// The pixels whose nearest lumen cannot change by rounding, with the depth of that lumen (mm).
fn lumens(scene: &VesselTree, camera: &Camera) -> Vec<(usize, f64)> {
    let [width, height] = camera.size();
    let of_pixel = |p: usize| {
        let (x, y) = (camera.view_x(p % width), camera.view_y(p / width));
        certain_lumen(scene, camera, x, y).map(|depth| (p, depth))
    };
    (0..width * height).filter_map(of_pixel).collect()
}

#[test]
fn every_pixel_in_a_lumen_shows_the_nearest_lumen_with_any_number_of_levels() {
    for (seed, vessels) in [(24, 10), (61, 30)] {
        let scene = random_tree(seed, vessels, 50, 2.0, 50.0).unwrap();
        for direction in DIRECTIONS {
            let camera = view(direction, [64, 60], 1.6);
            let lumens = lumens(&scene, &camera);
            assert!(lumens.len() > 300, "only {} pixels show lumen", lumens.len());
            let nearest: Vec<f32> = lumens.iter().map(|(_, depth)| *depth as f32).collect();
            for settings in [0, 6, 15].map(|levels| Settings { levels, ..unfiltered() }) {
                let frame = by_hierarchy(&scene, &camera, &settings);
                let found: Vec<f32> = lumens.iter().map(|(p, _)| frame.depth()[*p]).collect();
                LUMEN.assert_same(
                    &found,
                    &nearest,
                    &format!("{} levels along {direction:?}", settings.levels),
                );
            }
        }
    }
}

#[test]
fn the_filter_within_zones_leaves_the_lumen_where_it_is() {
    let scene = random_tree(61, 30, 50, 2.0, 50.0).unwrap();
    for direction in DIRECTIONS {
        let camera = view(direction, [96, 90], 0.9);
        let lumens = lumens(&scene, &camera);
        let nearest: Vec<f32> = lumens.iter().map(|(_, depth)| *depth as f32).collect();
        let shown = |settings: &Settings| {
            let frame = by_hierarchy(&scene, &camera, settings);
            lumens.iter().map(|(p, _)| frame.depth()[*p]).collect::<Vec<_>>()
        };
        let (found, plain) =
            (shown(&Settings::default()), shown(&Settings { zone_filter: false, ..Settings::default() }));
        FILTERED_LUMEN.assert_same(&found, &nearest, &format!("along {direction:?}"));
        let is_off = |pair: &(&f32, &f32)| !FILTERED_LUMEN.is_same(*pair.0, *pair.1);
        let off = plain.iter().zip(&nearest).filter(is_off).count();
        assert!(
            !FILTERED_LUMEN.allows(off, nearest.len()),
            "a filter over all moves {off} of {}",
            nearest.len()
        );
    }
}

#[test]
fn a_lumen_that_rounding_may_change_is_not_certain() {
    let tube = tree(vec![lumencut_scenes::trees::vessel(&[[-50., 7., 0.], [50., 7., 0.]], 3.0)]);
    let camera = front([8, 8], 1.0);
    let depths = |y: f64| [nearest_lumen, certain_lumen].map(|lumen| lumen(&tube, &camera, 0.3, y));
    assert_eq!(depths(2.9), [Some(7.0); 2]);
    assert_eq!(depths(2.9999), [Some(7.0), None]);
    assert_eq!(depths(3.0001), [None; 2]);
}

/// The level choice `own` with *lumen first*, with cost only, and with many levels.
fn own_levels() -> [Settings; 3] {
    [
        unfiltered(),
        Settings { lumen_first: false, ..unfiltered() },
        Settings { levels: 15, level_distance: 0.5, ..unfiltered() },
    ]
}

#[test]
fn the_vessel_of_a_pixel_does_not_depend_on_the_levels() {
    let scene = random_tree(62, 12, 50, 2.0, 50.0).unwrap();
    let camera = view([0.5, 1.0, -0.3], [90, 80], 1.5);
    for lumen_first in [true, false] {
        let with = |levels: usize, level_distance: f64| {
            let settings = Settings { levels, level_distance, lumen_first, ..unfiltered() };
            by_hierarchy(&scene, &camera, &settings)
        };
        let finest = with(0, 8.0);
        for (levels, level_distance) in [(6, 8.0), (6, 0.1), (15, 2.0), (1, 100.0)] {
            let coarser = with(levels, level_distance);
            assert_eq!(coarser.vessel, finest.vessel, "{levels} levels of {level_distance} mm");
            assert_ne!(coarser.depth(), finest.depth());
        }
    }
}

/// A vessel beyond all others that has the largest coordinates, so rounding is the same without the others.
fn far_away() -> Vessel {
    let points = vec![DVec3::new(-700.0, 900.0, 700.0), DVec3::new(-720.0, 900.0, 700.0)];
    Vessel::new(points, Some(vec![1.0; 2])).unwrap()
}

#[test]
fn the_depth_of_a_vessels_pixels_knows_nothing_of_other_vessels() {
    let scene = random_tree(63, 9, 50, 2.0, 50.0).unwrap();
    let camera = view([0.0, 1.0, 0.0], [80, 70], 1.6);
    let with_far = |vessels: &[Vessel]| tree(vessels.iter().cloned().chain([far_away()]).collect());
    for settings in own_levels() {
        let all = by_hierarchy(&with_far(scene.vessels()), &camera, &settings);
        let mut won = 0;
        for (id, vessel) in scene.vessels().iter().enumerate() {
            let alone = by_hierarchy(&with_far(std::slice::from_ref(vessel)), &camera, &settings);
            for p in (0..all.vessel.len()).filter(|p| all.vessel[*p] == id as i32 && alone.vessel[*p] == 0) {
                assert_eq!(all.depth()[p].to_bits(), alone.depth()[p].to_bits(), "vessel {id}, pixel {p}");
                won += 1;
            }
        }
        assert!(won > 80 * 70 * 9 / 10, "only {won} pixels compared");
    }
}

#[test]
fn by_the_papers_rule_other_vessels_change_the_depth() {
    let scene = random_tree(63, 9, 50, 2.0, 50.0).unwrap();
    let camera = view([0.0, 1.0, 0.0], [80, 70], 1.6);
    let settings = Settings { level_choice: LevelChoice::Nearest, ..unfiltered() };
    let all = by_hierarchy(&scene, &camera, &settings);
    let alone = by_hierarchy(&tree(scene.vessels()[..1].to_vec()), &camera, &settings);
    let other = |p: &usize| all.vessel[*p] == 0 && all.depth()[*p] != alone.depth()[*p];
    assert!((0..all.vessel.len()).filter(other).count() > 100);
}

#[test]
fn arc_lengths_never_fall_and_end_with_the_length_of_the_vessel() {
    for scene in
        [random_tree(64, 20, 97, 2.0, 50.0).unwrap(), trefoil(333), random_tree(65, 9, 3, 9.0, 50.0).unwrap()]
    {
        let all = levels(&scene, 15);
        for (id, vessel) in scene.vessels().iter().enumerate() {
            let length: f64 = vessel.points().windows(2).map(|p| p[0].distance(p[1])).sum();
            for level in &all {
                let along = level.vessels()[id].arc_length();
                assert_eq!(along.len(), level.vessels()[id].points().len());
                assert!(along.is_sorted(), "{along:?}");
                assert_eq!((along[0], *along.last().unwrap()), (0.0, *vessel.arc_length().last().unwrap()));
                assert!((along[along.len() - 1] - length).abs() < 1e-9 * length);
            }
        }
    }
}

/// A straight tube with 70 unevenly spaced points, whose depth rises.
fn uneven_tube() -> VesselTree {
    let mut random = Random::new(66);
    let mut along = 0.0;
    let points: Vec<DVec3> = (0..70)
        .map(|_| {
            along += 0.1 + 3.0 * random.number();
            DVec3::new(along - 50.0, 0.4 * along - 20.0, 3.0)
        })
        .collect();
    let radius = vec![2.0; points.len()];
    tree(vec![Vessel::new(points, Some(radius)).unwrap()])
}

#[test]
fn every_level_of_a_straight_tube_has_the_depth_of_the_finest_however_far() {
    let tube = uneven_tube();
    for spacing in [0.5, 5.0, 40.0] {
        let camera = front([96, 70], spacing);
        let with = |levels: usize, level_distance: f64| {
            by_hierarchy(&tube, &camera, &Settings { levels, level_distance, ..unfiltered() })
        };
        let finest = with(0, 8.0);
        for (levels, level_distance) in [(1, 8.0), (6, 8.0), (15, 1.0)] {
            let found = with(levels, level_distance);
            CLOSED_FORM.assert_same(found.depth(), finest.depth(), &format!("{levels} levels, {spacing} mm"));
        }
    }
}

/// The frame for a request of some images, and the stages that ran.
fn asked(scene: &Scene, settings: &Settings, images: &[Image]) -> (Frame, Vec<&'static str>) {
    let camera = view([0.5, 1.0, -0.3], [61, 50], 1.7);
    let request = Request { images: ImageSet::of(images), ..Request::new(&camera, settings) };
    let frame = CpuRenderer::default().render(scene, &request).unwrap();
    let stages = frame.timings.iter().map(|timing| timing.stage).collect();
    (frame, stages)
}

#[test]
fn the_distance_is_measured_only_where_it_is_asked_for() {
    let scene = Scene::default().with_tree(random_tree(67, 8, 40, 2.0, 50.0).unwrap());
    let (without, stages) = asked(&scene, &Settings::default(), &[Image::Depth, Image::Vessel]);
    assert!(without.distance.is_empty() && !stages.contains(&"distance"), "{stages:?}");
    let (with, stages) = asked(&scene, &Settings::default(), &[Image::Depth, Image::Vessel, Image::Distance]);
    assert!(stages.contains(&"distance"));
    assert_eq!((without.depth(), &without.vessel), (with.depth(), &with.vessel));
    let (paper, stages) = asked(&scene, &Settings::paper(), &[Image::Distance]);
    assert!(stages.contains(&"distance") && !paper.distance.is_empty());
    assert!(paper.distance.iter().zip(&with.distance).all(|(a, b)| a.to_bits() == b.to_bits()));
    let (paper, stages) = asked(&scene, &Settings::paper(), &[Image::Depth]);
    assert!(
        stages.contains(&"distance") && paper.distance.is_empty(),
        "the paper's levels need it: {stages:?}"
    );
}
