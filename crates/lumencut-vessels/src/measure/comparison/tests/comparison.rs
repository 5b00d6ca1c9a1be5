use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::matching::MatchedBy;
use super::{Comparison, compare};
use crate::measure::profile::Profile;
use crate::measure::section::flags::{BRANCH, NO_EDGE};
use crate::measure::stenosis::made_profile::profile;

/// Standard deviation of the diameters in both scans (mm).
const UNSURE: [f64; 2] = [0.1, 0.15];
const STEP: f64 = 0.5;

/// A curve without symmetry, at arc lengths of about `at` mm.
fn curve(at: f64) -> DVec3 {
    let turn = at / 35.0;
    DVec3::new(25.0 * turn.sin() + 0.002 * at * at, 18.0 * (1.7 * turn).cos(), 0.8 * at)
}

/// A bump of height 1 around 60 mm, 20 mm long.
fn bump(at: f64) -> f64 {
    let away = ((at - 60.0) / 10.0).abs();
    if away < 1.0 { 0.5 + 0.5 * (PI * away).cos() } else { 0.0 }
}

/// The vessel from `from` to 120 mm on the curve, narrowed by `depth` mm.
fn vessel(line: impl Fn(f64) -> DVec3, from: f64, depth: f64, unsure: f64) -> Profile {
    let count = ((120.0 - from) / STEP) as usize + 1;
    let place = |n: usize| from + STEP * n as f64;
    // Half a standard deviation of noise that has no period in common with the sections.
    let noise = |n: usize| 0.5 * unsure * (TAU * 0.377 * n as f64 + from).sin();
    let width = |n: usize| [8.0 - 0.01 * place(n) - depth * bump(place(n)) + noise(n), unsure];
    let mut made = profile(&(0..count).map(width).collect::<Vec<_>>());
    made.on_vessel = (0..count).map(|n| line(place(n))).collect();
    made.arc_length = lumencut_core::math::arc_length::arc_lengths(&made.on_vessel);
    made
}

fn moved(point: DVec3) -> DVec3 {
    DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.5) * point + DVec3::new(40.0, -25.0, 300.0)
}

fn both(depth: f64) -> [Profile; 2] {
    [vessel(curve, 0.0, 1.0, UNSURE[0]), vessel(|at| moved(curve(at)), 12.0, 1.0 + depth, UNSURE[1])]
}

/// The arc length on the first vessel at this parameter of the curve.
fn along(first: &Profile, parameter: f64) -> f64 {
    first.arc_length[(parameter / STEP) as usize]
}

fn only_change(found: &Comparison) -> [f64; 2] {
    let [change] = &found.changes[..] else { panic!("{} changes", found.changes.len()) };
    change.range
}

#[test]
fn a_stenosis_that_grew_is_found_where_it_is_by_as_much_as_it_grew() {
    let [first, second] = both(1.5);
    let found = compare(&first, &second, &[]).unwrap();
    assert_eq!((found.matching.by, found.matching.is_reversed), (MatchedBy::Shape, false));
    assert!(found.matching.deviation < 1.5 && found.matching.apart < 0.1);
    for (n, place) in found.places.iter().enumerate() {
        let parameter = STEP * n as f64;
        if !(12.5..119.0).contains(&parameter) {
            continue;
        }
        let expected = second.arc_length[((parameter - 12.0) / STEP) as usize];
        assert!((place.at[1] - expected).abs() < 0.3, "{parameter}: {} for {expected}", place.at[1]);
        let grown = -1.5 * bump(parameter);
        assert!((place.difference - grown).abs() <= 2.0 * place.difference_uncertainty, "{parameter}");
        assert!(place.difference_uncertainty >= UNSURE[0].hypot(UNSURE[1]) - 1e-9);
    }
    let [from, to] = only_change(&found);
    assert!(from > along(&first, 50.0) && to < along(&first, 70.0));
    let largest = found.changes[0].largest;
    assert!((largest.difference + 1.5).abs() < 0.2 && (largest.at[0] - along(&first, 60.0)).abs() < 2.0);
    assert!(found.typical.abs() < 0.1);
}

#[test]
fn a_rigid_motion_is_no_change_and_nothing_is_compared_beyond_the_ends() {
    let [first, second] = both(0.0);
    let found = compare(&first, &second, &[]).unwrap();
    assert!(found.changes.is_empty());
    assert!(found.places[..23].iter().all(|place| place.difference.is_nan()));
    assert!(found.places[26..239].iter().all(|place| place.difference.is_finite()));
    for n in [40, 100, 200] {
        assert!(found.matching.motion.of(first.on_vessel[n]).distance(moved(first.on_vessel[n])) < 0.05);
    }
}

