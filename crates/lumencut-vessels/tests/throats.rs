//! Measures tight eccentric stenoses of soft plaque in fat, whose blurred image is known exactly.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DMat2, DVec2, DVec3};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::random::Random;
use lumencut_vessels::measure::model::ellipse::{Boundary, Ellipse, Whitening};
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::section::blur::variance_of;
use lumencut_vessels::measure::section::flags::PLAQUE;
use lumencut_vessels::measure::stenosis::{Compared, Method};
use lumencut_vessels::measure::wall::WallRequest;

use crate::scans::noise;

const SIZE: [usize; 3] = [26, 26, 80];
const SIDE: f64 = 0.5;
const FWHM: f64 = 0.9;
const MIDDLE: DVec2 = DVec2::new(6.3, 6.2);

const NOISE: f64 = 15.0;

/// Diameter of the vessel (mm), and half of the length of the stenosis.
const NORMAL: f64 = 4.0;
const HALF: f64 = 3.0;

/// HU of fat, wall with plaque, and lumen.
const LEVELS: [f64; 3] = [-95.0, 50.0, 330.0];

/// The diameter of the lumen at z mm, narrowed to `least` mm, and its middle at the edge of the normal lumen.
fn lumen(z: f64, least: f64) -> (f64, DVec2) {
    let lost = (NORMAL - least) * (-((z - 20.0) / HALF).powi(4)).exp();
    (NORMAL - lost, MIDDLE + DVec2::X * (0.4 * lost))
}

fn disc(diameter: f64, center: DVec2, place: DVec2) -> f64 {
    let variance = variance_of(FWHM) + SIDE * SIDE / 12.0;
    let circle = Ellipse::circle(center, 0.5 * diameter);
    Boundary::new(&circle, Whitening::new(DMat2::from_diagonal(DVec2::splat(variance)))).value(place)
}

/// Blurs slices of `size` values along z, as the scanner does.
fn blurred_along(values: &[f32], size: usize) -> Vec<f32> {
    let slices: Vec<&[f32]> = values.chunks_exact(size).collect();
    let variance = (variance_of(FWHM) + SIDE * SIDE / 12.0) / (SIDE * SIDE);
    let weights: Vec<f64> = (-4..=4).map(|step| (-0.5 * f64::from(step * step) / variance).exp()).collect();
    let all: f64 = weights.iter().sum();
    let near = |k: usize, n: usize| slices[(k + n).saturating_sub(4).min(slices.len() - 1)];
    let value = |k: usize, place: usize| {
        (0..weights.len()).map(|n| weights[n] * f64::from(near(k, n)[place])).sum::<f64>() / all
    };
    (0..slices.len())
        .flat_map(|k| (0..size).map(move |place| (k, place)))
        .map(|(k, place)| value(k, place) as f32)
        .collect()
}

/// The profile of a vessel along z; `lumen_level` gives the level of its lumen (HU).
fn measured(least: f64, lumen_level: impl Fn(f64) -> f64) -> Profile {
    with_plaque(LEVELS[1], least, lumen_level)
}

fn with_plaque(wall: f64, least: f64, lumen_level: impl Fn(f64) -> f64) -> Profile {
    let fat = LEVELS[0];
    let [width, height, depth] = SIZE;
    let mut values = Vec::with_capacity(width * height * depth);
    for k in 0..depth {
        let z = k as f64 * SIDE;
        let (diameter, center) = lumen(z, least);
        for n in 0..width * height {
            let place = DVec2::new((n % width) as f64, (n / width) as f64) * SIDE;
            let outer = disc(NORMAL + 1.4, MIDDLE, place);
            let inner = disc(diameter, center, place);
            values.push((fat + (wall - fat) * outer + (lumen_level(z) - wall) * inner) as f32);
        }
    }
    let mut values = blurred_along(&values, width * height);
    let mut random = Random::new(1);
    values.iter_mut().for_each(|value| *value += (NOISE * noise(&mut random)) as f32);
    let affine = DAffine3::from_scale(DVec3::splat(SIDE));
    let volume = Volume::new(Voxels::F32(&values), SIZE, [1, width, width * height], affine).unwrap();
    let point = |n: i32| {
        let z = 3.0 + 0.5 * f64::from(n);
        lumen(z, least).1.extend(z)
    };
    let vessel = Vessel::new((0..67).map(point).collect(), None).unwrap();
    let wall = WallRequest::Automatic;
    let request = MeasureRequest { step: 0.5, fwhm: Some(FWHM), wall, tree: &[], stop: &|| false };
    measure(&volume, &vessel, &request).unwrap()
}

