//! Tests that opening a scan or centerlines reports doubts about order, unit and size.

use glam::DVec3;
use lumencut_io::Unit;
use serde_json::json;

use super::{opened, report_of};
use crate::places::Statement;
use crate::study::centerline_files::AskedMessage;
use crate::study::open_study::Study;

#[test]
fn points_in_another_order_are_noted_and_can_be_put_in_order() {
    let mut study = opened("stenosis");
    let points = study.content.tree().expect("a tree").tree().vessels()[0].points().to_vec();
    let markups = |points: &[DVec3]| {
        let points: Vec<_> = points.iter().map(|p| json!({"position": [p.x, p.y, p.z]})).collect();
        let units = json!({"type": "Curve", "coordinateSystem": "LPS", "coordinateUnits": "mm"});
        let mut markup = units.as_object().cloned().expect("an object");
        markup.insert("controlPoints".to_owned(), json!(points));
        json!({"markups": [markup]}).to_string()
    };
    let open = |study: &mut Study, points: &[DVec3], reorder: bool| {
        let asked = AskedMessage { reorder: Some(reorder), ..AskedMessage::default() };
        study.open_centerlines(markups(points).as_bytes(), "line.mrk.json", asked).expect("a line").notes
    };
    let has_doubt = |notes: &[String]| {
        notes.iter().any(|note| note.contains("perhaps its points are in the wrong order"))
    };
    let mut turned = points.clone();
    turned.rotate_left(2);
    assert!(!has_doubt(&open(&mut study, &points, false)));
    assert!(report_of(&study)["can_reorder"].is_null());
    assert!(has_doubt(&open(&mut study, &turned, false)));
    assert_eq!(report_of(&study)["can_reorder"], true);
    let notes = open(&mut study, &turned, true);
    assert!(!has_doubt(&notes) && notes.iter().any(|note| note.contains("were reordered")), "{notes:?}");
    assert!(report_of(&study)["can_reorder"].is_null());
    assert_eq!(study.content.tree().expect("a tree").tree().vessels()[0].points(), points);
}

#[test]
fn a_unit_that_makes_no_vessels_is_doubted_and_can_be_chosen() {
    let mut study = opened("stenosis");
    let line = |unit: f64, space: &str| -> String {
        let point = |n: i32| format!(",{},{},{},1", 0.5 / unit, 0.5 / unit, f64::from(n) / unit);
        let points: Vec<String> = (-20..20).map(point).map(|row| row[1..].to_owned()).collect();
        format!("{space},defined\n{}\n0,0,0,0\n", points.join("\n"))
    };
    let mut told = |text: &str, unit: Option<Unit>| {
        let asked = Statement { space: None, unit };
        let opened = study.open_centerlines(text.as_bytes(), "line.csv", asked).expect("a line");
        let points = study.content.tree().expect("a tree").tree().vessels()[0].points().to_vec();
        (opened, points[0].distance(points[points.len() - 1]))
    };
    let stated = "l (mm),p (mm),s (mm)";
    for (unit, name) in [(Unit::Centimetre, "cm"), (Unit::Metre, "m")] {
        let (opened, length) = told(&line(unit.in_mm(), stated), None);
        assert!((length - 39.0 / unit.in_mm()).abs() < 1e-9, "what a file states is read");
        let doubt = opened.doubt.expect("a doubt");
        assert!(doubt.readings.contains(&format!("lps in {name}")), "{doubt:?}");
        assert!(
            opened.notes.contains(&doubt.found) && doubt.found.contains(&format!("39 mm across in {name}"))
        );
        assert!(opened.notes.contains(&"1 undefined point(s) were left out".to_owned()));
        let (opened, length) = told(&line(unit.in_mm(), stated), Some(unit));
        assert!((length - 39.0).abs() < 1e-9 && opened.doubt.is_none(), "{opened:?}");
    }
    assert_eq!(told(&line(1.0, stated), None).0.doubt, None);
    let failure = study.open_centerlines(line(10.0, "x,y,z").as_bytes(), "line.csv", Statement::default());
    let mends = failure.expect_err("a unit that is open").more.mends;
    assert_eq!((mends.len(), mends[0].name()), (1, "reading"));
    assert!(["lps in cm", "ras in cm"].iter().all(|one| mends[0].values().contains(one)));
}

#[test]
fn a_scan_of_no_size_of_a_body_is_doubted() {
    let mut study = Study::default();
    let header = |mm: f64| {
        let rows = [[mm, 0.0, 0.0, 0.0], [0.0, mm, 0.0, 0.0], [0.0, 0.0, mm, 0.0], [0.0, 0.0, 0.0, 1.0]];
        json!({"size": [4, 4, 20], "dtype": "uint8", "world_from_index": rows}).to_string()
    };
    study.begin_volume(&header(1.0)).expect("room");
    study.voxel_bytes(0, 1).expect("room")[0] = 9;
    assert!(report_of(&study)["volume"]["notes"] == serde_json::json!([]));
    study.begin_volume(&header(1000.0)).expect("room");
    study.voxel_bytes(0, 1).expect("room")[0] = 9;
    let doubt = report_of(&study)["volume"]["notes"][0].as_str().expect("a doubt").to_owned();
    assert!(doubt.starts_with("the scan is 20000 mm long"), "{doubt}");
}
