//! Measures the outer wall around thrombus: lumens in wider discs, whose blurred image is known exactly.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use glam::{DAffine3, DMat2, DVec2, DVec3};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_vessels::measure::model::ellipse::{Boundary, Ellipse, Whitening};
use lumencut_vessels::measure::outer::found::OuterWall;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::section::blur::variance_of;
use lumencut_vessels::measure::wall::WallRequest;

const SIDE: f64 = 0.8;
const FWHM: f64 = 1.0;
const SIZE: [usize; 3] = [60, 60, 16];
const MIDDLE: DVec2 = DVec2::new(23.7, 23.3);

const FAT: f64 = -95.0;
const THROMBUS: f64 = 40.0;
const MUSCLE: f64 = 55.0;
const LUMEN: f64 = 320.0;
const NOISE: f64 = 15.0;

fn disc(diameter: f64, center: DVec2) -> impl Fn(DVec2) -> f64 {
    let variance = variance_of(FWHM) + SIDE * SIDE / 12.0;
    let circle = Ellipse::circle(center, 0.5 * diameter);
    let boundary = Boundary::new(&circle, Whitening::new(DMat2::from_diagonal(DVec2::splat(variance))));
    move |place| boundary.value(place)
}

/// Sums of twelve pseudo-random numbers (Knuth's constants of MMIX) are nearly normal.
fn noise() -> impl FnMut() -> f64 {
    let mut state = 7_u64;
    move || {
        let mut sum = -6.0;
        for _ in 0..12 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            sum += (state >> 40) as f64 / f64::from(1 << 24);
        }
        NOISE * sum
    }
}

/// The profile of a vessel along z through `lumen`, where `value` gives the HU in a section.
fn profile(lumen: DVec2, value: impl Fn(DVec2) -> f64) -> Profile {
    let [width, height, depth] = SIZE;
    let place = |n: usize| DVec2::new((n % width) as f64, (n / width) as f64) * SIDE;
    let slice: Vec<f64> = (0..width * height).map(|n| value(place(n))).collect();
    let mut noise = noise();
    let values: Vec<f32> = (0..depth)
        .flat_map(|_| slice.iter().map(|value| (value + noise()) as f32).collect::<Vec<_>>())
        .collect();
    let volume = Volume::new(
        Voxels::F32(&values),
        SIZE,
        [1, width, width * height],
        DAffine3::from_scale(DVec3::splat(SIDE)),
    )
    .unwrap();
    let vessel = Vessel::new((1..12).map(|n| lumen.extend(f64::from(n))).collect(), None).unwrap();
    let wall = WallRequest::Automatic;
    measure(
        &volume,
        &vessel,
        &MeasureRequest { step: 0.5, fwhm: Some(FWHM), wall, tree: &[], stop: &|| false },
    )
    .unwrap()
}

fn sac(lumen: f64, outer: f64, off: f64, around: impl Fn(DVec2) -> f64) -> Profile {
    let at = MIDDLE + DVec2::from_angle(0.7) * off;
    let (inner, sac) = (disc(lumen, at), disc(outer, MIDDLE));
    profile(at, |place| {
        let (within, enclosed) = (inner(place), sac(place));
        LUMEN * within + THROMBUS * (enclosed - within) + around(place) * (1.0 - enclosed)
    })
}

fn seen(profile: &Profile) -> Vec<usize> {
    (0..profile.len()).filter(|n| profile.outer_wall[*n] == OuterWall::Seen).collect()
}

#[test]
fn the_outer_wall_of_a_sac_is_measured_with_its_uncertainty() {
    for (lumen, outer, off) in [
        (10.0, 15.0, 0.0),
        (10.0, 15.0, 2.0),
        (14.0, 22.0, 3.4),
        (20.0, 28.0, 0.0),
        (18.0, 28.0, 4.5),
        (12.0, 26.0, 5.0),
    ] {
        let found = sac(lumen, outer, off, |_| FAT);
        let all = seen(&found);
        assert!(5 * all.len() >= 4 * found.len(), "{lumen} in {outer}, {off}: {:?}", found.outer_wall);
        for n in all {
            let [diameter, unsure] = found.diameter_outer[n];
            assert!(
                (diameter - outer).abs() < 3.0 * unsure,
                "{lumen} in {outer}, {off}: {diameter} ± {unsure}"
            );
            assert!((0.05..0.4).contains(&unsure), "{unsure}");
            assert!((found.diameter_equivalent()[n] - lumen).abs() < 0.3, "the lumen stays the lumen");
        }
        let [volume, unsure] = found.outer_volume([2.0, 8.0]).unwrap();
        let truth = 6.0 * PI / 4.0 * outer * outer;
        assert!(
            (volume - truth).abs() < 3.0 * unsure && unsure < 0.04 * truth,
            "{volume} ± {unsure} for {truth}"
        );
    }
}

#[test]
fn muscle_on_one_side_leaves_the_outer_wall_and_muscle_all_around_hides_it() {
    // The edge of muscle lies 1 mm within the sac, so a sixth of its outline has no fat beside it.
    let beside = sac(14.0, 24.0, 2.0, |place| if place.x - MIDDLE.x > 11.0 { MUSCLE } else { FAT });
    let all = seen(&beside);
    assert!(2 * all.len() >= beside.len(), "{:?}", beside.outer_wall);
    for n in all {
        let [diameter, unsure] = beside.diameter_outer[n];
        assert!((diameter - 24.0).abs() < 3.0 * unsure, "{diameter} ± {unsure}");
        assert!(unsure > 0.15);
    }
    let around = sac(14.0, 24.0, 2.0, |_| MUSCLE);
    assert!(around.outer_wall.iter().all(|outer| *outer == OuterWall::Hidden), "{:?}", around.outer_wall);
    let error = around.outer_volume([2.0, 8.0]).expect_err("no volume");
    assert!(error.to_string().contains("none from 2.0 to 8.0 mm"), "{error}");
    assert_eq!(around.outer_stretch(), None);
    assert!(around.outer_volume([2.0, 4.0]).is_err(), "a stretch shorter than the gaps allowed");
}

#[test]
fn a_healthy_wall_a_vein_and_bright_tissue_are_no_sac() {
    let thin = sac(14.0, 17.0, 0.0, |_| FAT);
    assert!(thin.outer_wall.iter().all(|outer| *outer == OuterWall::Thin), "{:?}", thin.outer_wall);
    // A vein without contrast medium, as wide as the artery, touches it.
    let vein = disc(14.0, MIDDLE + DVec2::X * 14.5);
    let vein = sac(12.0, 14.5, 0.0, move |place| FAT + (THROMBUS - FAT) * vein(place));
    assert_eq!(seen(&vein), Vec::<usize>::new());
    assert!(vein.outer_contour.iter().all(Vec::is_empty));
}
