//! The cut surface compared with closed forms, and its invariants.
#![allow(clippy::unwrap_used)]

use glam::{DQuat, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::settings::{DistanceRule, Settings};
use lumencut_core::vessel_tree::Vessel;
use lumencut_scenes::brute_force::by_hierarchy;
use lumencut_scenes::compare::different_pixels;
use lumencut_scenes::lumen::nearest_lumen;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::settings::{paper_unfiltered, unfiltered};
use lumencut_scenes::tolerances::{CLOSED_FORM, LUMEN, REORDERED_DEPTH, REORDERED_VESSEL, SYMMETRIC, TURNED};
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::{at, front, pixel, view};

fn near(found: f32, expected: f64) {
    let apart = (f64::from(found) - expected).abs();
    assert!(apart <= f64::from(CLOSED_FORM.apart), "found {found}, expected {expected}");
}

#[test]
fn a_slanted_tube_is_cut_along_its_foot_points() {
    let tree = tree(vec![vessel(&[[-30., -12., 0.], [30., 12., 0.]], 4.0)]);
    let frame = by_hierarchy(&tree, &front([100, 80], 1.0), &paper_unfiltered());
    for (x, y) in [(-29.5, 0.5), (0.5, 30.5), (12.5, -20.5), (29.5, 39.5)] {
        near(at(&frame, frame.depth(), x, y), x * 0.4);
        near(at(&frame, &frame.distance, x, y), y.abs());
    }
    // Before the first point and beyond the last one, the half-planes keep the depth of the ends.
    near(at(&frame, frame.depth(), -40.5, 9.5), -12.0);
    near(at(&frame, frame.depth(), 45.5, -3.5), 12.0);
    near(at(&frame, &frame.distance, 45.5, -3.5), 15.5f64.hypot(3.5));
}

#[test]
fn a_bend_has_a_wedge_on_its_outside_and_the_nearer_stripe_inside() {
    let corner = vessel(&[[-40., 0., 0.], [0., 10., 0.], [0., 50., 40.]], 0.0);
    let settings = Settings { levels: 0, ..paper_unfiltered() };
    let frame = by_hierarchy(&tree(vec![corner]), &front([120, 120], 1.0), &settings);
    // Outside the bend every pixel belongs to the corner point.
    for (x, y) in [(5.5, -5.5), (30.5, -0.5), (0.5, -30.5)] {
        near(at(&frame, frame.depth(), x, y), 10.0);
    }
    // Inside the bend, 10 mm from the first edge and 5 mm from the second, the smaller cost wins.
    let (x, y) = (-4.5, 10.5);
    let first = (10.0 * (x + 40.0) / 40.0, y);
    let second = (10.0 + y, -x);
    let cost = |(z, d): (f64, f64)| z + 10.0 * d;
    let expected = if cost(first) < cost(second) { first.0 } else { second.0 };
    near(at(&frame, frame.depth(), x, y), expected);
}

#[test]
fn between_two_tubes_the_border_lies_where_their_costs_meet() {
    let front_tube = vessel(&[[-50., 0., 15.], [50., 0., 15.]], 3.0);
    let back_tube = vessel(&[[-50., 40., -15.], [50., 40., -15.]], 5.0);
    let frame = by_hierarchy(&tree(vec![back_tube, front_tube]), &front([16, 600], 0.1), &paper_unfiltered());
    // The costs are equal at 0 + 10·((15 − y) − 3) = 40 + 10·((y + 15) − 5), which gives y = −1.
    for y in [-14.95, -4.95, -1.05] {
        assert_eq!(frame.vessel[pixel(&frame, 0.05, y)], 0, "at y = {y}");
    }
    for y in [-0.95, 2.05, 15.05, 29.95] {
        assert_eq!(frame.vessel[pixel(&frame, 0.05, y)], 1, "at y = {y}");
    }
}

#[test]
fn lumen_first_shows_the_lumen_that_a_near_surrounding_hides() {
    let near_tube = vessel(&[[-50., 0., 12.], [50., 0., 12.]], 3.0);
    let far_tube = vessel(&[[-50., 200., 0.], [50., 200., 0.]], 4.0);
    let scene = tree(vec![near_tube, far_tube]);
    let camera = front([16, 400], 0.1);
    let hidden = by_hierarchy(&scene, &camera, &paper_unfiltered());
    assert_eq!(hidden.vessel[pixel(&hidden, 0.05, 0.05)], 0);
    let margin = Settings { lumen_first: true, lumen_margin: 1.0, ..unfiltered() };
    let shown = by_hierarchy(&scene, &camera, &margin);
    for (y, id) in [(0.05, 1), (3.95, 1), (4.95, 1), (5.05, 0), (-4.95, 1), (8.05, 0)] {
        assert_eq!(shown.vessel[pixel(&shown, 0.05, y)], id, "at y = {y}");
    }
}

#[test]
fn a_vessel_that_dives_along_the_view_goes_on_behind() {
    // The vessel runs right at depth 0, then 60 mm straight into depth, then up.
    let diving = vessel(&[[-40., 0., 0.], [0., 0., 0.], [0., 30., 0.], [0., 60., 0.], [0., 60., 40.]], 2.0);
    let settings = Settings { levels: 0, ..paper_unfiltered() };
    let frame = by_hierarchy(&tree(vec![diving]), &front([120, 120], 1.0), &settings);
    near(at(&frame, frame.depth(), -20.5, 0.5), 0.0);
    near(at(&frame, frame.depth(), 10.5, -10.5), 0.0);
    // Above the run into depth, the half-plane at depth 0 (distance 25 − 2) loses to the stripe at depth 60.
    near(at(&frame, frame.depth(), 0.5, 25.5), 60.0);
}

#[test]
fn a_vessel_along_the_view_shows_its_nearest_point_everywhere() {
    let axis = vessel(&[[3., 20., 4.], [3., -35., 4.], [3., 50., 4.]], 2.0);
    let settings = Settings { levels: 0, ..paper_unfiltered() };
    let frame = by_hierarchy(&tree(vec![axis]), &front([40, 40], 2.0), &settings);
    assert!(frame.depth().iter().all(|z| *z == -35.0));
    near(at(&frame, &frame.distance, 3.0, 15.0), 11.0);
}

#[test]
fn a_run_at_an_end_gives_a_plane_through_the_end_point() {
    let late = vessel(&[[-30., 0., 0.], [0., 0., 0.], [0., 25., 0.]], 0.0);
    let settings = Settings { levels: 0, cost_weight: 1.0, ..paper_unfiltered() };
    let frame = by_hierarchy(&tree(vec![late]), &front([80, 80], 1.0), &settings);
    near(at(&frame, frame.depth(), -10.5, 0.5), 0.0);
    near(at(&frame, frame.depth(), 20.5, 0.5), 25.0);
    // The end's plane covers every pixel, so it wins wherever its cost is lower than the stripe's.
    near(at(&frame, frame.depth(), -0.5, 39.5), 0.0);
}

#[test]
fn the_trefoil_is_threefold_symmetric() {
    let knot = trefoil(300);
    let camera = front([160, 160], 1.0);
    let turn = DQuat::from_axis_angle(DVec3::Y, std::f64::consts::TAU / 3.0);
    let turned = Camera::new(DVec3::ZERO, DVec3::Y, turn * DVec3::Z, [160, 160], 1.0).unwrap();
    // Only level 0: coarser levels depend on where the vessel starts, which breaks the symmetry.
    let settings = Settings { levels: 0, ..paper_unfiltered() };
    let (a, b) = (by_hierarchy(&knot, &camera, &settings), by_hierarchy(&knot, &turned, &settings));
    SYMMETRIC.assert_same(a.depth(), b.depth(), "depths");
    let spread = a.depth().iter().fold(0f32, |s, z| s.max(z.abs()));
    assert!(spread > 15.0, "the knot is flat: {spread}");
}

#[test]
fn the_distance_to_the_whole_curve_hides_most_of_the_trefoil() {
    let (knot, camera) = (trefoil(300), front([400, 400], 0.4));
    let shown = |distance_rule| {
        let settings = Settings { distance_rule, ..paper_unfiltered() };
        let frame = by_hierarchy(&knot, &camera, &settings);
        let points = knot.vessels()[0].points().iter().map(|point| camera.view_from_world(*point));
        points.filter(|p| (f64::from(at(&frame, frame.depth(), p.x, p.y)) - p.z).abs() < 0.5).count()
    };
    // Three crossings hide a tenth of the line. With the whole curve, its front part wins wherever it is above the line.
    let [local, whole] = [DistanceRule::Local, DistanceRule::WholeCurve].map(shown);
    assert!((260..285).contains(&local), "{local}");
    assert!((80..140).contains(&whole), "{whole}");
}

#[test]
fn the_whole_curve_counts_only_by_the_cost_of_the_paper() {
    let settings = Settings { distance_rule: DistanceRule::WholeCurve, ..Settings::default() };
    assert_eq!(settings.check().unwrap_err().subject, "distance_rule");
    assert!(Settings { lumen_first: false, ..settings }.check().is_ok());
}

#[test]
fn a_hidden_vessel_changes_nothing() {
    let shown = random_tree(21, 6, 40, 2.0, 50.0).unwrap();
    let behind = |v: &Vessel| {
        let points = v.points().iter().map(|p| *p + DVec3::Y * 500.0).collect();
        Vessel::new(points, v.radius().map(<[f64]>::to_vec)).unwrap()
    };
    let both = shown.vessels().iter().cloned().chain(shown.vessels().iter().map(behind)).collect();
    let camera = front([90, 90], 1.3);
    let both = tree(both);
    for settings in [paper_unfiltered(), unfiltered()] {
        let [a, b] = [&shown, &both].map(|tree| by_hierarchy(tree, &camera, &settings));
        assert_eq!(different_pixels(&a, &b), 0);
    }
}

#[test]
fn the_order_of_the_vessels_does_not_matter() {
    let scene = random_tree(22, 9, 40, 2.0, 50.0).unwrap();
    let reversed = tree(scene.vessels().iter().rev().cloned().collect());
    let camera = view([0.4, 1.0, -0.2], [90, 90], 1.3);
    for settings in [paper_unfiltered(), unfiltered()] {
        let (a, b) = (by_hierarchy(&scene, &camera, &settings), by_hierarchy(&reversed, &camera, &settings));
        let last = scene.vessels().len() as i32 - 1;
        // Vessels that share an end point have equal keys around it; elsewhere nothing differs.
        REORDERED_DEPTH.assert_same(a.depth(), b.depth(), "depths");
        let ids = (0..a.depth().len()).filter(|p| a.vessel[*p] != last - b.vessel[*p]).count();
        assert!(REORDERED_VESSEL.allows(ids, a.depth().len()), "{ids} ids differ");
        assert_eq!(a.distance, b.distance);
    }
}

#[test]
fn turning_scene_and_camera_together_changes_nothing() {
    let scene = random_tree(23, 8, 40, 2.0, 50.0).unwrap();
    let turn = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.1);
    let turned = |v: &Vessel| {
        let points = v.points().iter().map(|p| turn * *p).collect();
        Vessel::new(points, v.radius().map(<[f64]>::to_vec)).unwrap()
    };
    let turned_scene = tree(scene.vessels().iter().map(turned).collect());
    let camera = view([0.4, 1.0, -0.2], [90, 90], 1.3);
    let turned_camera =
        Camera::new(DVec3::ZERO, turn * camera.direction(), turn * camera.up(), [90, 90], 1.3).unwrap();
    for settings in [paper_unfiltered(), unfiltered()] {
        let a = by_hierarchy(&scene, &camera, &settings);
        let b = by_hierarchy(&turned_scene, &turned_camera, &settings);
        TURNED.assert_same(a.depth(), b.depth(), "depths");
    }
}