fn errors(profile: &Profile, least: f64) -> Vec<(f64, f64)> {
    let found = profile.diameter_equivalent();
    let counted = (0..profile.len()).filter(|n| profile.counts(*n));
    counted.map(|n| (found[n], lumen(profile.on_vessel[n].z, least).0)).collect()
}

#[test]
fn a_throat_of_soft_plaque_is_offered_and_no_section_beside_it_is_wrong() {
    for least in [0.4, 0.7, 1.0] {
        let profile = measured(least, |_| LEVELS[2]);
        let throat = profile.throat().expect("a throat");
        let z = profile.on_vessel[profile.nearest_section(throat.at)].z;
        assert!((z - 20.0).abs() <= 2.0, "{least}: {z}");
        assert!((least..least + 0.5).contains(&throat.diameter), "{least}: {}", throat.diameter);
        assert_eq!(profile.narrowest(), None);
        for (found, truth) in errors(&profile, least) {
            assert!((found - truth).abs() < 0.15 + 0.1 * truth, "{least}: {found} for {truth}");
        }
        for n in 0..profile.len() {
            let truth = lumen(profile.on_vessel[n].z, least).0;
            assert!(
                profile.at_most[n].is_nan() || profile.at_most[n] >= truth,
                "{least}: {} for {truth}",
                profile.at_most[n]
            );
        }
    }
}

#[test]
fn a_throat_has_no_percentage_but_a_reason() {
    let profile = measured(0.5, |_| LEVELS[2]);
    let throat = profile.throat().expect("a throat");
    let compared = Compared { reference: vec![throat.at - 12.0], ..Compared::default() };
    let error = profile.stenosis(throat.at, Method::Nascet, &compared).expect_err("no percentage");
    assert!(error.to_string().contains("no clear wall"), "{error}");
}

#[test]
fn a_stenosis_with_a_visible_lumen_is_measured() {
    let profile = measured(2.0, |_| LEVELS[2]);
    assert!(profile.throat().is_none());
    let narrowest = profile.narrowest().expect("a place");
    assert!((narrowest.diameter - 2.0).abs() < 0.2, "{}", narrowest.diameter);
}

#[test]
fn contrast_that_fades_over_a_long_way_is_no_throat() {
    let fading = measured(NORMAL, |z| LEVELS[2] - 5.0 * z);
    assert!(fading.throat().is_none());
    assert!((0..fading.len()).filter(|n| fading.counts(*n)).count() > 60);
}

#[test]
fn plaque_nearly_as_bright_as_the_lumen_is_told_and_its_uncertainty_holds() {
    let flagged = |profile: &Profile| -> Vec<usize> {
        (0..profile.len()).filter(|n| profile.flags[*n] & PLAQUE != 0).collect()
    };
    let bright = with_plaque(150.0, 2.2, |_| LEVELS[2]);
    let found = flagged(&bright);
    assert!(found.len() >= 6, "{found:?}");
    assert!(found.iter().all(|n| (bright.on_vessel[*n].z - 20.0).abs() < 5.0), "{found:?}");
    let holds = |n: &usize| {
        let (told, truth) = (bright.diameter_equivalent()[*n], lumen(bright.on_vessel[*n].z, 2.2).0);
        (told - truth).abs() <= 2.0 * bright.uncertainty[*n]
    };
    let held = found.iter().filter(|n| holds(n)).count();
    assert!(5 * held >= 4 * found.len(), "{held} of {found:?}");
    assert_eq!(flagged(&with_plaque(50.0, 2.2, |_| LEVELS[2])), Vec::<usize>::new());
}
