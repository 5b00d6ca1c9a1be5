//! mpCPR compared with closed forms, and with an independent search of all points in every row.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::ErrorKind;
use lumencut_core::frame::Frame;
use lumencut_core::math::lanes::FAR;
use lumencut_core::math::leaps::{LEAPS, LUMEN};
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::reformations::NO_VESSEL;
use lumencut_core::reformations::mpcpr::mpcpr;
use lumencut_core::scene::{LeveledTree, Scene};
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_phantom::y_junction;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::{at, front, pixel, view};

fn seen(tree: &VesselTree, camera: &Camera) -> Frame {
    let settings = Settings::default();
    mpcpr(&LeveledTree::new(tree.clone()), &Request::new(camera, &settings)).unwrap()
}

/// For each pixel of a row, from all segments: depth, vessel, and whether the row meets that vessel twice.
fn by_brute_force(tree: &VesselTree, camera: &Camera, j: usize) -> Vec<Option<(f64, i32, bool)>> {
    let y = camera.view_y(j);
    let mut points = Vec::new();
    for (id, vessel) in (0..).zip(tree.vessels()) {
        let view: Vec<DVec3> = vessel.points().iter().map(|p| camera.view_from_world(*p)).collect();
        for (i, ends) in view.windows(2).enumerate() {
            let (a, b) = (ends[0], ends[1]);
            let owns_end = i + 2 == view.len() && b.y == y;
            let crosses = a.y == y || owns_end || (a.y - y) * (b.y - y) < 0.0;
            if crosses {
                let t = (y - a.y) / (b.y - a.y);
                points.push((a.x + t * (b.x - a.x), a.z + t * (b.z - a.z), id));
            }
        }
    }
    let pixel = |i: usize| {
        let x = camera.view_x(i);
        let best = points.iter().min_by(|a, b| {
            (x - a.0).abs().total_cmp(&(x - b.0).abs()).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2))
        })?;
        Some((best.1, best.2, points.iter().filter(|point| point.2 == best.2).count() > 1))
    };
    (0..camera.size()[0]).map(pixel).collect()
}

#[test]
fn every_row_shows_what_a_search_of_all_its_points_finds() {
    let trees = [
        random_tree(3, 12, 60, 2.0, 80.0).unwrap(),
        random_tree(4, 60, 40, 2.0, 80.0).unwrap(),
        trefoil(240),
    ];
    let (mut nothing, mut folded) = (0, 0);
    for tree in &trees {
        for direction in [[0.0, 1.0, 0.0], [1.0, 2.0, 0.5], [0.1, 0.2, -1.0]] {
            let camera = view(direction, [97, 61], 2.9);
            let frame = seen(tree, &camera);
            for p in 0..97 * 61 {
                let (i, j) = (p % 97, p / 97);
                let expected = by_brute_force(tree, &camera, j)[i];
                let (depth, id, is_folded) = expected.unwrap_or((f64::from(FAR), NO_VESSEL, false));
                assert_eq!(frame.depth()[p].to_bits(), (depth as f32).to_bits(), "pixel {i}, {j}");
                assert_eq!((frame.vessel[p], frame.folded[p]), (id, is_folded), "pixel {i}, {j}");
                nothing += usize::from(id == NO_VESSEL);
                folded += usize::from(is_folded);
            }
        }
    }
    let all = trees.len() * 3 * 97 * 61;
    assert!(folded > 1000 && nothing > 1000 && folded + nothing + 1000 < all, "{folded}, {nothing} of {all}");
}

/// Segments span thousands of slots, so that the crossings of a row lie in many blocks.
#[test]
fn long_vessels_lose_no_row() {
    let point = |i: i32| [f64::from(i % 7), 0.01 * f64::from(i), f64::from(i) * 0.05 - 50.0];
    let tree = tree(vec![vessel(&(0..2001).map(point).collect::<Vec<_>>(), 1.0)]);
    let frame = seen(&tree, &front([9, 100], 1.0));
    assert!(frame.vessel.iter().all(|id| *id == 0));
}

#[test]
fn a_row_is_split_midway_between_vessels() {
    let tree = tree(vec![
        vessel(&[[-10., 5., -30.], [-10., 5., 30.]], 2.0),
        vessel(&[[14., -7., -10.], [14., -7., 10.]], 2.0),
    ]);
    let frame = seen(&tree, &front([60, 80], 1.0));
    // x = 2 is midway between the vessels; the second vessel exists only between z = −10 and 10.
    for (x, y, depth, id) in
        [(1.5, 0.5, 5.0, 0), (2.5, 0.5, -7.0, 1), (29.5, 9.5, -7.0, 1), (29.5, 10.5, 5.0, 0)]
    {
        assert_eq!(at(&frame, frame.depth(), x, y), depth);
        assert_eq!(frame.vessel[pixel(&frame, x, y)], id);
    }
    assert!(frame.folded.iter().all(|is_folded| !is_folded));
}

