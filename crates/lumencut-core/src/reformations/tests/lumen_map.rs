use std::f64::consts::{FRAC_PI_2, PI};

use super::*;
use crate::stop::NEVER;
use crate::vessel_tree::Vessel;

const FRONT: View = View { up: DVec3::Z, angle: 0.0, normal: None };
const DIRECTIONS: usize = 360;

fn wall(length: f64, radius: impl Fn(f64) -> f64) -> Arc<Wall> {
    let row: Vec<f64> = (0..DIRECTIONS).map(|n| radius(TAU * n as f64 / DIRECTIONS as f64)).collect();
    Arc::new(Wall::new(vec![0.0, length], row.repeat(2), vec![false; 2 * DIRECTIONS]).unwrap())
}

fn map(points: &[DVec3], radius: impl Fn(f64) -> f64, changes: LumenMapParameters) -> LumenMap {
    let path = CenterlinePath::new(&Vessel::new(points.to_vec(), None).unwrap(), 0.0).unwrap();
    let wall = wall(path.length(), radius);
    LumenMap::new(Arc::new(path), &FRONT, wall, changes).unwrap()
}

const TUBE: LumenMapParameters =
    LumenMapParameters { pixel_spacing: 0.5, mean_radius: 4.0, angle: 0.0, overlap: 0.0, beyond: 0.0 };

const STRAIGHT: [DVec3; 2] = [DVec3::new(1.0, 2.0, 30.0), DVec3::new(1.0, 2.0, 0.0)];

fn half_circle(radius: f64) -> Vec<DVec3> {
    (0..=720).map(|n| PI * f64::from(n) / 720.0).map(|t| DVec3::new(t.cos(), 0.0, t.sin()) * radius).collect()
}

#[test]
fn a_tube_is_unrolled_by_direction() {
    let map = map(&STRAIGHT, |_| 4.0, TUBE);
    assert_eq!(map.size(), [50, 61]);
    let curved = map.curved(NEVER).unwrap();
    for (n, point) in curved.position().iter().enumerate() {
        let around = TAU * ((n % 50) as f64 + 0.5) / 50.0 - PI;
        // A vessel that runs downwards has the patient's left on its right, and the back ahead.
        let expected =
            DVec3::new(1.0 + 4.0 * around.cos(), 2.0 + 4.0 * around.sin(), 30.0 - 0.5 * (n / 50) as f64);
        assert!(point.distance(expected) < 1e-9, "{n}: {point} instead of {expected}");
        let ray = (expected - DVec3::new(1.0, 2.0, expected.z)) / 4.0;
        assert!(curved.slab_direction()[n].as_dvec3().distance(ray) < 1e-6);
    }
    assert!(map.shades(NEVER).unwrap().iter().all(|shade| (shade - 1.0).abs() < 1e-3));
    assert!(map.folded(NEVER).unwrap().iter().all(|folded| !folded));
}

#[test]
fn an_ellipse_has_its_polar_radius() {
    let polar = |t: f64| 12.0 / (9.0 * t.cos().powi(2) + 16.0 * t.sin().powi(2)).sqrt();
    let map = map(&STRAIGHT, polar, LumenMapParameters { angle: 0.7, ..TUBE });
    for (n, radius) in map.wall(NEVER).unwrap().iter().enumerate() {
        let around = TAU * ((n % 50) as f64 + 0.5) / 50.0 - PI + 0.7;
        assert!((radius - polar(around)).abs() < 1e-3, "{n}: {radius}");
    }
    // The light meets the wall at right angles only on the axes of the ellipse.
    let shades = map.shades(NEVER).unwrap();
    assert!(shades.iter().all(|shade| *shade <= 1.0) && shades.iter().any(|shade| *shade < 0.98));
}

#[test]
fn places_and_pixels_are_inverse() {
    let parameters = LumenMapParameters { angle: 2.5, overlap: 0.3, beyond: 1.0, ..TUBE };
    let map = map(&half_circle(40.0), |t| 4.0 + 0.5 * t.sin(), parameters);
    let [width, height] = map.size();
    assert_eq!((width, map.overlap()), (54, 2));
    for pixel in [[2.0, 0.0], [10.3, 17.8], [27.0, 100.2], [51.4, height as f64 - 1.5]].map(DVec2::from_array)
    {
        let there = map.world_from_pixel(pixel);
        assert!(map.pixel_from_world(there).distance(pixel) < 1e-5, "{pixel} came back elsewhere");
    }
    // A repeated column maps to the column that it repeats.
    assert!(
        (map.pixel_from_world(map.world_from_pixel(DVec2::new(0.0, 9.0))) - DVec2::new(50.0, 9.0)).length()
            < 1e-5
    );
    assert!(map.pixel_from_world(DVec3::new(40.0, 0.0, -9.0)).is_nan());
    let position = map.curved(NEVER).unwrap().position()[7 * width + 20];
    assert!(position.distance(map.world_from_pixel(DVec2::new(20.0, 7.0))) < 1e-12);
}