#[test]
fn a_lumen_is_never_hidden_by_what_lies_behind_it() {
    let scene = random_tree(24, 10, 50, 2.0, 50.0).unwrap();
    let camera = view([1.0, 0.3, 0.2], [80, 80], 1.4);
    let settings = Settings { levels: 0, ..paper_unfiltered() };
    let cost = by_hierarchy(&scene, &camera, &settings);
    let first = by_hierarchy(&scene, &camera, &Settings { lumen_first: true, ..settings });
    let (mut lumens, mut behind, mut other) = (0, 0, 0);
    for p in 0..cost.depth().len() {
        let (x, y) = (camera.view_x(p % 80), camera.view_y(p / 80));
        if let Some(nearest) = nearest_lumen(&scene, &camera, x, y) {
            lumens += 1;
            let apart = |depth: f32| f64::from(depth) - nearest;
            behind += usize::from(apart(cost.depth()[p]) > f64::from(LUMEN.apart));
            other += usize::from(apart(first.depth()[p]).abs() > f64::from(LUMEN.apart));
        }
    }
    assert!(lumens > 500, "only {lumens} pixels show lumen");
    assert_eq!((behind, other), (0, 0), "of {lumens} pixels in a lumen");
}

#[test]
fn on_a_tie_the_earlier_piece_wins() {
    // From the front, 1.5 mm above the shallow line both costs are equal: 0 + 10 · 1.5 = 10 + 10 · 0.5.
    let (shallow, deep) = ([[-64., 0., 0.], [64., 0., 0.]], [[64., 10., 2.], [-64., 10., 2.]]);
    let camera = front([2, 8], 1.0);
    let settings = Settings { levels: 0, ..paper_unfiltered() };
    for deep_first in [true, false] {
        let lines = if deep_first { [deep, shallow] } else { [shallow, deep] };
        let linked = tree(vec![vessel(&lines.concat(), 0.0)]);
        let parted = tree(lines.iter().map(|line| vessel(line, 0.0)).collect());
        for (scene, ids) in [(linked, [0; 3]), (parted, [i32::from(!deep_first), 0, i32::from(deep_first)])] {
            let frame = by_hierarchy(&scene, &camera, &settings);
            let seen = [2, 4, 6].map(|p| (frame.depth()[p], frame.vessel[p]));
            let tie = if deep_first { 10.0 } else { 0.0 };
            assert_eq!(seen, [(10.0, ids[0]), (tie, ids[1]), (0.0, ids[2])], "deep first: {deep_first}");
        }
    }
}

