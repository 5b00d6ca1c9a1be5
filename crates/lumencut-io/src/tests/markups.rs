//! Markups of 3D Slicer: what is looked up in them, and what is passed over.

use glam::DVec3;

use crate::{Centerlines, Unit, read};

fn ok(markups: &str) -> Centerlines {
    read(markups.as_bytes(), "a.mrk.json").unwrap_or_else(|error| panic!("{error}"))
}

fn message(markups: &str) -> String {
    read(markups.as_bytes(), "a.mrk.json").unwrap_err().to_string()
}

/// A file of one curve with these fields more.
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
