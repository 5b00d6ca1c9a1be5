use serde_json::Value;

use super::*;

/// Drags with their ends, which the tests of the page and of the notebook read too.
fn cases(kind: &str) -> Vec<Value> {
    let all: Value = serde_json::from_str(include_str!("../../../../tests/drags.json")).unwrap();
    all[kind].as_array().unwrap().clone()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let listed: Vec<f64> = value.as_array().unwrap().iter().map(|part| part.as_f64().unwrap()).collect();
    listed.try_into().unwrap()
}

fn vector(value: &Value) -> DVec3 {
    DVec3::from_array(numbers(value))
}

fn camera(value: &Value) -> Camera {
    let [center, direction, up] = ["center", "direction", "up"].map(|name| vector(&value[name]));
    let size = numbers::<2>(&value["size"]).map(|count| count as usize);
    Camera::new(center, direction, up, size, value["pixel_spacing"].as_f64().unwrap()).unwrap()
}

fn stepped(camera: &Camera, step: &Value) -> Camera {
    let made = match step[0].as_str().unwrap() {
        "rotate" => trackballed(camera, vector(&step[1]), numbers(&step[2])),
        "spin" => spun(camera, vector(&step[1]), vector(&step[2]), step[3].as_f64().unwrap()),
        "pan" => dragged(camera, numbers(&step[1])),
        "zoom" => zoomed_at(camera, step[1].as_f64().unwrap(), numbers(&step[2])),
        name => panic!("{name}"),
    };
    made.unwrap()
}

fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} is not {expected}");
}

#[test]
fn drags_end_where_they_end_in_all_hosts() {
    for case in cases("drags") {
        let steps = case["steps"].as_array().unwrap();
        let found = steps.iter().fold(camera(&case["start"]), |camera, step| stepped(&camera, step));
        let end = camera(&case["end"]);
        assert_eq!(found.size(), end.size());
        assert_near(found.pixel_spacing(), end.pixel_spacing());
        let pairs =
            [(found.center(), end.center()), (found.direction(), end.direction()), (found.up(), end.up())];
        for axis in 0..3 {
            pairs.iter().for_each(|(found, expected)| assert_near(found[axis], expected[axis]));
        }
    }
}

#[test]
fn a_drag_changes_the_window_as_in_all_hosts() {
    for case in cases("windows") {
        let found = dragged_window(numbers(&case["window"]), numbers(&case["drag"]));
        let end: [f64; 2] = numbers(&case["end"]);
        (0..2).for_each(|n| assert_near(found[n], end[n]));
    }
}

#[test]
fn a_share_of_the_pixels_is_as_large_in_all_hosts() {
    for case in cases("samples") {
        let size = numbers::<2>(&case["size"]).map(|count| count as usize);
        let start = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, size, 0.5).unwrap();
        let found = sampled(&start, case["share"].as_f64().unwrap()).unwrap();
        assert_eq!(found.size().map(|count| count as f64), numbers(&case["end"]));
        assert_near(found.pixel_spacing(), case["pixel_spacing"].as_f64().unwrap());
    }
}

#[test]
fn names_of_gestures_are_unique_and_values_positive() {
    for (n, row) in GESTURES.iter().enumerate() {
        assert!(row.value > 0.0 && !row.about.is_empty(), "{row:?}");
        assert!(GESTURES[..n].iter().all(|other| other.name != row.name), "{row:?}");
    }
}

#[test]
fn a_zoom_by_no_positive_number_is_refused() {
    let start = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [4, 4], 1.0).unwrap();
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(zoomed_at(&start, factor, [0.0, 0.0]).unwrap_err().kind, ErrorKind::Camera);
    }
}