#[test]
fn a_point_nearly_repeated_changes_little() {
    let settings = Settings { levels: 0, ..unfiltered() };
    let camera = Camera::new(DVec3::new(0.0, 30.0, 0.0), DVec3::Y, DVec3::Z, [60, 60], 1.0).unwrap();
    let seen = |apart: f64| {
        let line = [[-20., 0., 0.], [-apart, 10., 0.], [0., 10., 0.], [0., 60., 20.], [-20., 70., 20.]];
        by_hierarchy(&tree(vec![vessel(&line, 1.0)]), &camera, &settings)
    };
    let exact = seen(0.0);
    for apart in [1e-9, 5e-4, 2e-3] {
        let near = seen(apart);
        let differ = |p: &usize| (near.depth()[*p] - exact.depth()[*p]).abs() > 0.1;
        let different = (0..exact.depth().len()).filter(differ).count();
        assert!(different <= 7, "{different} pixels differ by a point {apart} mm away");
    }
}

#[test]
fn panning_changes_no_depth() {
    let scene = tree(vec![vessel(&[[0., 0., 0.], [9., 8., 7.]], 1.0)]);
    let camera = view([0.3, 0.9, -0.2], [60, 40], 0.7);
    let aside = camera.center() + camera.right() * 7.0 * 0.7 + camera.up() * 4.0 * 0.7;
    let panned = Camera::new(aside, camera.direction(), camera.up(), [60, 40], 0.7).unwrap();
    let [before, after] = [&camera, &panned].map(|camera| by_hierarchy(&scene, camera, &unfiltered()));
    for p in (0..36).flat_map(|j| (0..53).map(move |i| j * 60 + i + 7)) {
        let apart = (after.depth()[p + 4 * 60 - 7] - before.depth()[p]).abs();
        assert!(apart < 1e-4, "{apart} mm at pixel {p}");
    }
}
