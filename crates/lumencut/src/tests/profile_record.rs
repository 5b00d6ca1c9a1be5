//! Records of profiles: what comes back is what was measured, and nothing else is read.

use std::sync::LazyLock;

use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::Phantom;
use lumencut_vessels::measure::flap::found::Flap;
use lumencut_vessels::measure::outer::found::OuterWall;
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::wall::WallRequest;
use serde_json::{Value, json};

use super::*;
use crate::not_measured::not_measured;
use crate::profile_columns::parts_of;
use crate::profile_json::profile_json;
use crate::profile_marks::Marked;
use crate::profile_table::profile_csv;
use crate::report::plan;
use crate::study::tests::{opened, report_of};
use lumencut_vessels::measure::stenosis::{Compared, Method};

fn profile(wall: WallRequest) -> Profile {
    let Phantom { voxels, size, world_from_index, tree, .. } =
        lumencut_phantom::y_junction().expect("a phantom");
    let strides = [1, size[0], size[0] * size[1]];
    let volume = Volume::new(Voxels::I16(&voxels), size, strides, world_from_index).expect("a volume");
    let request = MeasureRequest { step: 3.0, fwhm: None, wall, tree: tree.vessels(), stop: &|| false };
    measure(&volume, &tree.vessels()[1], &request).expect("a profile")
}

fn read(text: &str) -> Result<(Profile, ScanDetails)> {
    ProfileRecord::read(text)?.profile()
}

fn text_of(profile: &Profile) -> String {
    ProfileRecord::of(profile, &ScanDetails::NOTHING).text()
}

fn record() -> Value {
    static RECORD: LazyLock<Value> =
        LazyLock::new(|| serde_json::from_str(&text_of(&profile(WallRequest::Off))).expect("JSON"));
    RECORD.clone()
}

#[test]
fn a_recorded_profile_is_the_same_to_the_bit() {
    let scan = ScanDetails { kernel: Some("Bv40".to_owned()), ..ScanDetails::NOTHING };
    for wall in [WallRequest::Automatic, WallRequest::Off, WallRequest::Level([30.0, 20.0])] {
        let mut profile = profile(wall);
        let odd = [-0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 5e-324, 0.1 + 0.2, f64::MAX];
        profile.uncertainty[..odd.len()].copy_from_slice(&odd);
        let (again, scan_again) = read(&ProfileRecord::of(&profile, &scan).text()).expect("the same profile");
        // The text of a number is that of no other number.
        assert_eq!(format!("{again:?}"), format!("{profile:?}"));
        assert_eq!(scan_again, scan);
        assert!(again.contour.iter().any(|points| points.len() == CONTOUR_POINTS));
    }
}

#[test]
fn flags_are_numbers_with_names_and_are_read_by_their_bits() {
    let mut record = record();
    assert_eq!((&record["format"], &record["flag_names"]["CALCIUM"]), (&json!(1), &json!(4)));
    assert_eq!(record["flag_names"].as_object().map(serde_json::Map::len), Some(FLAGS.len()));
    record["flags"][1] = json!(4 | 64);
    record["flag_names"] = json!({"lime": 4});
    let (profile, _) = read(&record.to_string()).expect("a profile");
    assert_eq!(profile.flags[1], 4 | 64);
}

#[test]
fn a_later_version_and_an_unknown_flag_are_refused_with_a_mend() {
    let [mut later, mut unknown] = [record(), record()];
    later["format"] = json!(2);
    later["more"] = json!([]);
    unknown["flags"][0] = json!(1 << 20);
    for (odd, words) in [
        (later, "found version 2; expected version 1; measure the vessel again"),
        (
            unknown,
            "found unknown flags (bits 0x100000); expected flags of this version (bits 0x1fff); measure",
        ),
    ] {
        let error = read(&odd.to_string()).expect_err("it is refused").to_string();
        assert!(error.starts_with(&format!("record of a profile: {words}")), "{error}");
    }
}

