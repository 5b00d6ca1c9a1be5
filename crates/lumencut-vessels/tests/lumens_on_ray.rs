//! Tests which lumens lie along a ray, in tubes with known geometry.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_vessels::trace::lumen::on_ray::lumens_on_ray;
use lumencut_vessels::trace::lumen::seen::lumen_at;

const SIDE: usize = 60;
const TISSUE: f64 = 50.0;
const LUMEN: f64 = 300.0;

/// Two tubes that cross in the view along z. The near one has a radius of 4 mm along x; the far one has 3 mm.
const NEAR: (DVec3, DVec3, f64) = (DVec3::new(0.0, 30.0, 18.0), DVec3::X, 4.0);
const FAR: (DVec3, DVec3, f64) = (DVec3::new(30.0, 30.0, 42.0), DVec3::new(0.6, 0.8, 0.0), 3.0);

/// Depth inside a tube (mm; negative outside).
fn depth(place: DVec3, (middle, along, radius): (DVec3, DVec3, f64)) -> f64 {
    radius - (place - middle).reject_from_normalized(along).length()
}

/// Tubes with a wall of one voxel, in tissue with air on one side.
fn value(place: DVec3) -> f32 {
    let air = if place.y < 5.0 { -1000.0 } else { TISSUE };
    let filled = depth(place, NEAR).max(depth(place, FAR));
    (air + (LUMEN - air) * (0.5 + filled).clamp(0.0, 1.0)) as f32
}

fn with_volume<T>(value: impl Fn(DVec3) -> f32, ask: impl Fn(&Volume) -> T) -> T {
    let at = |n: usize| DVec3::new((n % SIDE) as f64, (n / SIDE % SIDE) as f64, (n / SIDE / SIDE) as f64);
    let voxels: Vec<f32> = (0..SIDE * SIDE * SIDE).map(|n| value(at(n))).collect();
    let grid = DAffine3::IDENTITY;
    ask(&Volume::new(Voxels::F32(&voxels), [SIDE; 3], [1, SIDE, SIDE * SIDE], grid).unwrap())
}

#[test]
fn a_ray_through_two_tubes_meets_both_the_nearest_first_with_middle_radius_and_direction() {
    // The ray misses both tube centres; in the view, the tubes cross at (30, 30).
    let from = DVec3::new(31.0, 31.0, 0.0);
    let seen = with_volume(value, |volume| lumens_on_ray(volume, from, DVec3::Z));
    assert_eq!(seen.len(), 2, "{seen:?}");
    for (one, tube) in seen.iter().zip([NEAR, FAR]) {
        let (middle, along, radius) = tube;
        let beside = (one.center - middle).reject_from_normalized(along).length();
        assert!(beside < 0.3, "{beside} mm beside the middle: {one:?}");
        assert!((one.radius - radius).abs() < 0.2, "{one:?}");
        assert!(one.along.dot(along).abs() > 0.99, "{one:?}");
        assert!((one.value - LUMEN).abs() < 5.0, "{one:?}");
    }
    // From the opposite side, the other tube is the nearer one.
    let back = with_volume(value, |volume| lumens_on_ray(volume, from + DVec3::Z * 59.0, DVec3::NEG_Z));
    assert_eq!(back.iter().map(|one| one.center.z > 30.0).collect::<Vec<_>>(), [true, false]);
}

#[test]
fn a_ray_beside_tubes_and_one_beside_the_volume_meet_none() {
    for from in [DVec3::new(10.0, 50.0, 0.0), DVec3::new(100.0, 30.0, 0.0)] {
        let seen = with_volume(value, |volume| lumens_on_ray(volume, from, DVec3::Z));
        assert!(seen.is_empty(), "{seen:?}");
    }
}

#[test]
fn a_place_in_a_tube_has_its_lumen_and_one_in_tissue_air_or_a_bright_sheet_has_none() {
    let seen = with_volume(value, |volume| lumen_at(volume, DVec3::new(12.0, 31.5, 19.0))).unwrap();
    assert!((seen.radius - 4.0).abs() < 0.2, "{seen:?}");
    assert!(seen.center.distance(DVec3::new(12.0, 30.0, 18.0)) < 1.0, "{seen:?}");
    for place in [DVec3::new(20.0, 50.0, 30.0), DVec3::new(20.0, 2.0, 30.0), DVec3::splat(-5.0)] {
        assert_eq!(with_volume(value, |volume| lumen_at(volume, place)), None, "{place}");
    }
    let sheet = |place: DVec3| if (place.z - 30.0).abs() < 3.0 { 300.0 } else { 50.0 };
    assert_eq!(with_volume(sheet, |volume| lumen_at(volume, DVec3::splat(30.0))), None);
}
