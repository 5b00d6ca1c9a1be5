//! CR compared with closed forms, and bit by bit with an independent search of every piece.
#![allow(clippy::unwrap_used)]

use lumencut_core::camera::Camera;
use lumencut_core::error::ErrorKind;
use lumencut_core::frame::Frame;
use lumencut_core::math::projection::{Level, Projected, ProjectedLevel, Radii};
use lumencut_core::pipeline::Request;
use lumencut_core::reformations::Connections;
use lumencut_core::reformations::cr::{CrParameters, cr};
use lumencut_core::scene::LeveledTree;
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::{at, front, pixel, view};

fn seen(tree: &VesselTree, camera: &Camera, radius_offset: f64, arc_threshold: f64) -> Frame {
    let settings = Settings::default();
    let parameters = CrParameters { radius_offset, arc_threshold };
    cr(&LeveledTree::new(tree.clone()), &parameters, &Request::new(camera, &settings)).unwrap()
}

/// A piece seen from a pixel: distance, depth, radius, arc length, and its number.
#[derive(Clone, Copy)]
struct Met {
    distance: f32,
    z: f32,
    radius: f32,
    place: (i32, f32),
    number: u32,
}

/// All pieces that cover the pixel at (x, y).
fn met(projected: &[Projected], x: f32, y: f32) -> Vec<Met> {
    let mut all = Vec::new();
    for (slot, here) in projected.iter().enumerate() {
        let number = 2 * slot as u32;
        let (covered, distance) = here.wedge().cover(x, y);
        if here.stands && covered {
            let place = (here.vessel, here.arc_length);
            all.push(Met { distance, z: here.point[2], radius: here.radius, place, number });
        }
        if !here.has_stripe() {
            continue;
        }
        let next = &projected[slot + 1];
        let foot = here.stripe(next).foot(x, y);
        if foot.covered {
            let between = |from: f32, to: f32| from + foot.t * (to - from);
            all.push(Met {
                distance: foot.distance,
                z: between(here.point[2], next.point[2]),
                radius: between(here.radius, next.radius),
                place: (here.vessel, between(here.arc_length, next.arc_length)),
                number: number + 1,
            });
        }
    }
    all
}

/// CR of one pixel as in docs/method/reformations.md; depths are rounded with `lift`, as keys are.
fn by_brute_force(
    all: &[Met],
    offset: f32,
    lift: f32,
    is_near: impl Fn((i32, f32), (i32, f32)) -> bool,
) -> Met {
    let nearer = |a: &&Met, b: &&Met| a.distance.total_cmp(&b.distance).then(a.number.cmp(&b.number));
    let nearest = all.iter().min_by(nearer).unwrap();
    let key = |piece: &Met| piece.z - 2.0 * lift;
    let in_front = |a: &&Met, b: &&Met| key(a).total_cmp(&key(b)).then(a.number.cmp(&b.number));
    let held = all.iter().filter(|piece| piece.distance - (piece.radius + offset) <= 0.0);
    let Some(foremost) = held.min_by(in_front) else { return *nearest };
    let stretch =
        all.iter().filter(|piece| piece.number == foremost.number || is_near(foremost.place, piece.place));
    *stretch.min_by(nearer).unwrap()
}