#[test]
fn the_area_of_a_torus_is_that_of_its_pixels() {
    // The area of a pixel is (1 - cos α · r / R) r dα ds, whose mean over α is r dα ds.
    let map = map(&half_circle(40.0), |_| 4.0, LumenMapParameters { pixel_spacing: 0.25, ..TUBE });
    let [width, height] = map.size();
    let curved = map.curved(NEVER).unwrap();
    let row = height / 2;
    let area: f64 = (0..width)
        .map(|i| {
            let here = |i: usize, j: usize| curved.position()[j * width + i % width];
            let across = here(i + 1, row) - here(i + width - 1, row);
            let along = here(i, row + 1) - here(i, row - 1);
            across.cross(along).length() / 4.0
        })
        .sum();
    let expected = TAU * 4.0 * 0.25;
    assert!((area / expected - 1.0).abs() < 2e-3, "{area} instead of {expected}");
}

#[test]
fn beyond_the_middle_of_a_circle_it_is_folded() {
    // Sections of a circle with a radius of 10 mm meet in its middle, 10 mm / cos α away in direction α.
    let map = map(&half_circle(10.0), |_| 9.0, LumenMapParameters { beyond: 4.0, mean_radius: 9.0, ..TUBE });
    let [width, height] = map.size();
    let folded = map.folded(NEVER).unwrap();
    let towards = map.pixel_from_world(DVec3::new(0.0, 0.0, 9.9)).x;
    for i in 0..width {
        let away = TAU * (i as f64 - towards) / width as f64;
        let reach = 13.0 * away.cos();
        if (reach - 10.0).abs() > 0.3 {
            assert_eq!(
                folded[height / 2 * width + i],
                reach > 10.0,
                "column {i}, {reach} mm towards the middle"
            );
        }
    }
}

#[test]
fn an_opening_shows_nothing() {
    let mut open = vec![false; 2 * DIRECTIONS];
    let is_open = |n: usize| (80..=100).contains(&(n % DIRECTIONS));
    (0..open.len()).for_each(|n| open[n] = is_open(n));
    let wall = Arc::new(Wall::new(vec![0.0, 30.0], vec![4.0; 2 * DIRECTIONS], open).unwrap());
    let path = CenterlinePath::new(&Vessel::new(STRAIGHT.to_vec(), None).unwrap(), 0.0).unwrap();
    let map = LumenMap::new(Arc::new(path), &FRONT, wall, TUBE).unwrap();
    let middle = map.column(FRAC_PI_2).round() as usize;
    let curved = map.curved(NEVER).unwrap();
    for (n, point) in curved.position().iter().enumerate() {
        let away = (n % 50).abs_diff(middle) as f64 * 360.0 / 50.0;
        if (away - 10.0).abs() > 4.0 {
            assert_eq!(point.is_nan(), away < 10.0, "column {}", n % 50);
        }
        assert_eq!(map.open(NEVER).unwrap()[n], point.is_nan());
    }
}

#[test]
fn what_cannot_be_laid_out_is_refused() {
    let path = Arc::new(CenterlinePath::new(&Vessel::new(STRAIGHT.to_vec(), None).unwrap(), 0.0).unwrap());
    let refused =
        |parameters| LumenMap::new(Arc::clone(&path), &FRONT, wall(30.0, |_| 4.0), parameters).err();
    for parameters in [
        LumenMapParameters { pixel_spacing: 0.0, ..TUBE },
        LumenMapParameters { pixel_spacing: 1e-5, ..TUBE },
        LumenMapParameters { angle: f64::NAN, ..TUBE },
        LumenMapParameters { overlap: -0.1, ..TUBE },
    ] {
        assert_eq!(refused(parameters).map(|error| error.kind), Some(ErrorKind::Camera), "{parameters:?}");
    }
    for (at, radius) in
        [(vec![], vec![]), (vec![0.0, 0.0], vec![1.0; 2]), (vec![0.0, 1.0], vec![1.0, f64::NAN])]
    {
        let open = vec![false; radius.len()];
        assert!(Wall::new(at, radius, open).is_err());
    }
}
