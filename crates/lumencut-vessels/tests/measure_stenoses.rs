//! Grades stenoses of known width, and suggests references.
#![allow(clippy::unwrap_used)]

use std::sync::LazyLock;

use lumencut_core::error::ErrorKind;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::groups::Territory;
use lumencut_vessels::measure::stenosis::{Compared, Method, Stenosis};
use lumencut_vessels::measure::wall::WallRequest;

use crate::scans::{FWHM, narrowed, profile};

fn narrowed_by(percent: f64) -> Profile {
    let (scan, line) = narrowed(percent);
    profile(&scan.volume(), line, Some(FWHM), WallRequest::Automatic).unwrap()
}

static BY_40: LazyLock<Profile> = LazyLock::new(|| narrowed_by(40.0));
static BY_50: LazyLock<Profile> = LazyLock::new(|| narrowed_by(50.0));

fn beside(reference: &[f64]) -> Compared {
    Compared { reference: reference.to_vec(), ..Compared::default() }
}

#[test]
fn stenoses_are_graded_to_three_points() {
    let others = [20.0, 60.0, 80.0].map(|percent| (percent, narrowed_by(percent)));
    for (percent, profile) in
        others.iter().map(|(percent, profile)| (*percent, profile)).chain([(40.0, &*BY_40)])
    {
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
    let graded = BY_40.stenosis(30.0, Method::Area, &beside(&[12.0, 40.0])).unwrap();
    let [[_, first], [_, second]] = graded.references[..] else { panic!("{:?}", graded.references) };
    assert_ne!(first, second);
    assert!((graded.reference - (first + (second - first) * 18.0 / 28.0)).abs() < 1e-9);
}

#[test]
fn references_are_suggested_where_walls_are_parallel() {
    let profile = &*BY_50;
    let [before, after] = profile.suggested_references(30.0).unwrap().map(Option::unwrap);
    assert!((20.0..=26.0).contains(&before.at) && (34.0..=40.0).contains(&after.at), "{before:?} {after:?}");
    assert!([before, after].iter().all(|spot| (spot.diameter / 5.0 - 1.0).abs() < 0.03));
    assert_eq!(profile.suggested_references(0.0).unwrap()[0], None);
    assert!(profile.suggested_references(99.0).is_err());
}

#[test]
fn nascet_is_refused_at_a_near_occlusion() {
    let profile = &*BY_50;
    let compared = |width| Compared { comparison: Some(width), ..beside(&[45.0]) };
    assert!(profile.stenosis(30.0, Method::Nascet, &compared(5.5)).unwrap().percent > 40.0);
    let error = profile.stenosis(30.0, Method::Nascet, &compared(6.0)).unwrap_err();
    assert!(error.to_string().contains("near-occlusion"), "{error}");
}

#[test]
fn groups_change_where_whole_percentages_do() {
    let graded = BY_40.stenosis(30.0, Method::Nascet, &beside(&[45.0])).unwrap();
    for (percent, carotid, coronary) in [
        (0.4, "below 50 %", "0 %: CAD-RADS 0"),
        (24.4, "below 50 %", "1 to 24 %: CAD-RADS 1"),
        (24.6, "below 50 %", "25 to 49 %: CAD-RADS 2"),
        (49.6, "50 to 69 %", "50 to 69 %: CAD-RADS 3"),
        (69.6, "70 to 99 %", "70 to 99 %: CAD-RADS 4"),
        (99.6, "70 to 99 %", "100 %: CAD-RADS 5"),
    ] {
        let of = |territory| Stenosis { percent, ..graded.clone() }.group(territory).unwrap();
        assert!(of(Territory::Carotid).starts_with(carotid), "{percent}");
        assert!(of(Territory::Coronary).starts_with(coronary), "{percent}");
    }
    let by_area = Stenosis { method: Method::Area, ..graded };
    assert_eq!(by_area.group(Territory::Carotid).unwrap_err().kind, ErrorKind::Measuring);
}
