//! Smoothed centerlines: closed forms, points that stay bit-identical, and degenerate vessels.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};
use std::time::{Duration, Instant};

use glam::DVec3;
use lumencut_core::frame::Frame;
use lumencut_core::math::centerline_smoothing::smooth_centerlines;
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::{MAX_COORDINATE, Vessel, VesselTree};
use lumencut_scenes::brute_force::{by_brute_force, by_hierarchy};
use lumencut_scenes::compare::different_pixels;
use lumencut_scenes::random::Random;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::view;

/// Rounding of coordinates of some hundred mm, summed along a vessel (mm).
const ROUNDING: f64 = 1e-10;

/// Error of the Gaussian's layers and of the chords of a finely sampled arc (share of the arc's radius R).
const CLOSED_FORM: f64 = 1e-4;

fn line(points: Vec<DVec3>, radius: f64) -> Vessel {
    let radii = vec![radius; points.len()];
    Vessel::new(points, Some(radii)).unwrap()
}

fn smoothed(vessel: Vessel, radii: f64) -> Vec<DVec3> {
    smooth_centerlines(&tree(vec![vessel]), radii).vessels()[0].points().to_vec()
}

fn reversed(vessel: &Vessel) -> Vessel {
    let radius = vessel.radius().map(|r| r.iter().rev().copied().collect());
    Vessel::new(vessel.points().iter().rev().copied().collect(), radius).unwrap()
}

#[test]
fn a_circle_shrinks_as_the_gaussian_predicts() {
    let (radius, turns) = (10.0_f64, 3.0);
    for sigma in [0.5, 1.0, 3.0, 6.0] {
        // The points are spaced unevenly, since the curve is averaged and not its points.
        let angle = |t: f64| TAU * turns * (t + 0.02 * (9.0 * PI * t).sin());
        let place = |i: i32| {
            let (sin, cos) = angle(f64::from(i) / 4000.0).sin_cos();
            DVec3::new(cos, sin, 0.0) * radius + DVec3::new(20.0, -7.0, 3.0)
        };
        let found = smoothed(line((0..=4000).map(place).collect(), 2.0), sigma / 2.0);
        let expected = radius * (-sigma * sigma / (2.0 * radius * radius)).exp();
        for point in &found[1900..2100] {
            let shrunk = (*point - DVec3::new(20.0, -7.0, 3.0)).length();
            assert!((shrunk - expected).abs() < CLOSED_FORM * radius, "{shrunk} and {expected}, σ {sigma}");
        }
    }
}

#[test]
fn a_helix_shrinks_but_keeps_its_pitch() {
    let (radius, pitch, sigma) = (8.0_f64, 5.0, 2.0);
    let place = |i: i32| {
        let angle = f64::from(i) * 0.01;
        DVec3::new(radius * angle.cos(), radius * angle.sin(), pitch * angle)
    };
    let points: Vec<_> = (0..=4000).map(place).collect();
    let found = smoothed(line(points.clone(), 4.0), sigma / 4.0);
    // One radian takes √(R² + p²) of arc length.
    let expected = radius * (-sigma * sigma / (2.0 * (radius * radius + pitch * pitch))).exp();
    for i in 1500..2500 {
        assert!((found[i].truncate().length() - expected).abs() < CLOSED_FORM * radius);
        assert!((found[i].z - points[i].z).abs() < CLOSED_FORM * radius);
    }
}

#[test]
fn straight_lines_stay_however_they_are_sampled() {
    let mut random = Random::new(5);
    let (start, direction) = (DVec3::new(-120.0, 44.0, 300.0), DVec3::new(2.0, -1.0, 0.5));
    let mut along = 0.0;
    let points: Vec<_> = (0..300)
        .map(|_| {
            along += random.number().powi(4) * 3.0;
            start + direction * along
        })
        .collect();
    for radii in [0.3, 1.0, 10.0] {
        for (found, point) in smoothed(line(points.clone(), 4.0), radii).iter().zip(&points) {
            assert!(found.distance(*point) < ROUNDING, "{found} and {point}");
        }
    }
}