#[test]
fn the_hierarchy_finds_what_every_piece_shows() {
    let trees =
        [random_tree(2, 3, 5, 2.0, 40.0).unwrap(), random_tree(3, 12, 60, 2.0, 80.0).unwrap(), trefoil(240)];
    let mut differing_from_the_nearest = 0;
    for tree in &trees {
        for direction in [[0.0, 1.0, 0.0], [1.0, 2.0, 3.0], [1e-5, 1e-5, 1.0]] {
            let camera = view(direction, [83, 61], 2.3);
            let level = Level::new(tree);
            let mut projected = ProjectedLevel::new(&level);
            projected.project(&level, &camera, Radii { scale: 1.0, unknown: 1.0 });
            let lift = 2.0 * projected.reach() + 1.0;
            for (offset, threshold) in [(0.0, 0.0), (4.0, 12.0), (30.0, 60.0), (500.0, 25.0)] {
                let frame = seen(tree, &camera, offset, threshold);
                let connections = Connections::new(&level, threshold * 2.3);
                for p in 0..83 * 61 {
                    let (x, y) = (camera.view_x(p % 83) as f32, camera.view_y(p / 83) as f32);
                    let all = met(&projected.projected, x, y);
                    let expected =
                        by_brute_force(&all, (offset * 2.3) as f32, lift, |a, b| connections.are_near(a, b));
                    assert_eq!(
                        (frame.depth()[p].to_bits(), frame.vessel[p]),
                        (expected.z.to_bits(), expected.place.0),
                        "pixel {p} from {direction:?}, {offset} and {threshold} pixels"
                    );
                    let least = all.iter().map(|piece| piece.distance).fold(f32::MAX, f32::min);
                    differing_from_the_nearest += usize::from(expected.distance > least);
                }
            }
        }
    }
    assert!(differing_from_the_nearest > 10_000, "{differing_from_the_nearest}");
}

/// A vessel from left to right in front, and a vertical one 40 mm behind it.
fn crossing() -> VesselTree {
    tree(vec![vessel(&[[-60., 0., 0.], [60., 0., 0.]], 4.0), vessel(&[[0., 40., -60.], [0., 40., 60.]], 4.0)])
}

#[test]
fn the_vessel_in_front_keeps_its_disc_and_a_larger_offset_hides_more() {
    let camera = front([120, 120], 1.0);
    for offset in [0.0, 5.0, 20.0] {
        let frame = seen(&crossing(), &camera, offset, 30.0);
        for j in 0..120 {
            for i in 0..120 {
                let (x, y) = (camera.view_x(i).abs(), camera.view_y(j).abs());
                // Inside its disc the front vessel is shown; elsewhere the nearer one, or the first if equal.
                let expected = if y <= 4.0 + offset || y <= x { 0.0 } else { 40.0 };
                assert_eq!(frame.depth()[j * 120 + i], expected, "{x}, {y} with {offset} pixels");
            }
        }
    }
    // All of the lumen behind is shown, except in the disc of the vessel in front.
    let shown = |offset: f64| {
        let frame = seen(&crossing(), &camera, offset, 30.0);
        (0..120).filter(|j| frame.depth()[j * 120 + 60] == 40.0).count()
    };
    assert_eq!([shown(0.0), shown(5.0), shown(20.0)], [112, 102, 72]);
}

#[test]
fn a_loop_is_two_stretches_where_the_threshold_is_short_and_one_where_it_is_long() {
    // A vessel runs down, and up again 40 mm behind and 10 mm aside: its limbs' middles are 141 mm apart along it.
    let hairpin =
        vessel(&[[0., 0., 50.], [0., 0., -0.], [0., 0., -50.], [10., 40., -50.], [10., 40., 50.]], 2.0);
    let camera = front([60, 60], 1.0);
    let tree = tree(vec![hairpin]);
    // The pixel is 8.5 mm from the front limb, 1.5 mm from the other, and inside a disc of 2 + 10 mm.
    let short = seen(&tree, &camera, 10.0, 100.0);
    assert_eq!(at(&short, short.depth(), 8.5, 0.5), 0.0);
    let long = seen(&tree, &camera, 10.0, 200.0);
    assert_eq!(at(&long, long.depth(), 8.5, 0.5), 40.0);
}