#[test]
fn every_source_is_stored() {
    let pooled = |given| {
        let by_others = PooledWall { level: [40.0, 12.5], vessels: 3 };
        WallSource::Pooled { given, by_others }
    };
    let walls = [
        WallSource::Hounsfield,
        WallSource::Given([45.0, 25.0]),
        pooled(None),
        pooled(Some([30.0, 10.0])),
        WallSource::Bright,
        WallSource::PerhapsBright,
        WallSource::NotAsked,
        WallSource::DarkLumen,
        WallSource::OtherUnit,
        WallSource::AsBright,
    ];
    for wall in walls {
        let (kind, numbers) = stored_wall(&wall);
        assert_eq!(restored_wall((&kind, &numbers)).expect("a wall"), wall);
    }
    let on = "16 wide sections".to_owned();
    for source in [Source::Given, Source::Estimated { on: on.clone() }, Source::Assumed { from: on }] {
        assert_eq!(restored_source(&stored_source(&source)).expect("a source"), source);
    }
}

#[test]
fn the_record_of_a_line_is_graded_as_the_page_shows_it() {
    let mut study = opened("stenosis");
    let line = report_of(&study)["vessels"][0]["line"].as_u64().expect("a line") as usize;
    study.profile(line, Some(0.75), &|| false).expect("a profile");
    let (again, _) = read(&study.profile_record(line, &|| false).expect("a record")).expect("a profile");
    let profile = study.measured(line, &|| false).expect("a profile");
    assert_eq!(again.fwhm, 0.75);
    for (at, reference, method) in [
        (31.0, vec![10.0, 52.0], Method::Nascet),
        (31.0, vec![52.0], Method::Area),
        (31.0, vec![], Method::Ecst),
        (31.0, vec![], Method::Nascet),
    ] {
        let compared = Compared { reference, original: Some(9.0), comparison: None };
        let marked = Marked {
            at: Some(at),
            method,
            compared,
            group: None,
            diameters: vec![20.0],
            confirmed: Vec::new(),
        };
        assert!(marked.grade(profile).is_some());
        assert_eq!(marked.grade(&again), marked.grade(profile));
        assert_eq!(marked.places(&again), marked.places(profile));
    }
}

/// Damaged values of a record (path, value), each with words that the error's `found` must contain.
fn damages() -> Vec<(&'static str, Value, &'static str)> {
    vec![
        ("/columns/area", json!([1.0]), "other numbers of sections"),
        ("/columns/axes", json!([1.0, 2.0]), "2 numbers as axes"),
        ("/columns/contour/0", json!(1e9), "numbers as contour"),
        ("/columns/contour/0", json!(999_999_999), "numbers as contour"),
        ("/columns/contour/0", json!(null), "numbers as contour"),
        ("/columns/contour/0", json!(-1), "numbers as contour"),
        ("/columns/contour", json!([1, 0, 0, 0]), "other numbers of sections"),
        ("/columns/noise", json!([]), "0 numbers as noise"),
        ("/columns/fwhm/0", json!(null), "a point spread of NaN mm"),
        ("/columns/fwhm/0", json!(-1), "a point spread of -1 mm"),
        ("/columns/arc_length/1", json!(null), "do not ascend"),
        ("/columns/arc_length/1", json!(0.0), "do not ascend"),
        ("/columns/arc_length/1", json!("infinity"), "do not ascend"),
        ("/columns/arc_length/1", json!("far"), "an infinity in other words"),
        ("/columns/arc_length/1", json!([]), "invalid type"),
        ("/columns", json!({}), "no column arc_length"),
        ("/flags", json!([]), "other numbers of sections"),
        ("/flags/0", json!("calcium"), "invalid type"),
        ("/flags/0", json!(-1), "invalid value"),
        ("/flags/0", json!(1.5), "invalid type"),
        ("/wall_source", json!(["hounsfield", [1.0]]), "a wall from 'hounsfield'"),
        ("/wall_source", json!(["pooled", [1.0, 2.0, 1e300]]), "a wall from 'pooled'"),
        ("/fwhm_source/0", json!("guessed"), "a point spread from 'guessed'"),
        ("/format", json!(null), "invalid type"),
    ]
}

