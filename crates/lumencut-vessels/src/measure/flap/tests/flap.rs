#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use glam::DVec2;

use super::basins::{Basins, Dams, NONE};
use super::outlines::outline;
use super::plane_map::PlaneMap;
use super::*;

const STEP: f64 = 0.4;
const COUNT: usize = 81;

/// A map of 32 mm with these values.
fn map(value: impl Fn(DVec2) -> f64) -> PlaneMap {
    let mut map = PlaneMap::empty(STEP, COUNT);
    map.values = (0..COUNT * COUNT).map(|n| value(map.place(n))).collect();
    map
}

fn basins(map: &PlaneMap) -> Basins {
    Basins::of(map, &map.sheets(), &Dams { bright: 0.3, least_sheet: 0.2, least_size: 20, least_gap: 3 })
}

#[test]
fn a_disc_has_an_even_outline_with_its_area() {
    let disc = map(|place| if place.length() < 8.0 { 1.0 } else { 0.0 });
    let found = basins(&disc);
    let own = found.of[disc.nearest(DVec2::ZERO).unwrap()];
    let corners = outline(&disc, &found, own);
    for corner in &corners {
        assert!((corner.at.length() - 8.0).abs() < 0.5 && corner.out.dot(corner.at.normalize()) > 0.9);
    }
    let twice: f64 = (0..64).map(|n| corners[n].at.perp_dot(corners[(n + 1) % 64].at)).sum();
    assert!((0.5 * twice.abs() / (PI * 64.0) - 1.0).abs() < 0.02, "{twice}");
    assert_eq!(found.of[0], NONE);
}

#[test]
fn a_valley_parts_two_basins_unless_it_is_shallow_or_one_side_is_small() {
    let parts = |depth: f64, at: f64| {
        let found = basins(&map(|place| {
            let valley = depth * (-0.5 * (place.x - at).powi(2) / 0.5).exp();
            if place.length() < 8.0 { 1.0 - valley } else { 0.0 }
        }));
        let mut all: Vec<u32> = found.of.iter().copied().filter(|basin| *basin != NONE).collect();
        all.sort_unstable();
        all.dedup();
        all.len()
    };
    assert_eq!([parts(0.4, 2.0), parts(0.05, 2.0), parts(0.4, 7.8)], [2, 1, 1]);
}

#[test]
fn a_hole_in_a_sheet_parts_nothing_unless_it_is_one_value_wide() {
    let parts = |half: f64| {
        let found = basins(&map(|place| {
            let depth = if place.y.abs() < half { 0.08 } else { 0.4 };
            let valley = depth * (-0.5 * (place.x - 2.0).powi(2) / 0.5).exp();
            if place.length() < 8.0 { 1.0 - valley } else { 0.0 }
        }));
        let at = |x: f64| found.of[map(|_| 0.0).nearest(DVec2::new(x, 4.0)).unwrap()];
        at(-2.0) != at(5.0)
    };
    assert_eq!([parts(0.5 * STEP), parts(3.0)], [true, false]);
}

#[test]
fn a_lumen_ends_at_half_of_its_contrast_and_what_is_dim_is_counted() {
    let bulge = map(|place| match place.length() {
        length if length < 6.0 => 1.0,
        _ if (place - DVec2::X * 6.0).length() < 3.0 => 0.4,
        _ => 0.0,
    });
    let own = 7;
    let mut found =
        Basins { of: bulge.values.iter().map(|value| if *value > 0.0 { own } else { NONE }).collect() };
    let far = |near: f64| {
        let is_far = |n: &usize| bulge.values[*n] == 0.4 && bulge.place(*n).length() > 6.0 + near;
        (0..COUNT * COUNT).filter(is_far).count() as f64
    };
    let dim = found.trim(&bulge, own, (0.0, 0.5), 3) as f64;
    assert!(dim > far(4.0 * STEP) && dim < far(2.0 * STEP), "{dim}");
    assert_eq!(found.size(own), bulge.values.iter().filter(|value| **value == 1.0).count());
}

#[test]
fn lumens_seen_over_less_than_10_mm_are_left_out() {
    let at: Vec<f64> = (0..60).map(|n| f64::from(n) * 0.5).collect();
    let pair = |area: f64| LumenPair {
        found: Flap::Seen,
        areas: [[area, 1.0], [100.0, 1.0]],
        contours: Default::default(),
    };
    let mut found: Vec<LumenPair> = (0..60)
        .map(|n| if !(12..30).contains(&n) { pair(200.0) } else { LumenPair::none(Flap::Absent) })
        .collect();
    found[40] = pair(400.0);
    leave_out_uneven(&at, &mut found);
    let kept: Vec<usize> = (0..60).filter(|n| found[*n].found == Flap::Seen).collect();
    assert_eq!(kept, (30..40).chain(41..60).collect::<Vec<_>>());
    assert_eq!([3, 20, 40].map(|n| found[n].found), [Flap::Uneven, Flap::Absent, Flap::Uneven]);
}
