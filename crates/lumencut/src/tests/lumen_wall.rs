use std::f64::consts::PI;

use glam::{DAffine3, DMat3};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::cpr::View;
use lumencut_core::volume::Voxels as Samples;
use lumencut_vessels::measure::profile::measuring;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::wall::WallRequest;

use super::*;

const SIZE: [usize; 3] = [64, 64, 81];

/// Values on a 0.5 mm grid around the vessel of [`line`], from the position across and along the vessel (mm).
fn painted(value: impl Fn(DVec2, f64) -> f64) -> Vec<f32> {
    let each = |n: usize| {
        let [i, j, k] = [n % 64, n / 64 % 64, n / 4096].map(|index| index as f64 * 0.5);
        value(DVec2::new(i - 16.0, j - 16.0), 40.0 - k) as f32
    };
    (0..SIZE.iter().product()).map(each).collect()
}

fn with<T>(values: &[f32], described: impl FnOnce(&Volume) -> T) -> T {
    let affine = DAffine3::from_mat3_translation(DMat3::IDENTITY * 0.5, DVec3::new(-16.0, -16.0, 0.0));
    described(&Volume::new(Samples::F32(values), SIZE, [1, 64, 4096], affine).expect("a volume"))
}

/// A vessel of 4 mm radius that runs downwards.
fn line() -> Vessel {
    Vessel::new(vec![DVec3::new(0.0, 0.0, 40.0), DVec3::ZERO], Some(vec![4.0; 2])).expect("a vessel")
}

fn straight() -> Straightened {
    let path = CenterlinePath::new(&line(), 0.0).expect("a path");
    Straightened::new(Arc::new(path), &View { up: DVec3::Z, angle: 0.0, normal: None }).expect("a view")
}

/// The value 300 within a radius and 0 outside, blurred over about a voxel.
fn lumen(across: DVec2, radius: f64) -> f64 {
    300.0 * ((radius - across.length()) / 0.7 + 0.5).clamp(0.0, 1.0)
}

fn found(values: &[f32]) -> FoundWall {
    with(values, |volume| {
        let request =
            MeasureRequest { step: 0.5, fwhm: Some(0.7), wall: WallRequest::Off, tree: &[], stop: &|| false };
        let profile = measuring::measure(volume, &line(), &request).expect("a lumen");
        lumen_wall(volume, &line(), &straight(), Some(&profile)).expect("a wall")
    })
}

#[test]
fn a_tube_has_its_radius_all_around() {
    let found = found(&painted(|across, _| lumen(across, 4.0)));
    assert!((found.mean_radius - 4.0).abs() < 1e-12);
    for n in 0..400 {
        let (at, around) = (f64::from(n) / 10.0, f64::from(n) * 0.7);
        let radius = found.wall.radius(at, around);
        assert!((radius - 4.0).abs() < 0.1, "{radius} mm at {at} mm");
        assert!(!found.wall.is_open(at, around));
    }
    let [inside, around] = found.levels.expect("levels");
    assert!((inside - 300.0).abs() < 10.0 && around.abs() < 10.0, "{inside} in {around}");
}

#[test]
fn a_branch_at_right_angles_is_an_opening_of_its_size() {
    // A branch of 1.5 mm radius to the left, at 20 mm.
    let branch = |across: DVec2, at: f64| {
        if across.x > 0.0 { lumen(DVec2::new(across.y, at - 20.0), 1.5) } else { 0.0 }
    };
    let found = found(&painted(|across, at| lumen(across, 4.0).max(branch(across, at))));
    let is_open = |n: i32| found.wall.is_open(f64::from(n) / 10.0, 0.0);
    let height = (0..400).filter(|n| is_open(*n)).count() as f64 / 10.0;
    assert!((height - 3.0).abs() <= 1.0, "an opening {height} mm high");
    assert!(is_open(200) && !found.wall.is_open(20.0, PI));
    let wide = (-1800..1800).filter(|n| found.wall.is_open(20.0, f64::from(*n) * PI / 1800.0)).count();
    let expected = 2.0 * (1.5f64 / 4.0).asin();
    assert!((wide as f64 * PI / 1800.0 - expected).abs() < 0.2, "{wide}");
}

#[test]
fn bone_that_touches_a_vessel_is_no_opening() {
    // Towards bone, values fall only to two thirds; beyond 1.6 radii they exceed those of the lumen.
    let bone = |across: DVec2| {
        let rises = across.x > 3.0 && across.y.abs() < 2.0;
        if rises { 200.0 + 90.0 * (across.x - 3.8).max(0.0) } else { 0.0 }
    };
    let values = painted(|across, _| lumen(across, 4.0).max(bone(across)));
    let falls = with(&values, |volume| {
        let rays = RaysAcross { voxels: &Voxels::new(volume), straightened: &straight(), directions: 4 };
        rays.falls(20.0, [300.0, 0.0], |_| 6.4)
    });
    for fall in falls {
        let away = fall.radius().expect("a wall");
        assert!((3.4..4.4).contains(&away), "{away} mm");
    }
    // Towards a branch, the values stay those of the lumen.
    let branch = painted(|across, _| lumen(across, 4.0).max(lumen(DVec2::new(0.0, across.y), 2.0)));
    let falls = with(&branch, |volume| {
        let rays = RaysAcross { voxels: &Voxels::new(volume), straightened: &straight(), directions: 4 };
        rays.falls(20.0, [300.0, 0.0], |_| 6.4)
    });
    assert_eq!(falls.iter().filter(|fall| **fall == Fall::Open).count(), 2);
}

#[test]
fn air_beside_a_vessel_under_the_skin_does_not_tell_its_wall() {
    let usual = Some([353.0, 53.0]);
    let alike = [[353.0, 53.0], [353.0, -90.0], [330.0, 170.0]].map(|local| is_alike(local, usual));
    assert_eq!(alike, [true; 3]);
    let unlike = [[353.0, -1000.0], [353.0, 320.0], [53.0, 353.0], [f64::NAN, 0.0], [353.0, f64::NAN]];
    assert_eq!(unlike.map(|local| is_alike(local, usual)), [false; 5]);
    assert!(is_alike([353.0, -1000.0], None) && !is_alike([f64::NAN; 2], None));
}

#[test]
fn without_a_lumen_the_centerline_tells_the_wall() {
    let values = painted(|_, _| 7.0);
    let wall = with(&values, |volume| lumen_wall(volume, &line(), &straight(), None)).expect("radii").wall;
    assert!((wall.radius(13.0, 1.0) - 4.0).abs() < 1e-12 && !wall.is_open(13.0, 1.0));
    let bare = Vessel::new(line().points().to_vec(), None).expect("a vessel");
    let error =
        with(&values, |volume| lumen_wall(volume, &bare, &straight(), None)).err().expect("no radius");
    assert_eq!(error.kind, ErrorKind::VesselTree);
}
