#![allow(clippy::unwrap_used)]

use super::closed_path::closed_path;
use super::outline::{area_and_middle, corners_at, exits, solidity};
use super::*;
use crate::measure::section::rays::RAYS;
use glam::DVec2;

fn seen(diameter: f64) -> Outer {
    Outer { found: OuterWall::Seen, contour: Vec::new(), diameter: [diameter, 0.1] }
}

#[test]
fn an_outer_wall_seen_over_less_than_5_mm_or_unlike_its_neighbours_is_left_out() {
    let at: Vec<f64> = (0..60).map(|n| f64::from(n) * 0.5).collect();
    let mut found: Vec<Outer> = (0..60)
        .map(|n| if (20..50).contains(&n) || n < 8 { seen(20.0) } else { Outer::none(OuterWall::Thin) })
        .collect();
    found[30] = seen(23.0);
    leave_out_uneven(&at, &mut found);
    let kept: Vec<usize> = (0..60).filter(|n| found[*n].found == OuterWall::Seen).collect();
    assert_eq!(kept, (20..30).chain(31..50).collect::<Vec<_>>());
    assert_eq!([0, 30, 55].map(|n| found[n].found), [OuterWall::Uneven, OuterWall::Uneven, OuterWall::Thin]);
}

#[test]
fn a_closed_path_follows_the_cheap_samples_and_crosses_a_gap() {
    let (count, middle) = (40, |ray: usize| 20.0 + 6.0 * (std::f64::consts::TAU * ray as f64 / 64.0).cos());
    let cost = |ray: usize, n: usize| {
        let is_border = (n as f64 - middle(ray)).abs() < 0.5 && !(10..20).contains(&ray);
        if is_border { -1.0 } else { 0.0 }
    };
    let costs: Vec<f64> =
        (0..RAYS).flat_map(|ray| (0..count).map(move |n| (ray, n))).map(|(ray, n)| cost(ray, n)).collect();
    let path = closed_path(&costs, count, 0.05);
    let off = (0..RAYS).map(|ray| (path[ray] as f64 - middle(ray)).abs()).fold(0.0, f64::max);
    assert!(off < 3.0, "{off}");
}

#[test]
fn outlines_have_their_area_middle_and_dents() {
    let circle = corners_at(DVec2::new(1.0, 2.0), &[5.0; RAYS]);
    let (area, middle) = area_and_middle(&circle).unwrap();
    assert!((area / (std::f64::consts::PI * 25.0) - 1.0).abs() < 2e-3, "{area}");
    assert!(middle.distance(DVec2::new(1.0, 2.0)) < 1e-9);
    assert!((solidity(&circle) - 1.0).abs() < 1e-9);
    let mut radii = [5.0; RAYS];
    radii[0] = 2.0;
    assert!(solidity(&corners_at(DVec2::ZERO, &radii)) < 0.99);
    let exits = exits(&circle, DVec2::new(3.0, 2.0));
    assert!((exits[0] - 3.0).abs() < 0.02 && (exits[RAYS / 2] - 7.0).abs() < 0.02, "{exits:?}");
}
