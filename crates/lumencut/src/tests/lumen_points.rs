use glam::DAffine3;
use lumencut_core::volume::Voxels;
use lumencut_io::{Space, Unit};

use super::*;

/// A volume of 81³ voxels of 1 mm, centred at the origin.
const SIDE: usize = 81;
const LPS: CoordinateSystem = CoordinateSystem { space: Space::Lps, unit: Unit::Millimetre };
const RAS: CoordinateSystem = CoordinateSystem { space: Space::Ras, unit: Unit::Millimetre };

fn counted(value: impl Fn(DVec3) -> f32, lines: &Lines, place: CoordinateSystem) -> LumenCount {
    let middle = (SIDE / 2) as f64;
    let at = |n: usize| DVec3::new((n % SIDE) as f64, (n / SIDE % SIDE) as f64, (n / SIDE / SIDE) as f64);
    let voxels: Vec<f32> = (0..SIDE * SIDE * SIDE).map(|n| value(at(n) - middle)).collect();
    let affine = DAffine3::from_translation(DVec3::splat(-middle));
    let volume = Volume::new(Voxels::F32(&voxels), [SIDE; 3], [1, SIDE, SIDE * SIDE], affine).unwrap();
    lumen_count(&volume, lines, place)
}

/// The centerline of a vessel of 4 mm radius along z, off the origin, in 0.5 mm steps.
fn points() -> Vec<DVec3> {
    (-60..60).map(|n| DVec3::new(15.0, -9.0, 0.5 * f64::from(n) + 0.25)).collect()
}

fn is_lumen(p: DVec3) -> bool {
    (p.x - 15.0).hypot(p.y + 9.0) < 4.0
}

fn noise(p: DVec3) -> f32 {
    let [x, y, z] = p.as_i64vec3().to_array();
    let mixed = ((x * 73_856_093) ^ (y * 19_349_663) ^ (z * 83_492_791)).wrapping_mul(2_654_435_761) as u64;
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((mixed ^ (mixed >> 32)) & 0xFFFF) as f32 / 65535.0
}

#[test]
fn lumen_is_told_whatever_the_units_of_the_volume_and_bright_or_dark() {
    let points = points();
    let radii = vec![4.0; points.len()];
    let lines = Lines { points: &points, radii: &radii };
    // CT with uneven tissue, 8-bit MR on an empty background, inverted MR, and noisy CT.
    let values: [&dyn Fn(DVec3) -> f32; 4] = [
        &|p| if is_lumen(p) { 350.0 } else { 40.0 + (p.x + p.z) as f32 },
        &|p| if is_lumen(p) { 255.0 } else { 0.0 },
        &|p| if is_lumen(p) { 0.0 } else { 255.0 },
        &|p| if is_lumen(p) { 300.0 } else { 0.0 } + 150.0 * noise(p),
    ];
    for (n, value) in values.iter().enumerate() {
        let [as_it_is, mirrored] = [LPS, RAS].map(|place| counted(value, &lines, place));
        // The vessel is 60 mm long, and is sampled in cubes of 2 mm.
        assert_eq!((as_it_is.of, mirrored.of), (30, 30));
        assert!(as_it_is.like_lumen >= 28, "volume {n}: {as_it_is:?}");
        let described = format!("volume {n}: {as_it_is:?} beside {mirrored:?}");
        assert!(as_it_is.is_evident_over(mirrored) && !mirrored.is_evident_over(as_it_is), "{described}");
    }
}

#[test]
fn lines_without_radii_are_looked_at_too() {
    let (points, value) = (points(), |p| if is_lumen(p) { 350.0 } else { 40.0 + (p.x + p.z) as f32 });
    let radii = vec![f64::NAN; points.len()];
    let lines = Lines { points: &points, radii: &radii };
    assert!(counted(value, &lines, LPS).is_evident_over(counted(value, &lines, RAS)));
}

#[test]
fn noise_nothing_and_what_is_symmetric_decide_nothing() {
    let points = points();
    let radii = vec![4.0; points.len()];
    let lines = Lines { points: &points, radii: &radii };
    let mirrored = |p: DVec3| is_lumen(p) || is_lumen(p * DVec3::new(-1.0, -1.0, 1.0));
    let values: [&dyn Fn(DVec3) -> f32; 5] =
        [&noise, &|_| 7.0, &|_| f32::NAN, &|p| p.x as f32 + 3.0 * p.y as f32, &|p| {
            if mirrored(p) { 350.0 } else { 40.0 }
        }];
    for (n, value) in values.iter().enumerate() {
        let [as_it_is, mirrored] = [LPS, RAS].map(|place| counted(value, &lines, place));
        assert!(!as_it_is.is_evident_over(mirrored), "volume {n}: {as_it_is:?} beside {mirrored:?}");
        assert!(!mirrored.is_evident_over(as_it_is), "volume {n}: {mirrored:?} beside {as_it_is:?}");
    }
}

#[test]
fn points_that_lie_closely_count_once_and_units_are_those_of_the_place() {
    let value = |p| if is_lumen(p) { 350.0 } else { 40.0 };
    let close: Vec<DVec3> = (0..500).map(|n| DVec3::new(1.5, -0.9, 0.0001 * f64::from(n))).collect();
    let radii = vec![0.4; close.len()];
    let lines = Lines { points: &close, radii: &radii };
    let place = CoordinateSystem { unit: Unit::Centimetre, ..LPS };
    assert_eq!(counted(value, &lines, place), LumenCount { like_lumen: 1, of: 1 });
}

#[test]
fn points_outside_the_volume_are_no_lumen() {
    let far: Vec<DVec3> = points().iter().map(|point| *point + DVec3::X * 500.0).collect();
    let radii = vec![4.0; far.len()];
    let found = counted(|_| 7.0, &Lines { points: &far, radii: &radii }, LPS);
    assert_eq!(found, LumenCount { like_lumen: 0, of: 30 });
}
