//! Tests measurements by the study against tubes of known diameter and against the core.

use std::f64::consts::{FRAC_PI_6, PI};
use std::sync::LazyLock;

use glam::{DMat2, DVec2, DVec3};
use lumencut_core::vessel_tree::Vessel;
use lumencut_vessels::measure::model::ellipse::{Boundary, Ellipse, Whitening};
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::section::blur::variance_of;
use lumencut_vessels::measure::wall::WallRequest;
use serde_json::{Value as Json, json};

use super::*;
use crate::measure_words::of_diameter;
use crate::study::lines::ListedLine;
use crate::study::measure_messages::{
    GradeMessage, MarksMessage, ProfileMessage, SectionMessage, StretchMessage,
};
use crate::study::tests::{LPS, opened, report_of};

const SIZE: [usize; 3] = [40, 40, 80];
const SIDE: f64 = 0.5;
const FWHM: f64 = 0.8;
const MIDDLE: DVec2 = DVec2::new(10.0, 9.8);
const LONGEST: f64 = FRAC_PI_6;

fn go_on() -> bool {
    false
}

/// The lumen at a height z: axes of 4 and 6 mm, the longer one at 30 degrees to x; 60 % narrower at 20 mm.
fn lumen(z: f64) -> Ellipse {
    let away = ((z - 20.0) / 8.0).abs().min(1.0);
    let left = 1.0 - 0.6 * (0.5 + 0.5 * (PI * away).cos());
    let stretch = DVec2::from_angle(2.0 * LONGEST) * 0.5;
    Ellipse { center: MIDDLE, mean: 2.5, stretch }.scaled(left)
}

fn voxels() -> Vec<u8> {
    let variance = variance_of(FWHM) + SIDE * SIDE / 12.0;
    let blur = DMat2::from_diagonal(DVec2::splat(variance));
    let mut bytes = Vec::new();
    for k in 0..SIZE[2] {
        let boundary = Boundary::new(&lumen(k as f64 * SIDE), Whitening::new(blur));
        for n in 0..SIZE[0] * SIZE[1] {
            let place = DVec2::new((n % SIZE[0]) as f64, (n / SIZE[0]) as f64) * SIDE;
            bytes.extend((40.0 + 300.0 * boundary.value(place) as f32).to_le_bytes());
        }
    }
    bytes
}

fn line(from: f64, to: f64) -> String {
    let rows: Vec<String> =
        (0..=30).map(|n| format!("10.2,9.9,{},2.5\n", from + (to - from) * f64::from(n) / 30.0)).collect();
    format!("x,y,z,radius\n{}", rows.concat())
}