#[test]
fn what_is_damaged_is_refused_by_name() {
    for (place, value, words) in damages() {
        let mut damaged = record();
        *damaged.pointer_mut(place).expect("a place of the record") = value;
        let error = read(&damaged.to_string()).expect_err(place);
        assert_eq!((error.kind, error.subject.as_str()), (ErrorKind::Measuring, SUBJECT));
        assert!(error.found.contains(words), "{place}: {}", error.found);
    }
    let mut more = record();
    more["columns"]["colour"] = json!([]);
    assert_eq!(read(&more.to_string()).expect_err("a column").found, "a column colour");
    for text in ["", "[]", "null", "{\"format\": 1}", "{\"vessels\": []}", "nonsense"] {
        assert_eq!(read(text).expect_err(text).subject, SUBJECT);
    }
}

#[test]
fn a_contour_of_other_rays_and_too_many_sections_are_refused() {
    let mut odd = profile(WallRequest::Off);
    odd.contour[0].push(DVec3::ZERO);
    assert_eq!(read(&text_of(&odd)).expect_err("a contour").found, "a contour of 65 points");
    let mut many = empty();
    let count = MOST_SECTIONS as usize + 1;
    many.arc_length = (0..count).map(|n| n as f64).collect();
    for numbers in [
        &mut many.diameter_min,
        &mut many.diameter_max,
        &mut many.area,
        &mut many.at_most,
        &mut many.uncertainty,
        &mut many.inscribed_radius,
        &mut many.line_values,
    ] {
        numbers.resize(count, f64::NAN);
    }
    for pairs in [&mut many.wall, &mut many.diameter_outer, &mut many.bounds, &mut many.levels] {
        pairs.resize(count, [f64::NAN; 2]);
    }
    for points in [&mut many.center, &mut many.normal, &mut many.on_vessel] {
        points.resize(count, DVec3::NAN);
    }
    many.uncertainty_parts.resize(count, parts_of(&[0.0; 5]));
    many.flags.resize(count, 0);
    many.axes.resize(count, [DVec3::X; 2]);
    many.half_axes.resize(count, [DVec3::X; 2]);
    many.contour.resize(count, Vec::new());
    many.outer_wall.resize(count, OuterWall::Thin);
    many.outer_contour.resize(count, Vec::new());
    many.flap.resize(count, Flap::Absent);
    many.own_lumen.resize(count, Vec::new());
    many.other_lumen.resize(count, Vec::new());
    many.area_own_lumen.resize(count, [1.5; 2]);
    many.area_other_lumen.resize(count, [1.5; 2]);
    assert_eq!(read(&text_of(&many)).expect_err("too many").found, "20001 sections, more than 20000");
}

/// What hosts do with a profile that they read.
fn used(profile: &Profile, scan: &ScanDetails) {
    let compared = Compared { reference: vec![5.0], ..Compared::default() };
    let (method, diameters) = (Method::Nascet, vec![3.0]);
    let marked = Marked { at: Some(10.0), method, compared, group: None, diameters, confirmed: Vec::new() };
    let _ = (marked.grade(profile), marked.places(profile), not_measured(profile));
    let _ = (profile_csv(profile, scan), profile_json(profile, scan), plan(profile, &[], 64));
    let _ = (profile.c_arm([0.0, 5.0], None), profile.direction([0.0, 5.0]));
}

#[test]
fn damaged_texts_never_panic() {
    let text = text_of(&profile(WallRequest::Off));
    let (mut seed, mut accepted) = (7_u64, 0);
    let mut next = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    for _ in 0..300 {
        let mut bytes = text.clone().into_bytes();
        for _ in 0..=next(3) {
            let place = next(bytes.len());
            match next(4) {
                0 => bytes.truncate(place),
                1 => drop(bytes.drain(place..(place + next(40)).min(bytes.len()))),
                _ => bytes[place] = b"0123456789e-+.,[]n"[next(18)],
            }
            bytes.push(b' ');
        }
        if let Ok((profile, scan)) = read(&String::from_utf8_lossy(&bytes)) {
            accepted += 1;
            used(&profile, &scan);
        }
    }
    assert!(accepted > 30, "{accepted} of 300 are read");
}
