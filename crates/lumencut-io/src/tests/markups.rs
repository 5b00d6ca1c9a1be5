//! Tests of 3D Slicer markups.

use glam::DVec3;

use crate::{Centerlines, Unit, read};

fn ok(markups: &str) -> Centerlines {
    read(markups.as_bytes(), "a.mrk.json").unwrap_or_else(|error| panic!("{error}"))
}

fn message(markups: &str) -> String {
    read(markups.as_bytes(), "a.mrk.json").unwrap_err().to_string()
}

fn curve(fields: &str) -> String {
    let points = r#"{"position": [1, 2, 3]}, {"position": [1e0, -0.0, 18446744073709551615e-19]}"#;
    format!(r#"{{"markups": [{{"type": "Curve", "controlPoints": [{points}]{fields}}}]}}"#)
}

#[test]
fn fields_of_other_kinds_are_passed_over() {
    let plain = ok(&curve(""));
    assert_eq!(
        plain.lines[0].points,
        [DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 0.0, 1.844_674_407_370_955_2)]
    );
    let deep = format!(r#", "display": {{"a": {}{}}}"#, "[".repeat(1000), "]".repeat(1000));
    for fields in [
        r#", "name": null, "coordinateSystem": null, "coordinateUnits": null, "measurements": null"#,
        r#", "name": 7, "measurements": {"name": "Radius"}, "description": "\u00e9 \" ]}""#,
        r#", "measurements": [null, 5, [], {"name": "length"}, {"name": "Radius"}]"#,
        &deep,
    ] {
        assert_eq!(ok(&curve(fields)), plain, "{fields}");
    }
    assert_eq!(
        ok(&curve(r#", "name": "a", "n\u0061me": "b\n\u00e9""#)).lines[0].name.as_deref(),
        Some("b\n\u{e9}")
    );
    assert_eq!(ok(&curve(r#", "coordinateUnits": ["cm", "cm",  "cm"]"#)).unit, Some(Unit::Centimetre));
    assert_eq!(
        ok(&curve(r#", "coordinateUnits": "cm", "coordinateSystem": 1"#)).unit,
        Some(Unit::Centimetre)
    );
}

#[test]
fn what_is_wrong_is_named() {
    for (fields, expected) in [
        (
            r#", "coordinateUnits": ["mm", "cm", "mm"]"#,
            r#"coordinateUnits: found '[\"mm\", \"cm\", \"mm\"]'"#,
        ),
        (r#", "coordinateUnits": []"#, "coordinateUnits: found '[]'"),
        (
            r#", "controlPoints": [{"position": [1, 2]}]"#,
            "position of control point 0: found '[1, 2]'; expected 3 numbers",
        ),
        (
            r#", "controlPoints": [{}, {"position": [1, 2, 1e999]}]"#,
            "position of control point 1: found '[1, 2, 1e999]'",
        ),
        (
            r#", "measurements": [{"name": "radius", "controlPointValues": [1, "a"]}]"#,
            r#"found '\"a\"' at point 1"#,
        ),
        (
            r#", "measurements": [{"name": "radius", "controlPointValues": [1]}]"#,
            "1 values for 2 control points",
        ),
    ] {
        let message = message(&curve(fields));
        assert!(message.starts_with("a.mrk.json: markup 0: ") && message.contains(expected), "{message}");
    }
    for damaged in [
        r#"{"markups": [], "a": 01}"#,
        r#"{"markups": []"#,
        r#"{"markups": []} 1"#,
        "{\"markups\": [\"\n\"]}",
    ] {
        assert!(message(damaged).contains("damaged JSON"), "{damaged}");
    }
    let many = format!(r#"{{"markups": [{}3]}}"#, r#"{"type": "Plane"}, "#.repeat(20));
    assert!(message(&many).contains("'Plane', 'Plane' and 13 more; expected a markup of type Curve"));
}

#[test]
fn corners_of_curves_are_noted_where_3d_slicer_shows_none() {
    let of = |kind: &str, y: f64| {
        let points =
            format!(r#"{{"position": [0, 0, 0]}}, {{"position": [9, 0, 0]}}, {{"position": [18, {y}, 0]}}"#);
        let notes =
            ok(&format!(r#"{{"markups": [{{"type": "{kind}", "controlPoints": [{points}]}}]}}"#)).notes;
        notes.iter().any(|note| note.contains("joined by straight lines"))
    };
    assert!(of("Curve", 9.0) && of("ClosedCurve", -9.0) && of("ClosedCurve", 3.0));
    assert!(!of("Curve", 3.0) && !of("Line", 9.0));
}

#[test]
fn an_empty_unit_of_a_radius_is_that_of_its_curve() {
    let of = |units: &str| {
        let radius = format!(r#"{{"name": "Radius", {units} "controlPointValues": [0.25, 0.5]}}"#);
        ok(&curve(&format!(r#", "coordinateUnits": "cm", "measurements": [{radius}]"#))).lines[0]
            .radius
            .clone()
    };
    for (units, first) in [("", 0.25), (r#""units": "","#, 0.25), (r#""units": "mm","#, 0.025)] {
        assert_eq!(of(units).unwrap()[0], first, "{units}");
    }
    assert_eq!(of(r#""units": ["mm", "UCUM", "millimeter"],"#).unwrap()[1], 0.05);
}

fn with_statuses(statuses: &[&str]) -> String {
    let point =
        |(i, status): (usize, &&str)| format!(r#"{{"position": [{i}, 0, 0], "positionStatus": {status}}}"#);
    let points: Vec<String> = statuses.iter().enumerate().map(point).collect();
    format!(r#"{{"markups": [{{"type": "Curve", "controlPoints": [{}]}}]}}"#, points.join(","))
}

#[test]
fn the_status_of_a_point_means_what_it_says() {
    let read = ok(&with_statuses(&[
        r#""defined""#,
        r#""undefined""#,
        r#""preview""#,
        r#""missing""#,
        r#""Defined""#,
    ]));
    assert_eq!(read.lines[0].points.iter().map(|p| p.x).collect::<Vec<_>>(), [0.0, 4.0]);
    assert!(
        read.notes.contains(&"3 control point(s) without a position were left out".into()),
        "{:?}",
        read.notes
    );
    assert_eq!(ok(&with_statuses(&["2", "0", "null", "3", "1"])).lines[0].points.len(), 2, "by numbers");
    let none = message(&with_statuses(&[r#""undefined""#, r#""preview""#]));
    assert!(none.contains("2 control point(s) without a position; expected at least 2 with one"), "{none}");
    let unknown = message(&with_statuses(&[r#""defined""#, r#""placed""#, r#""defined""#]));
    assert!(unknown.contains("positionStatus of control point 1: found 'placed'"), "{unknown}");
}

#[test]
fn a_radius_that_is_null_is_unknown() {
    let radius = r#", "measurements": [{"name": "Radius", "controlPointValues": [null, 1.5]}]"#;
    let read = ok(&curve(radius));
    assert_eq!(read.lines[0].radius.as_deref(), Some(&[0.0, 1.5][..]));
    assert!(read.notes.contains(&"1 of 2 radii are missing".into()), "{:?}", read.notes);
}