fn tube() -> Study {
    let mut study = Study::default();
    let rows = [[SIDE, 0.0, 0.0, 0.0], [0.0, SIDE, 0.0, 0.0], [0.0, 0.0, SIDE, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let header = json!({"size": SIZE, "dtype": "float32", "world_from_index": rows});
    study.begin_volume(&header.to_string()).expect("room");
    let bytes = voxels();
    study.voxel_bytes(0, bytes.len()).expect("room").copy_from_slice(&bytes);
    open_line(&mut study, 2.0, 37.0);
    study
}

fn open_line(study: &mut Study, from: f64, to: f64) {
    study.open_centerlines(line(from, to).as_bytes(), "line.csv", LPS).expect("a line");
}

fn line_of(study: &Study, vessel: usize) -> usize {
    let report = report_of(study);
    report["vessels"][vessel]["line"].as_u64().expect("a line") as usize
}

#[allow(clippy::needless_pass_by_value, reason = "a literal is read at once")]
fn marks(text: Json) -> MarksMessage {
    let mut all = json!({"at": null, "references": [], "method": "nascet", "original": null, "comparison": null, "group": null});
    let Json::Object(named) = text else { panic!("{text} has no names") };
    for (name, value) in named {
        all[name] = value;
    }
    serde_json::from_value(all).expect("marks")
}

fn as_json(value: impl serde::Serialize) -> Json {
    serde_json::to_value(value).expect("JSON")
}

#[test]
fn a_tube_is_as_wide_as_it_was_painted() {
    let mut study = tube();
    let line = line_of(&study, 0);
    let profile = study.profile(line, Some(FWHM), &go_on).expect("a profile");
    let told = as_json(ProfileMessage::from(profile));
    for (n, at) in told["arc_length"].as_array().expect("places").iter().enumerate() {
        let z = 2.0 + at.as_f64().expect("a place");
        let [short, long] = lumen(z).semi_axes().map(|half| 2.0 * half);
        let found = |name: &str| told[name][n].as_f64().expect("a number");
        assert!((found("diameter_min") - short).abs() < 0.05, "{z}: {} of {short}", found("diameter_min"));
        assert!((found("diameter_max") - long).abs() < 0.05, "{z}: {} of {long}", found("diameter_max"));
        assert!((found("area") - PI / 4.0 * short * long).abs() < 0.25);
        assert!(told["counts"][n].as_bool().expect("a word"));
    }
    assert!((told["narrowest"]["at"].as_f64().expect("a place") - 18.0).abs() <= 0.5);
    assert_eq!((&told["fwhm"], &told["fwhm_source"]), (&json!(FWHM), &json!("given")));
}

#[test]
fn a_stenosis_has_the_percentage_that_was_painted() {
    let mut study = tube();
    let line = line_of(&study, 0);
    let profile = study.profile(line, Some(FWHM), &go_on).expect("a profile");
    let grade = |text| as_json(GradeMessage::of(&marks(text).marked().expect("marks"), profile));
    let graded = |text| Some(grade(text)["stenosis"].take()).filter(|stenosis| !stenosis.is_null());
    let whole =
        graded(json!({"at": 18.0, "references": [5.0, 31.0], "group": "carotid"})).expect("a stenosis");
    let percent = whole["percent"].as_f64().expect("a number");
    assert!((percent - 60.0).abs() < 0.7, "{percent}");
    assert!(
        whole["words"].as_str().expect("words").starts_with("60 ± 1 % of the diameter (NASCET): "),
        "{whole}"
    );
    assert!(whole["group"].as_str().expect("a group").starts_with("50 to 69 %"));
    let area = graded(json!({"at": 18.0, "references": [31.0], "method": "area"})).expect("a stenosis");
    assert!((area["percent"].as_f64().expect("a number") - 84.0).abs() < 0.7);
    let ecst = json!({"at": 18.0, "method": "ecst", "original": 8.0, "group": "carotid"});
    let ecst = graded(ecst).expect("a stenosis");
    let expected = 100.0 * (1.0 - 0.4 * 24.0_f64.sqrt() / 8.0);
    assert!((ecst["percent"].as_f64().expect("a number") - expected).abs() < 0.7);
    // Only NASCET has groups.
    assert!(ecst["group"].is_null());
    assert_eq!(whole["doubts"], json!([]));
}

const NO_REFERENCE: &str = "mark a reference where the vessel is normal.";

#[test]
fn a_place_that_is_not_graded_has_its_diameter_and_the_reason() {
    let mut study = tube();
    let line = line_of(&study, 0);
    let profile = study.profile(line, Some(FWHM), &go_on).expect("a profile");
    let grade = |text| as_json(GradeMessage::of(&marks(text).marked().expect("marks"), profile));
    let known = of_diameter(profile.diameter_at(18.0).expect("measured"), 18.0) + ". ";
    for (given, reason) in [
        (json!({"at": 18.0}), NO_REFERENCE),
        (json!({"at": 18.0, "method": "area", "original": 8.0}), NO_REFERENCE),
        (json!({"at": 18.0, "method": "ecst"}), "ECST needs the assumed original diameter at that place."),
        (
            json!({"at": 18.0, "references": [99.0]}),
            "reference of the stenosis: found 99 mm; expected an arc length from 0 to 35.000 mm",
        ),
        (json!({"references": [5.0]}), "mark the place of the stenosis."),
        (json!({"at": 99.0}), "place on the vessel: found 99 mm; expected an arc length from 0 to 35.000 mm"),
    ] {
        let first = if given["at"] == 18.0 { known.as_str() } else { "" };
        let words = format!("{first}No percentage: {reason}");
        assert_eq!(grade(given), json!({"stenosis": null, "not_graded": words, "narrower": null}));
    }
    // If nothing is marked, nothing is missing.
    for given in [json!({}), json!({"method": "ecst", "original": 8.0, "group": "carotid"})] {
        assert_eq!(grade(given), json!({"stenosis": null, "not_graded": null, "narrower": null}));
    }
    assert_eq!(marks(json!({"method": "who"})).marked().expect_err("no method").kind, "settings");
    assert_eq!(marks(json!({"group": "aorta"})).marked().expect_err("no territory").kind, "settings");
}

#[test]
fn what_another_method_needs_is_left_aside() {
    let mut study = tube();
    let line = line_of(&study, 0);
    let profile = study.profile(line, Some(FWHM), &go_on).expect("a profile");
    let grade = |text| as_json(GradeMessage::of(&marks(text).marked().expect("marks"), profile));
    for method in ["nascet", "area", "ecst"] {
        let all =
            json!({"at": 18.0, "references": [31.0], "original": 8.0, "comparison": 5.0, "method": method});
        let used = match method {
            "nascet" => json!({"at": 18.0, "references": [31.0], "comparison": 5.0}),
            "area" => json!({"at": 18.0, "references": [31.0], "method": method}),
            _ => json!({"at": 18.0, "original": 8.0, "method": method}),
        };
        assert!(grade(all.clone())["stenosis"]["percent"].is_f64(), "{method}");
        assert_eq!(grade(all), grade(used), "{method}");
    }
    // ECST ignores the reference, so an invalid one is no error.
    let ecst = json!({"at": 18.0, "references": [99.0], "original": 8.0, "method": "ecst"});
    assert_eq!(grade(ecst)["stenosis"]["references"], json!([]));
}

#[test]
fn the_diameters_of_a_section_lie_where_they_were_painted() {
    let mut study = tube();
    let line = line_of(&study, 0);
    let profile = study.profile(line, Some(FWHM), &go_on).expect("a profile");
    let section = as_json(SectionMessage::nearest(profile, 3.1));
    assert_eq!(section["number"], json!(6));
    let ends = |name: &str| {
        [0, 1]
            .map(|end| serde_json::from_value::<[f64; 3]>(section[name][end].clone()).expect("an end"))
            .map(DVec3::from)
    };
    let along = DVec2::from_angle(LONGEST);
    for (name, length, direction) in [("longest", 6.0, along), ("shortest", 4.0, along.perp())] {
        let [from, to] = ends(name);
        assert!((from.distance(to) - length).abs() < 0.05, "{name}");
        let towards = (to - from).truncate().normalize();
        assert!(towards.perp_dot(direction).abs() < 0.02, "{name} towards {towards}");
        assert!(((from + to) / 2.0).truncate().distance(MIDDLE) < 0.02, "{name}");
    }
    for point in section["contour"].as_array().expect("a contour") {
        let [x, y, z] = serde_json::from_value::<[f64; 3]>(point.clone()).expect("a point");
        let outwards = DVec2::new(x, y) - MIDDLE;
        let wall = lumen(z).radius_towards(outwards.normalize());
        assert!((outwards.length() - wall).abs() < 0.1, "{} of {wall}", outwards.length());
    }
}

#[test]
fn a_stretch_is_seen_by_a_c_arm_from_the_front() {
    let mut study = tube();
    let line = line_of(&study, 0);
    let profile = study.profile(line, Some(FWHM), &go_on).expect("a profile");
    let stretch = as_json(StretchMessage::between(profile, [4.0, 30.0]).expect("a stretch"));
    for (name, expected) in [("length", 26.0), ("straight", 26.0), ("tortuosity", 1.0), ("cranial", 0.0)] {
        assert!((stretch[name].as_f64().expect("a number") - expected).abs() < 1e-3, "{name}");
    }
    let vector =
        |value: &Json| DVec3::from(serde_json::from_value::<[f64; 3]>(value.clone()).expect("a vector"));
    assert!(vector(&stretch["direction"]).distance(DVec3::Z) < 1e-3);
    // The view runs from the front into the patient, with the head up.
    assert!(vector(&stretch["view"]["direction"]).distance(DVec3::Y) < 1e-3);
    assert!(vector(&stretch["view"]["up"]).distance(DVec3::Z) < 1e-3);
    assert_eq!(stretch["c_arm"], json!("LAO 0° CRAN 0°"));
    assert!(StretchMessage::between(profile, [4.0, 4.0]).is_err());
}

fn listed(line: usize) -> ListedLine {
    ListedLine { line, name: String::new(), hidden: false, ..Default::default() }
}

fn measured_by_core(study: &Study, tree: &[Vessel]) -> Profile {
    let volume = study.content.held.as_ref().expect("a volume").volume().expect("a volume");
    measure(
        &volume,
        &tree[0],
        &MeasureRequest { step: 0.5, fwhm: None, wall: WallRequest::Automatic, tree, stop: &go_on },
    )
    .expect("a profile")
}

/// The trunk of the junction, measured by the core: among all vessels, and as the only one.
static TRUNK: LazyLock<[Profile; 2]> = LazyLock::new(|| {
    let study = opened("y_junction");
    let tree = study.content.tree().expect("a tree").tree().clone();
    [tree.vessels(), &tree.vessels()[..1]].map(|tree| measured_by_core(&study, tree))
});

#[test]
fn profiles_are_those_of_the_core_among_the_vessels_that_are_shown() {
    let mut study = opened("y_junction");
    let tree = study.content.tree().expect("a tree").tree().clone();
    let [trunk, branch] = [0, 1].map(|vessel| line_of(&study, vessel));
    let [among_all, alone] = &*TRUNK;
    let found = study.profile(trunk, None, &go_on).expect("a profile");
    assert_eq!(
        (&found.flags, &found.area, &found.fwhm_source),
        (&among_all.flags, &among_all.area, &among_all.fwhm_source)
    );
    // A single vessel has no branches, and the point spread is estimated from it.
    let branch_alone = measured_by_core(&study, &tree.vessels()[1..=1]);
    for (line, expected) in [(trunk, alone), (branch, &branch_alone)] {
        study.show(&[listed(line)]).expect("one line");
        assert_ne!((&expected.flags, expected.fwhm), (&among_all.flags, among_all.fwhm));
        let found = study.measured(line, &go_on).expect("a profile");
        assert_eq!((&found.flags, &found.area), (&expected.flags, &expected.area));
        assert_eq!((found.fwhm, &found.fwhm_source), (expected.fwhm, &expected.fwhm_source));
    }
}

#[test]
fn hiding_a_vessel_changes_no_number() {
    let mut study = opened("y_junction");
    let tree = study.content.tree().expect("a tree").tree().clone();
    let lines: Vec<usize> = (0..tree.vessels().len()).map(|vessel| line_of(&study, vessel)).collect();
    let [among_all, alone] = &*TRUNK;
    assert_ne!((&alone.flags, alone.fwhm), (&among_all.flags, among_all.fwhm));
    let hidden = |line: &usize| ListedLine { hidden: *line != lines[0], ..listed(*line) };
    let list: Vec<_> = lines.iter().map(hidden).collect();
    study.show(&list).expect("one vessel, others hidden");
    assert_eq!(report_of(&study)["vessels"].as_array().map(Vec::len), Some(1));
    let found = study.profile(lines[0], None, &go_on).expect("a profile").clone();
    assert_eq!((&found.flags, &found.area), (&among_all.flags, &among_all.area));
    assert_eq!((found.fwhm, &found.fwhm_source), (among_all.fwhm, &among_all.fwhm_source));
    // A line that is shown again is not measured again.
    study.show(&lines.iter().map(|line| listed(*line)).collect::<Vec<_>>()).expect("all of them");
    assert_eq!(study.profile(lines[0], None, &|| true).expect("kept").area, among_all.area);
    study
        .show(&lines.iter().map(|line| ListedLine { hidden: true, ..listed(*line) }).collect::<Vec<_>>())
        .expect("none");
    assert_eq!(report_of(&study)["vessels"], json!(null));
}

#[test]
fn profiles_are_kept_until_other_vessels_are_shown() {
    let mut study = tube();
    let line = line_of(&study, 0);
    let never = || true;
    assert_eq!(study.profile(line, None, &never).expect_err("stopped").kind, "interrupted");
    let first = study.profile(line, Some(FWHM), &go_on).expect("a profile").clone();
    study.profile(line, Some(1.0), &go_on).expect("a profile");
    // Returning a cached profile never asks whether to stop.
    assert_eq!(study.profile(line, Some(FWHM), &never).expect("kept").area, first.area);
    assert_eq!(study.measured(line, &never).expect("kept").area, first.area);
    // The same line is shown under another name.
    study.show(&[ListedLine { name: "carotid".into(), ..listed(line) }]).expect("the line");
    assert_eq!(study.profile(line, Some(FWHM), &never).expect("kept").area, first.area);
    open_line(&mut study, 3.0, 37.0);
    let line = line_of(&study, 0);
    assert_eq!(study.profile(line, Some(FWHM), &never).expect_err("another line").kind, "interrupted");
    let width = study.profile(line, Some(FWHM), &go_on).expect("a profile").clone();
    assert!((width.length() - 34.0).abs() < 1e-9);
    study.voxels_changed();
    assert_eq!(study.profile(line, Some(FWHM), &never).expect_err("other voxels").kind, "interrupted");
}

#[test]
fn only_lines_that_are_shown_are_measured() {
    let mut study = tube();
    let failure = study.profile(usize::MAX, None, &go_on).expect_err("no line");
    assert_eq!((failure.kind, failure.subject.as_str()), ("vessel tree", "number of the line"));
    assert_eq!(Study::default().profile(0, None, &go_on).expect_err("nothing").kind, "volume");
}

fn vessel(study: &Study, number: usize, marked: Json) -> VesselMessage {
    let (id, name) = (number.to_string(), String::new());
    VesselMessage { id, name, line: line_of(study, number), marks: marks(marked) }
}

#[test]
fn json_names_what_was_asked_of_one_vessel() {
    let mut study = tube();
    let line = line_of(&study, 0);
    study.profile(line, Some(FWHM), &go_on).expect("a profile");
    let read = |study: &mut Study, marked: Json| -> Json {
        let vessels = [vessel(study, 0, marked)];
        serde_json::from_str(&study.profiles_json(&vessels, false, &go_on).expect("a text")).expect("JSON")
    };
    let whole = read(&mut study, json!({"at": 18.0, "references": [31.0], "group": "carotid"}));
    assert_eq!(
        whole["settings"],
        json!({"step_mm": 0.5, "fwhm_mm": FWHM, "at_mm": 18.0, "reference_mm": [31.0], "method": "nascet",
            "original_mm": null, "comparison_mm": null, "group": "carotid"})
    );
    assert!(whole["vessels"][0]["name"].is_null());
    assert!((whole["vessels"][0]["stenosis"]["percent"].as_f64().expect("a number") - 60.0).abs() < 0.7);
    let place = read(&mut study, json!({"at": 18.0, "group": "carotid"}));
    assert_eq!((&place["settings"]["at_mm"], &place["settings"]["method"]), (&json!(18.0), &Json::Null));
    assert!(place["vessels"][0]["stenosis"].is_null());
}

#[test]
fn tables_have_a_line_for_each_section_of_each_vessel() {
    let mut study = opened("y_junction");
    let vessels = [0, 2].map(|number| vessel(&study, number, json!({"at": 10.0})));
    let text = study.profiles_csv(&vessels, false, &go_on).expect("a table");
    let counts = vessels.each_ref().map(|one| study.measured(one.line, &go_on).expect("a profile").len());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 1 + counts[0] + counts[1]);
    assert!(lines[0].starts_with("vessel,name,arc_length_mm,"));
    let scan = "series_number,series_description,phase,slice_thickness_mm,kernel";
    assert!(lines[0].ends_with(&format!(",wall_source,{scan},stenosis,doubts,not_graded")));
    assert!(lines[1..].iter().all(|line| line.ends_with(",,,mark a reference where the vessel is normal.")));
    assert!(lines[1].starts_with("0,,0,") && lines[1 + counts[0]].starts_with("2,,0,"));
    // With several vessels, the settings contain no place.
    let all: Json =
        serde_json::from_str(&study.profiles_json(&vessels, false, &go_on).expect("a text")).expect("JSON");
    assert!(all["settings"]["at_mm"].is_null());
    assert_eq!(all["vessels"].as_array().map(Vec::len), Some(2));
    assert_eq!(study.profiles_csv(&[], false, &go_on).expect("a table"), "");
}

#[test]
fn numbers_are_told_with_how_their_scan_was_made() {
    let mut study = tube();
    let vessels = [vessel(&study, 0, json!({}))];
    study.content.held.as_mut().expect("a volume").scan =
        serde_json::from_value(json!({"kernel": "B30f", "phase": null})).expect("what a file states");
    let text = study.profiles_json(&vessels, false, &go_on).expect("a text");
    let scan = &serde_json::from_str::<Json>(&text).expect("JSON")["vessels"][0]["scan"];
    assert_eq!((&scan["kernel"], &scan["series_number"]), (&json!("B30f"), &Json::Null));
    let words = study.report().expect("a report").volume.expect("a volume").scan;
    assert_eq!(words, "kernel B30f; series, phase, slice thickness not stated");
    let table = study.profiles_csv(&vessels, false, &go_on).expect("a table");
    assert!(table.lines().skip(1).all(|line| line.contains(",not stated,not stated,not stated,,B30f,")));
}
