//! Measures vessels whose blurred image is known exactly, and tests that long work stops on request.
#![allow(clippy::unwrap_used)]

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DMat2, DVec2, DVec3};
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_vessels::measure::model::ellipse::{Boundary, Ellipse, Whitening};
use lumencut_vessels::measure::profile::measuring::{TreeMeasuring, measure, tree_findings};
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::profile::{Profile, Source};
use lumencut_vessels::measure::section::blur::variance_of;
use lumencut_vessels::measure::section::flags::RECENTERED;
use lumencut_vessels::measure::stenosis::{Compared, Method};
use lumencut_vessels::measure::wall::WallRequest;

const SIZE: usize = 36;
const SIDE: f64 = 0.5;
const FWHM: f64 = 0.9;

/// A vessel along z whose slices show a blurred ellipse.
fn slices(ellipse: &Ellipse) -> Vec<f32> {
    let variance = variance_of(FWHM) + SIDE * SIDE / 12.0;
    let boundary = Boundary::new(ellipse, Whitening::new(DMat2::from_diagonal(DVec2::splat(variance))));
    let slice: Vec<f32> = (0..SIZE * SIZE)
        .map(|n| {
            let place = DVec2::new((n % SIZE) as f64, (n / SIZE) as f64) * SIDE;
            (40.0 + 300.0 * boundary.value(place)) as f32
        })
        .collect();
    slice.repeat(SIZE)
}

fn measured(ellipse: &Ellipse, fwhm: Option<f64>, stop: Stop) -> Result<Profile> {
    let values = slices(ellipse);
    let affine = DAffine3::from_scale(DVec3::splat(SIDE));
    let volume = Volume::new(Voxels::F32(&values), [SIZE; 3], [1, SIZE, SIZE * SIZE], affine)?;
    let points = [2.0, 15.0].map(|z| DVec3::new(9.2, 8.9, z)).to_vec();
    let request = MeasureRequest { step: 0.5, fwhm, wall: WallRequest::Automatic, tree: &[], stop };
    measure(&volume, &Vessel::new(points, None)?, &request)
}

fn tilted() -> Ellipse {
    Ellipse { center: DVec2::new(9.0, 9.1), mean: 2.0, stretch: DVec2::new(0.3, -0.4) }
}

#[test]
fn an_ellipse_is_measured_as_it_is() {
    let profile = measured(&tilted(), Some(FWHM), &|| false).unwrap();
    assert_eq!(profile.len(), 27);
    for n in 0..profile.len() {
        assert!((profile.diameter_min[n] - 3.0).abs() < 0.01, "{}", profile.diameter_min[n]);
        assert!((profile.diameter_max[n] - 5.0).abs() < 0.01, "{}", profile.diameter_max[n]);
        assert!(profile.center[n].truncate().distance(DVec2::new(9.0, 9.1)) < 0.01);
        assert_eq!(profile.flags[n], 0);
    }
    assert_eq!(profile.fwhm_source, Source::Given);
}

#[test]
fn the_point_spread_is_found() {
    let profile = measured(&Ellipse::circle(DVec2::new(9.0, 9.1), 2.6), None, &|| false).unwrap();
    assert!((profile.fwhm - FWHM).abs() < 0.03, "{}", profile.fwhm);
    assert!(matches!(profile.fwhm_source, Source::Estimated { .. }));
}

#[test]
fn long_work_stops_where_it_is_asked_to() {
    assert_eq!(measured(&tilted(), None, &|| true).unwrap_err().kind, ErrorKind::Interrupted);
}

