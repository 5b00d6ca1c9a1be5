//! Tests that points are sorted if their order is unambiguous, and rejected otherwise.

use super::*;

fn wavy(count: usize) -> Vec<DVec3> {
    (0..count)
        .map(|n| n as f64)
        .map(|t| DVec3::new(8.0 * (t / 20.0).sin(), 4.0 * (t / 25.0).cos(), t))
        .collect()
}

fn line(points: Vec<DVec3>) -> Line {
    Line { radius: Some(points.iter().map(|p| 1.0 + p.z / 100.0).collect()), points, ..Line::default() }
}

fn of(lines: Vec<Line>) -> Centerlines {
    Centerlines { lines, ..Centerlines::default() }
}

fn dealt(points: &[DVec3]) -> Vec<DVec3> {
    (0..7).flat_map(|first| points.iter().skip(first).step_by(7)).copied().collect()
}

#[test]
fn points_and_radii_get_their_order() {
    let whole = wavy(70);
    let mut last = whole.clone();
    last.rotate_left(1);
    let mut backwards = whole.clone();
    backwards.reverse();
    backwards.rotate_left(3);
    for (given, moved) in [(last, "1 of 70"), (dealt(&whole), "of 70"), (backwards, "3 of 70")] {
        let is_backwards = given[0].z > given[40].z && moved.starts_with('3');
        let found = in_order(of(vec![line(given)])).expect("an order");
        let mut points = found.lines[0].points.clone();
        if is_backwards {
            points.reverse();
        }
        assert_eq!(points, whole, "the direction is that of most points");
        assert_eq!(found.lines[0], line(found.lines[0].points.clone()), "radii keep to their points");
        assert!(found.notes[0].contains(moved), "{:?}", found.notes);
    }
}

#[test]
fn a_line_in_order_stays_and_nothing_is_noted() {
    let turn = |n: i32| f64::from(n) * 0.6;
    let tight = (0..400).map(|n| DVec3::new(5.0 * turn(n).cos(), 5.0 * turn(n).sin(), 0.24 * turn(n)));
    for points in [wavy(70), wavy(2), tight.collect()] {
        let given = of(vec![line(points)]);
        assert_eq!(in_order(given.clone()).expect("a line"), given);
    }
}

#[test]
fn an_order_in_doubt_is_refused_with_its_reason() {
    let mut stray = dealt(&wavy(70));
    stray[9] = DVec3::splat(500.0);
    let error = in_order(of(vec![line(stray)])).expect_err("a stray point").to_string();
    assert!(error.contains("point 9 at (500, 500, 500) lies far"), "{error}");
    assert!(error.contains("remove what does not belong to the vessel"), "{error}");
    let turn = |n: usize| n as f64 * std::f64::consts::TAU / 70.0;
    let mut ring: Vec<DVec3> = (0..70).map(|n| 9.0 * DVec3::new(turn(n).cos(), turn(n).sin(), 0.0)).collect();
    ring.sort_by(|a, b| a.x.total_cmp(&b.x));
    let error = in_order(of(vec![line(wavy(70)), line(ring)])).expect_err("a ring").to_string();
    assert!(error.contains("points of line 1: found no unambiguous order"), "{error}");
}

#[test]
fn a_list_that_was_parted_becomes_one_line_where_it_is_one() {
    let mut points = wavy(70);
    points.rotate_left(2);
    let rows = |points: &[DVec3]| -> String {
        std::iter::once("x,y,z\n".to_owned())
            .chain(points.iter().map(|p| format!("{},{},{}\n", p.x, p.y, p.z)))
            .collect()
    };
    let read = lumencut_io::read(rows(&points).as_bytes(), "line.csv").expect("lines");
    assert_eq!(read.lines.len(), 2, "parted at its long step");
    assert!(parted_doubt(&read).is_some_and(|doubt| doubt.mend.is_some()));
    let found = in_order(read).expect("a line");
    assert_eq!(found.lines.len(), 1);
    assert_eq!(found.lines[0].points, wavy(70));
    let far = wavy(70).into_iter().map(|p| p + DVec3::X * 300.0);
    let two: Vec<DVec3> = wavy(70).into_iter().chain(far).collect();
    let read = lumencut_io::read(rows(&two).as_bytes(), "lines.csv").expect("lines");
    assert_eq!(parted_doubt(&read), None, "two vessels");
    assert_eq!(in_order(read).expect("lines").lines.len(), 2);
}