#[test]
fn a_vessel_that_was_traced_the_other_way_is_matched_too() {
    let [first, second] = both(1.5);
    let mut reversed = second.clone();
    for values in [&mut reversed.area, &mut reversed.uncertainty] {
        values.reverse();
    }
    reversed.on_vessel.reverse();
    reversed.arc_length = lumencut_core::math::arc_length::arc_lengths(&reversed.on_vessel);
    let [found, turned] = [second, reversed].map(|second| compare(&first, &second, &[]).unwrap());
    assert!(turned.matching.is_reversed);
    for (a, b) in
        found.places.iter().zip(&turned.places).filter(|(a, b)| (a.difference + b.difference).is_finite())
    {
        let unsure = a.difference_uncertainty + b.difference_uncertainty;
        assert!((a.difference - b.difference).abs() < unsure, "{a:?} {b:?}");
    }
    let [a, b] = [found, turned].map(|found| only_change(&found));
    assert!((a[0] - b[0]).abs() <= 1.0 && (a[1] - b[1]).abs() <= 1.0);
}

#[test]
fn straight_vessels_are_matched_by_branches_or_by_places_only() {
    let straight = |at: f64| DVec3::Z * at;
    let [mut first, mut second] =
        [vessel(straight, 0.0, 1.0, UNSURE[0]), vessel(straight, 12.0, 2.5, UNSURE[1])];
    let error = compare(&first, &second, &[]).unwrap_err();
    assert!(error.to_string().contains("give a pair of places"), "{error}");
    let by_place = compare(&first, &second, &[[60.0, 48.0]]).unwrap();
    assert_eq!(by_place.matching.by, MatchedBy::Places);
    for branch in [20.0, 45.0, 100.0] {
        for (profile, start) in [(&mut first, 0.0), (&mut second, 12.0)] {
            let n = profile.nearest_section(branch - start);
            profile.flags[n] = BRANCH;
        }
    }
    let by_branches = compare(&first, &second, &[]).unwrap();
    assert_eq!(by_branches.matching.by, MatchedBy::Branches);
    for found in [by_place, by_branches] {
        assert!((found.places[200].at[1] - 88.0).abs() < 1e-9);
        let [from, to] = only_change(&found);
        assert!(from > 50.0 && from < 60.0 && to > 60.0 && to < 70.0);
        // Where the wall slopes, the places matter.
        let slope = |n: usize| found.places[n].difference_uncertainty;
        assert!(slope(110) > slope(160));
    }
    // Three equally distant branches agree at two offsets if one of them is missing.
    second.flags.fill(0);
    assert!(compare(&first, &second, &[]).is_err());
}

#[test]
fn pairs_stretch_the_vessel_between_them_and_must_not_contradict_each_other() {
    let [first, second] = both(0.0);
    let [a, b] = [along(&first, 30.0), along(&first, 90.0)];
    let found = compare(&first, &second, &[[b, 80.0], [a, 20.0]]).unwrap();
    let middle = first.nearest_section(f64::midpoint(a, b));
    let expected = 20.0 + 60.0 * (first.arc_length[middle] - a) / (b - a);
    assert!((found.places[middle].at[1] - expected).abs() < 1e-9);
    for pairs in [vec![[10.0, 20.0], [20.0, 90.0]], vec![[10.0, 20.0], [10.0, 30.0]]] {
        assert_eq!(compare(&first, &second, &pairs).unwrap_err().subject, "pairs of places");
    }
    let error = compare(&first, &second, &[[10.0, 900.0]]).unwrap_err();
    assert_eq!(error.subject, "place on the second vessel");
    assert!(compare(&first, &second, &[[f64::NAN, 10.0]]).is_err());
}

#[test]
fn another_vessel_is_refused() {
    let [first, _] = both(0.0);
    let other =
        vessel(|at| DVec3::new(40.0 * (at / 15.0).sin(), 40.0 * (at / 15.0).cos(), 0.2 * at), 0.0, 1.0, 0.1);
    assert_eq!(compare(&first, &other, &[]).unwrap_err().subject, "vessels to compare");
    let coil = |at: f64| DVec3::new(12.0 * (at / 12.0).cos(), 12.0 * (at / 12.0).sin(), 0.05 * at);
    let error = compare(&first, &vessel(coil, 0.0, 1.0, 0.1), &[]).unwrap_err();
    assert!(error.to_string().contains("mm apart after the best rigid motion"), "{error}");
    let short = vessel(curve, 118.0, 0.0, 0.1);
    assert!(compare(&first, &short, &[]).is_err());
}

#[test]
fn sections_that_do_not_count_have_no_difference() {
    let [first, mut second] = both(1.5);
    second.flags[80..100].fill(NO_EDGE);
    let found = compare(&first, &second, &[]).unwrap();
    let left_out = found.places.iter().filter(|place| place.at[1].is_finite() && place.difference.is_nan());
    assert!((18..=23).contains(&left_out.count()));
}