#[test]
fn a_point_spread_that_nobody_waited_for_is_not_told() {
    let values = slices(&tilted());
    let affine = DAffine3::from_scale(DVec3::splat(SIDE));
    let volume = Volume::new(Voxels::F32(&values), [SIZE; 3], [1, SIZE, SIZE * SIZE], affine).unwrap();
    let tree =
        [Vessel::new([2.0, 15.0].map(|z| DVec3::new(9.2, 8.9, z)).to_vec(), Some(vec![2.0; 2])).unwrap()];
    // Interrupts the work at each of the first 40 calls of `stop`.
    for questions in 0..40 {
        let asked = AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, Ordering::Relaxed) >= questions;
        let request =
            MeasureRequest { step: 0.5, fwhm: None, wall: WallRequest::Automatic, tree: &tree, stop: &stop };
        let told = tree_findings(&volume, &request);
        assert_eq!(told.map_err(|error| error.kind), Err(ErrorKind::Interrupted), "{questions} questions");
    }
}

#[test]
fn vessels_of_a_tree_are_measured_as_by_themselves() {
    let values = slices(&tilted());
    let affine = DAffine3::from_scale(DVec3::splat(SIDE));
    let volume = Volume::new(Voxels::F32(&values), [SIZE; 3], [1, SIZE, SIZE * SIZE], affine).unwrap();
    let vessel = |ends: [f64; 2], radius| {
        let points = ends.map(|z| DVec3::new(9.2, 8.9, z)).to_vec();
        Vessel::new(points, Some(vec![radius; 2])).unwrap()
    };
    let tree = [vessel([2.0, 8.0], 2.0), vessel([8.0, 15.0], 2.5)];
    for wall in [WallRequest::Automatic, WallRequest::Level([30.0, 10.0]), WallRequest::Off] {
        let request = MeasureRequest { step: 0.5, fwhm: None, wall, tree: &tree, stop: &|| false };
        let measuring = TreeMeasuring::new(&volume, &request).unwrap();
        let told = measuring.findings(&|| false).unwrap();
        assert_eq!(told, tree_findings(&volume, &request).unwrap());
        for (n, vessel) in tree.iter().enumerate() {
            let alone = measure(&volume, vessel, &request).unwrap();
            let among = measuring.profile(n, told.clone(), &|| false).unwrap();
            assert_eq!((among.area, among.uncertainty), (alone.area, alone.uncertainty), "{wall:?}");
        }
    }
}

#[test]
fn a_vessel_of_one_width_has_no_stenosis() {
    let profile = measured(&tilted(), Some(FWHM), &|| false).unwrap();
    let compared = Compared { original: Some(8.0), ..Compared::default() };
    let graded = profile.stenosis(6.0, Method::Ecst, &compared).unwrap();
    assert!((graded.percent - 100.0 * (1.0 - 15.0_f64.sqrt() / 8.0)).abs() < 0.2);
    let nothing = profile.stenosis(6.0, Method::Nascet, &Compared::default()).unwrap_err();
    assert_eq!(nothing.kind, ErrorKind::Measuring);
}

#[test]
fn a_lumen_beside_the_line_does_not_count() {
    let values = slices(&Ellipse::circle(DVec2::new(9.0, 9.0), 2.0));
    let affine = DAffine3::from_scale(DVec3::splat(SIDE));
    let volume = Volume::new(Voxels::F32(&values), [SIZE; 3], [1, SIZE, SIZE * SIZE], affine).unwrap();
    // The second half of the line slowly leaves the lumen, whose wall is at x = 11 mm.
    let points = [(9.0, 2.0), (9.0, 8.0), (11.6, 15.0)].map(|(x, z)| DVec3::new(x, 9.0, z));
    let vessel = Vessel::new(points.to_vec(), Some(vec![2.0; 3])).unwrap();
    let wall = WallRequest::Automatic;
    let request = MeasureRequest { step: 0.5, fwhm: Some(FWHM), wall, tree: &[], stop: &|| false };
    let profile = measure(&volume, &vessel, &request).unwrap();
    let is_beside = |n: &usize| profile.flags[*n] & RECENTERED != 0;
    assert!((0..profile.len()).filter(is_beside).count() >= 2);
    assert!((0..profile.len()).filter(is_beside).all(|n| profile.area[n].is_finite() && !profile.counts(n)));
    assert!((0..12).all(|n| profile.counts(n)));
}