#[test]
fn the_distance_along_the_tree_goes_through_junctions() {
    let tree = tree(vec![
        vessel(&[[0., 0., 0.], [0., 0., 30.]], 1.0),
        vessel(&[[0., 0., 30.], [20., 0., 30.]], 1.0),
        // This vessel begins at an inner point of the previous one.
        vessel(&[[20., 0., 30.], [20., 10., 30.], [20., 10., 60.]], 1.0),
        vessel(&[[20., 10., 30.], [50., 10., 30.]], 1.0),
        vessel(&[[0., 0., 0.1], [0., 40., 0.1]], 1.0),
    ]);
    let level = Level::new(&tree);
    let is_near = |threshold: f64, a, b| Connections::new(&level, threshold).are_near(a, b);
    for (a, b, distance) in [
        ((0, 10.0), (0, 25.0), 15.0),
        ((0, 10.0), (1, 5.0), 25.0),
        ((0, 10.0), (2, 25.0), 20.0 + 20.0 + 25.0),
        ((0, 10.0), (3, 7.0), 20.0 + 20.0 + 10.0 + 7.0),
        ((3, 7.0), (2, 4.0), 13.0),
    ] {
        assert!(is_near(distance + 1e-4, a, b) && is_near(distance + 1e-4, b, a), "{a:?} to {b:?}");
        assert!(!is_near(distance - 1e-4, a, b) && !is_near(distance - 1e-4, b, a), "{a:?} to {b:?}");
    }
    // A vessel end a tenth of a millimetre off another vessel's end does not meet it.
    assert!(!is_near(1e6, (0, 0.0), (4, 0.0)));
}

#[test]
fn two_ways_around_a_ring_and_the_shorter_one_counts() {
    let half = |y: f64| vessel(&[[0., 0., 0.], [0., y, 10.], [0., 0., 20.]], 1.0);
    let tree = tree(vec![half(10.0), half(-30.0), vessel(&[[0., 0., 20.], [0., 0., 50.]], 1.0)]);
    let level = Level::new(&tree);
    // The path leads from 25 mm beyond the ring to its start, over the shorter half of the ring.
    let short = 25.0 + 2.0 * 200f64.sqrt();
    assert!(Connections::new(&level, short + 1e-4).are_near((2, 25.0), (1, 0.0)));
    assert!(!Connections::new(&level, short - 1e-4).are_near((2, 25.0), (1, 0.0)));
}

#[test]
fn finer_sampling_changes_nothing() {
    let coarse = crossing();
    let fine = lumencut_scenes::trees::finer(&coarse);
    let camera = front([90, 90], 1.3);
    let (a, b) = (seen(&coarse, &camera, 12.0, 40.0), seen(&fine, &camera, 12.0, 40.0));
    assert_eq!((a.depth(), &a.vessel), (b.depth(), &b.vessel));
}

#[test]
fn unknown_radii_count_as_the_setting_says() {
    let thin = tree(vec![
        vessel(&[[-60., 0., 0.], [60., 0., 0.]], 0.0),
        vessel(&[[0., 40., -60.], [0., 40., 60.]], 4.0),
    ]);
    let (camera, settings) = (front([60, 60], 1.0), Settings { unknown_radius: 3.0, ..Settings::default() });
    let parameters = CrParameters { radius_offset: 0.0, ..CrParameters::default() };
    let frame = cr(&LeveledTree::new(thin), &parameters, &Request::new(&camera, &settings)).unwrap();
    assert_eq!(frame.vessel[pixel(&frame, 0.5, 2.5)], 0);
    assert_eq!(frame.vessel[pixel(&frame, 0.5, 3.5)], 1);
}

#[test]
fn bad_thresholds_are_refused() {
    let (camera, settings, tree) = (front([8, 8], 1.0), Settings::default(), LeveledTree::new(trefoil(60)));
    for bad in [-1.0, f64::NAN, f64::INFINITY, 1e7] {
        for parameters in [
            CrParameters { radius_offset: bad, ..CrParameters::default() },
            CrParameters { arc_threshold: bad, ..CrParameters::default() },
        ] {
            let error = cr(&tree, &parameters, &Request::new(&camera, &settings)).unwrap_err();
            assert_eq!(error.kind, ErrorKind::Settings);
            assert!(error.to_string().contains("pixels"), "{error}");
        }
    }
    let nowhere = LeveledTree::new(lumencut_scenes::trees::tree(vec![vessel(&[[1., 2., 3.]; 2], 1.0)]));
    let error = cr(&nowhere, &CrParameters::default(), &Request::new(&camera, &settings)).unwrap_err();
    assert_eq!(error.kind, ErrorKind::VesselTree);
}