#[test]
fn equally_far_the_nearer_to_the_viewer_wins_and_then_the_first_vessel() {
    let line = |x: f64, depth: f64| vessel(&[[x, depth, -9.], [x, depth, 9.]], 1.0);
    // The middle column of nine lies at x = 0.
    let frame = seen(&tree(vec![line(-2.0, 4.0), line(2.0, 3.0)]), &front([9, 3], 1.0));
    assert_eq!(frame.vessel[9 + 4], 1);
    let frame = seen(&tree(vec![line(-2.0, 3.0), line(2.0, 3.0)]), &front([9, 3], 1.0));
    assert_eq!(frame.vessel[9 + 4], 0);
    let frame = seen(&tree(vec![line(2.0, 4.0), line(2.0, 3.0), line(2.0, 3.0)]), &front([9, 3], 1.0));
    assert!(frame.vessel.iter().all(|id| *id == 1));
}

#[test]
fn rows_beyond_the_ends_show_nothing() {
    let phantom = y_junction().unwrap();
    let line = tree(vec![vessel(&[[0., 0., -10.], [0., 0., 10.]], 2.0)]);
    let scene = Scene::new(phantom.volume().unwrap(), line);
    let camera = front([40, 40], 1.0);
    let settings = Settings { context: None, background: [0, 0, 0, 0], ..Settings::default() };
    let request = Request::new(&camera, &settings);
    let frame = mpcpr(scene.tree.as_ref().unwrap(), &request).unwrap();
    let shown = CpuRenderer::default().look(scene.volume.as_ref().unwrap(), frame, &request).unwrap();
    for j in 0..40 {
        let is_there = camera.view_y(j).abs() <= 10.0;
        for p in j * 40..(j + 1) * 40 {
            assert_eq!(shown.vessel[p] == 0, is_there);
            assert_eq!(shown.depth()[p] < FAR, is_there);
            assert!(is_there || (shown.value[p].is_nan() && shown.image[p][3] == 0));
        }
    }
    // The border of empty pixels is no depth jump.
    assert!(shown.leap.iter().all(|leap| leap & LEAPS == 0));
}

#[test]
fn ends_and_turns_on_a_row_are_met_once() {
    // At y = 0.5, 1.5, …: the vessel begins, turns and ends, passes at a point, or runs along a row.
    let line = [[-4., 1., 0.5], [-2., 2., 2.5], [0., 3., 0.5], [1., 4., 1.5], [2., 5., 2.5]];
    let camera = front([16, 8], 1.0);
    let frame = seen(&tree(vec![vessel(&line, 1.0)]), &camera);
    let row = |y: f64| {
        let first = pixel(&frame, -7.5, y);
        (first..first + 16).map(|p| (frame.depth()[p], frame.folded[p])).collect::<Vec<_>>()
    };
    // At y = 0.5 the row meets both turns, at x = −4 and 0; the pixel at x = −2.5 is nearer to the first.
    assert_eq!(row(0.5)[5], (1.0, true));
    assert_eq!(row(0.5)[6], (3.0, true));
    // At y = 2.5 the row meets the turn and the end.
    assert_eq!((row(2.5)[0], row(2.5)[15]), ((2.0, true), (5.0, true)));
    // At y = 1.5 the row meets three points, the last of which joins two segments.
    assert_eq!(row(1.5)[15], (4.0, true));
    let lone = seen(&tree(vec![vessel(&[[0., 7., 0.5], [3., 9., 3.5]], 1.0)]), &camera);
    assert!(lone.folded.iter().all(|is_folded| !is_folded));
    assert_eq!(lone.depth()[pixel(&lone, -7.5, 0.5)], 7.0);
    assert_eq!(lone.depth()[pixel(&lone, -7.5, 3.5)], 9.0);
}

#[test]
fn a_segment_within_a_row_shows_its_point_nearest_along_the_row() {
    let step = vessel(&[[-4.5, 0., -3.5], [-4.5, 0., 0.5], [3.5, 16., 0.5], [3.5, 16., 3.5]], 1.0);
    let frame = seen(&tree(vec![step]), &front([16, 8], 1.0));
    for (x, depth) in [(-7.5, 0.0), (-4.5, 0.0), (-0.5, 8.0), (2.5, 14.0), (7.5, 16.0)] {
        assert_eq!(at(&frame, frame.depth(), x, 0.5), depth);
        assert!(frame.folded[pixel(&frame, x, 0.5)]);
    }
    assert!(!frame.folded[pixel(&frame, 0.5, -0.5)] && !frame.folded[pixel(&frame, 0.5, 1.5)]);
    // A vessel along the view lies at one position, and its nearest point counts.
    let away = vessel(&[[0., 9., 0.5], [0., -3., 0.5]], 1.0);
    let frame = seen(&tree(vec![away]), &front([16, 8], 1.0));
    assert_eq!(at(&frame, frame.depth(), 5.5, 0.5), -3.0);
}

