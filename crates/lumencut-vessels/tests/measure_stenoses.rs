//! Grades stenoses of known width, and suggests references.
#![allow(clippy::unwrap_used)]

use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::{Compared, Method};
use lumencut_vessels::measure::wall::WallRequest;

use crate::scans::{FWHM, narrowed, profile};

fn narrowed_by(percent: f64) -> Profile {
    let (scan, line) = narrowed(percent);
    profile(&scan.volume(), line, Some(FWHM), WallRequest::Automatic).unwrap()
}

fn beside(reference: &[f64]) -> Compared {
    Compared { reference: reference.to_vec(), ..Compared::default() }
}

#[test]
fn stenoses_are_graded_to_three_points() {
    for percent in [20.0, 40.0, 60.0, 80.0] {
        let profile = narrowed_by(percent);
        let graded = profile.stenosis(30.0, Method::Nascet, &beside(&[45.0])).unwrap();
        assert!((graded.percent - percent).abs() < 3.0, "{percent}: {}", graded.percent);
        assert!((graded.percent - 100.0 * (1.0 - graded.diameter / graded.reference)).abs() < 1e-9);
        assert!((graded.reference / 5.0 - 1.0).abs() < 0.02, "{}", graded.reference);
        let area = profile.stenosis(30.0, Method::Area, &beside(&[15.0, 45.0])).unwrap().percent;
        assert!((area - 100.0 * (1.0 - (1.0 - percent / 100.0).powi(2))).abs() < 3.0, "{percent}: {area}");
        let narrowest = profile.narrowest().unwrap();
        assert!((narrowest.at - 30.0).abs() <= 1.5, "{}", narrowest.at);
    }
}

#[test]
fn two_references_are_weighted_by_their_distances() {
    let graded = narrowed_by(40.0).stenosis(30.0, Method::Area, &beside(&[12.0, 40.0])).unwrap();
    let [[_, first], [_, second]] = graded.references[..] else { panic!("{:?}", graded.references) };
    assert_ne!(first, second);
    assert!((graded.reference - (first + (second - first) * 18.0 / 28.0)).abs() < 1e-9);
}

#[test]
fn references_are_suggested_where_walls_are_parallel() {
    let profile = narrowed_by(50.0);
    let [before, after] = profile.suggested_references(30.0).unwrap().map(Option::unwrap);
    assert!((20.0..=26.0).contains(&before.at) && (34.0..=40.0).contains(&after.at), "{before:?} {after:?}");
    assert!([before, after].iter().all(|spot| (spot.diameter / 5.0 - 1.0).abs() < 0.03));
    assert_eq!(profile.suggested_references(0.0).unwrap()[0], None);
    assert!(profile.suggested_references(99.0).is_err());
}

#[test]
fn nascet_is_refused_at_a_near_occlusion() {
    let profile = narrowed_by(50.0);
    let compared = |width| Compared { comparison: Some(width), ..beside(&[45.0]) };
    assert!(profile.stenosis(30.0, Method::Nascet, &compared(5.5)).unwrap().percent > 40.0);
    let error = profile.stenosis(30.0, Method::Nascet, &compared(6.0)).unwrap_err();
    assert!(error.to_string().contains("near-occlusion"), "{error}");
}