#[test]
fn jitter_falls_as_the_gaussian_predicts() {
    let (step, sigma, jitter) = (0.5, 4.0, 0.1);
    let mut random = Random::new(11);
    // Jitter is only across the line: jitter along it would just be another sampling of the line.
    let mut across = || (random.number() + random.number() + random.number() - 1.5) * 2.0 * jitter;
    let points: Vec<_> = (0..8000).map(|i| DVec3::new(f64::from(i) * step, across(), across())).collect();
    let found = smoothed(line(points.clone(), 2.0), sigma / 2.0);
    let spread = |points: &[DVec3]| {
        let inner = &points[100..7900];
        let squares: f64 = inner.iter().map(|p| p.y * p.y + p.z * p.z).sum();
        (squares / (2.0 * inner.len() as f64)).sqrt()
    };
    let arc: f64 = points.windows(2).map(|p| p[0].distance(p[1])).sum::<f64>() / 7999.0;
    let expected = (arc / (2.0 * PI.sqrt() * sigma)).sqrt();
    let factor = spread(&found) / spread(&points);
    assert!((spread(&points) - jitter).abs() < 0.01);
    assert!((factor / expected - 1.0).abs() < 0.1, "{factor} and {expected}");
}

/// A trunk on which another vessel ends, a vessel without radii, and one with radius 0 in its middle.
fn junctions() -> VesselTree {
    let mut random = Random::new(3);
    let mut walk = |from: DVec3, along: DVec3, count: i32| -> Vec<DVec3> {
        (0..count)
            .map(|i| {
                from + along * f64::from(i) + if i > 0 { random.next_point() * 0.3 } else { DVec3::ZERO }
            })
            .collect()
    };
    let trunk = walk(DVec3::ZERO, DVec3::X, 60);
    // The branch starts 0.0005 mm off the trunk's point.
    let branch = walk(trunk[25] + DVec3::Z * 5e-4, DVec3::Y, 40);
    let (bare, partly) = (walk(DVec3::splat(50.0), DVec3::Y, 30), walk(branch[39], DVec3::Z, 30));
    let radii = (0..30).map(|i| if (10..15).contains(&i) { 0.0 } else { 2.0 }).collect();
    tree(vec![
        line(trunk, 3.0),
        line(branch, 2.0),
        Vessel::new(bare, None).unwrap(),
        Vessel::new(partly, Some(radii)).unwrap(),
    ])
}

#[test]
fn ends_joints_and_points_without_radius_stay_to_the_bit() {
    let before = junctions();
    let after = smooth_centerlines(&before, 1.0);
    let stays: [&[usize]; 4] =
        [&[0, 25, 59], &[0, 39], &(0..30).collect::<Vec<_>>(), &[0, 10, 11, 12, 13, 14, 29]];
    for ((old, new), stays) in before.vessels().iter().zip(after.vessels()).zip(stays) {
        assert_eq!(old.radius(), new.radius());
        assert_eq!(old.points().len(), new.points().len());
        for (i, (p, q)) in old.points().iter().zip(new.points()).enumerate() {
            let same = p.to_array().map(f64::to_bits) == q.to_array().map(f64::to_bits);
            assert_eq!(same, stays.contains(&i), "point {i}");
        }
    }
}

#[test]
fn a_vessel_is_smoothed_on_both_sides_of_a_joint_as_if_it_were_cut_there() {
    let scene = junctions();
    let (joined, trunk) = (smooth_centerlines(&scene, 1.0), &scene.vessels()[0]);
    let parts = [&trunk.points()[..=25], &trunk.points()[25..]];
    let found = parts.map(|part| smoothed(line(part.to_vec(), 3.0), 1.0));
    assert_eq!(joined.vessels()[0].points()[..=25], found[0]);
    assert_eq!(joined.vessels()[0].points()[25..], found[1]);
}

#[test]
fn a_reversed_vessel_gives_the_reversed_result() {
    let scene = random_tree(21, 12, 150, 1.5, 80.0).unwrap();
    let turned = tree(scene.vessels().iter().map(reversed).collect());
    for radii in [0.2, 1.0, 5.0, 10.0] {
        let (a, b) = (smooth_centerlines(&scene, radii), smooth_centerlines(&turned, radii));
        for (one, other) in a.vessels().iter().zip(b.vessels()) {
            for (p, q) in one.points().iter().zip(other.points().iter().rev()) {
                assert!(p.distance(*q) < ROUNDING, "{p} and {q}");
            }
        }
    }
}

#[test]
fn more_smoothing_moves_more_and_a_little_moves_little() {
    let scene = trefoil(400);
    let most = |radii: f64| {
        let after = smooth_centerlines(&scene, radii);
        let pairs = scene.vessels()[0].points().iter().zip(after.vessels()[0].points());
        pairs.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
    };
    let shifts = [0.0, 0.01, 0.1, 0.5, 1.0, 2.0, 10.0].map(most);
    assert_eq!(shifts[0], 0.0);
    assert!(shifts[1] < 0.02, "{shifts:?}");
    assert!(shifts.windows(2).all(|s| s[0] < s[1]), "{shifts:?}");
}