#[test]
fn a_vessel_that_folds_over_a_row_is_shown_up_to_the_middle_of_both_crossings() {
    let arch = vessel(&[[-12., 0., -10.], [-2., 4., 10.], [8., 9., -10.]], 1.0);
    let frame = seen(&tree(vec![arch]), &front([61, 51], 1.0));
    for j in 0..51 {
        // Row 15 contains only the turning point.
        let is_folded = (25 - j as i32).abs() <= 10 && j != 15;
        assert_eq!(frame.folded[j * 61], is_folded, "row {j}");
    }
    // At z = 0 the row crosses it at x = -7 and 3, at depths 2 and 6.5; the middle is x = -2.
    let row = &frame.depth()[25 * 61..26 * 61];
    assert!(row[..28].iter().all(|depth| *depth == 2.0) && row[29..].iter().all(|depth| *depth == 6.5));
}

#[test]
fn a_slanted_vessel_is_as_thin_as_the_geometry_predicts() {
    for (phi, theta) in [(90.0, 0.0), (90.0, 50.0), (60.0, 30.0), (30.0, 45.0), (12.0, 45.0), (20.0, 70.0f64)]
    {
        let [phi, theta]: [f64; 2] = [phi, theta].map(f64::to_radians);
        let along = DVec3::new(phi.cos() * theta.cos(), theta.sin(), phi.sin() * theta.cos());
        let points: Vec<[f64; 3]> = (-150..=150).map(|n| (along * f64::from(n) / 0.75).to_array()).collect();
        let camera = front([801, 101], 0.1);
        let frame = seen(&tree(vec![vessel(&points, 4.0)]), &camera);
        let row = 50 * 801..51 * 801;
        let is_lumen = |p: &usize| {
            let at = DVec3::new(camera.view_x(p % 801), camera.view_y(p / 801), f64::from(frame.depth()[*p]));
            camera.world_from_view(at).cross(along).length() <= 4.0
        };
        let width = row.filter(is_lumen).count() as f64 * 0.1 * phi.sin();
        // A point s along the row is s·√(1 − dx²) off the vessel, and a row crosses the band at the angle φ.
        let expected = 8.0 * phi.sin() / (1.0 - along.x * along.x).sqrt();
        assert!((width - expected).abs() < 0.11, "{width} mm instead of {expected} mm");
    }
}

#[test]
fn leaps_between_vessels_and_lumen_are_told() {
    // The vessel is at 45° to rows and view, d = (1, √2, 1)/2: a point s along the row is s·√(1 − ¼) off.
    let slanted = vessel(&[[-20., -28.284_271_2, -20.], [20., 28.284_271_2, 20.]], 3.0);
    let upright = vessel(&[[30., 60., -20.], [30., 60., 20.]], 1.0);
    let frame = seen(&tree(vec![slanted, upright]), &front([400, 40], 0.25));
    let lumen = (0..400).filter(|i| frame.leap[20 * 400 + i] & LUMEN != 0 && frame.vessel[20 * 400 + i] == 0);
    let expected = 2.0 * 3.0 / 0.75f64.sqrt() / 0.25;
    assert!((lumen.count() as f64 - expected).abs() <= 1.0, "{expected}");
    let leaps = (0..400).filter(|i| frame.leap[20 * 400 + i] & 1 != 0).count();
    assert_eq!(leaps, 1, "one leap to the right in each row: midway between the vessels");
}

#[test]
fn vessels_without_length_are_refused() {
    let nowhere = tree(vec![vessel(&[[0., 0., 0.], [1., 0., 5.]], 1.0), vessel(&[[1., 2., 3.]; 2], 1.0)]);
    let (camera, settings) = (front([8, 8], 1.0), Settings::default());
    let error = mpcpr(&LeveledTree::new(nowhere), &Request::new(&camera, &settings)).unwrap_err();
    assert_eq!(error.kind, ErrorKind::VesselTree);
    assert!(error.to_string().contains("vessel 1 of the tree"), "{error}");
}

#[test]
fn a_request_to_stop_ends_it() {
    let (camera, settings) = (front([8, 8], 1.0), Settings::default());
    let request = Request { stop: &|| true, ..Request::new(&camera, &settings) };
    let error = mpcpr(&LeveledTree::new(trefoil(60)), &request).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Interrupted);
}