fn frame(scene: &VesselTree, centerline_smoothing: f64) -> Frame {
    let settings = Settings { centerline_smoothing, ..Settings::default() };
    by_hierarchy(scene, &view([1.0, 2.0, 3.0], [121, 90], 1.3), &settings)
}

#[test]
fn none_gives_the_same_tree_and_some_the_picture_of_the_smoothed_tree() {
    let scene = random_tree(41, 14, 60, 2.0, 70.0).unwrap();
    assert_eq!(smooth_centerlines(&scene, 0.0), scene);
    let quiet = smooth_centerlines(&scene, 1.5);
    assert_ne!(quiet, scene);
    let (set, given) = (frame(&scene, 1.5), frame(&quiet, 0.0));
    assert_eq!(different_pixels(&set, &given), 0);
    let settings = Settings { centerline_smoothing: 1.5, ..Settings::default() };
    let slow = by_brute_force(&scene, &view([1.0, 2.0, 3.0], [121, 90], 1.3), &settings);
    assert_eq!(different_pixels(&set, &slow), 0);
    assert!(different_pixels(&set, &frame(&scene, 0.0)) > 1000);
}

#[test]
fn odd_vessels_give_finite_points_that_stay_in_bounds() {
    let same = line(vec![DVec3::splat(7.0); 9], 2.0);
    let two = line(vec![DVec3::ZERO, DVec3::X], 5.0);
    let repeated = line([0, 0, 1, 1, 1, 5, 5, 3, 9, 9].map(|x| DVec3::X * f64::from(x)).to_vec(), 1.0);
    let there_and_back = line([0, 4, 8, 4, 0].map(|x| DVec3::Y * f64::from(x)).to_vec(), 1.0);
    let tiny = line((0..9).map(|i| DVec3::new(f64::from(i), f64::from(i % 2), 0.0) * 1e-300).collect(), 2.0);
    let corner = |i: i32| DVec3::splat(if i % 3 == 0 { -MAX_COORDINATE } else { MAX_COORDINATE });
    let huge = line((0..50).map(corner).collect(), MAX_COORDINATE);
    let wide = trefoil(50).vessels()[0].clone();
    let wide = line(wide.points().to_vec(), 1e6);
    let odd = tree(vec![same, two, repeated, there_and_back, tiny, huge, wide]);
    for radii in [1e-9, 0.5, 10.0] {
        let after = smooth_centerlines(&odd, radii);
        for (old, new) in odd.vessels().iter().zip(after.vessels()) {
            // The constructor would reject points that are not finite or out of bounds.
            assert!(Vessel::new(new.points().to_vec(), None).is_ok());
            assert_eq!(old.points().len(), new.points().len());
        }
        assert_eq!(after.vessels()[..2], odd.vessels()[..2]);
        frame(&odd, radii);
    }
}

#[test]
fn a_gaussian_longer_than_the_vessel_gives_the_line_between_its_ends() {
    let arc = |i: i32| DVec3::new((f64::from(i) * 0.1).cos(), (f64::from(i) * 0.1).sin(), 0.0) * 9.0;
    let points: Vec<_> = (0..30).map(arc).collect();
    let (start, chord) = (points[0], points[29] - points[0]);
    for point in smoothed(line(points, 50.0), 10.0) {
        let along = (point - start).dot(chord) / chord.length_squared();
        assert!(point.distance(start + chord * along) < 1e-3, "{point}");
        assert!((-1e-3..1.001).contains(&along));
    }
}

#[test]
fn thousands_of_vessels_that_share_a_point_are_quick() {
    let mut random = Random::new(8);
    let star = (0..10_000).map(|_| {
        let steps = [0.0, 1.0, 2.0, 3.0];
        line(steps.map(|step| random.next_point() * step).to_vec(), 2.0)
    });
    let star = tree(star.collect());
    let start = Instant::now();
    let after = smooth_centerlines(&star, 10.0);
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    assert!(after.vessels().iter().all(|v| v.points().iter().all(|p| p.is_finite())));
    let long = line((0..20_000).map(|_| random.next_point() * 100.0).collect(), 1000.0);
    let start = Instant::now();
    smoothed(long, 10.0);
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    // A zigzag between the two ends of another vessel, so that every point is an end.
    let ends = vessel(&[[0.0; 3], [1.0, 0.0, 0.0]], 1.0);
    let zigzag: Vec<_> = (0..1000).map(|i| DVec3::X * f64::from(i % 2)).collect();
    let both = tree(vec![ends, line(zigzag.clone(), 1.0)]);
    assert_eq!(smooth_centerlines(&both, 1.0).vessels()[1].points(), zigzag);
}
