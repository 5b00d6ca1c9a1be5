//! Closed forms of the three modes: where their pixels lie, and which of them are folded.

use std::f64::consts::{FRAC_PI_2, PI};

use super::*;
use crate::stop::NEVER;
use crate::vessel_tree::Vessel;

const FRONT: View = View { up: DVec3::Z, angle: 0.0, normal: None };
const MODES: [CprMode; 3] = [CprMode::Projected, CprMode::Stretched, CprMode::Straightened];

fn seen(points: &[DVec3], mode: CprMode, view: View, [width, side]: [f64; 2]) -> Cpr {
    let vessel = Vessel::new(points.to_vec(), None).unwrap();
    Cpr::new(CenterlinePath::new(&vessel, 0.0).unwrap(), mode, view, Some(width), side).unwrap()
}

fn line(points: &[[f64; 3]]) -> Vec<DVec3> {
    points.iter().map(|point| DVec3::from_array(*point)).collect()
}

fn curve(count: i32, end: f64, place: impl Fn(f64) -> [f64; 3]) -> Vec<DVec3> {
    (0..count).map(|n| DVec3::from_array(place(f64::from(n) / f64::from(count - 1) * end))).collect()
}

/// A smooth vessel that winds downwards through all directions.
fn wave(count: i32) -> Vec<DVec3> {
    curve(count, 1.0, |t| {
        [9.0 * (5.0 * t).sin(), 7.0 * (4.0 * t).cos(), 22.0 - 44.0 * t + 2.0 * (9.0 * t).sin()]
    })
}

/// The point at an arc length, by walking along the line.
fn along(points: &[DVec3], mut at: f64) -> DVec3 {
    for ends in points.windows(2) {
        let length = ends[0].distance(ends[1]);
        if at <= length {
            return ends[0].lerp(ends[1], at / length);
        }
        at -= length;
    }
    points[points.len() - 1]
}

/// The positions of the image by row.
fn rows(made: &Cpr) -> Vec<Vec<DVec3>> {
    let curved = made.curved(NEVER).unwrap();
    curved.position().chunks(made.size()[0]).map(<[DVec3]>::to_vec).collect()
}

fn folded(made: &Cpr) -> Vec<Vec<bool>> {
    made.folded(NEVER).unwrap().chunks(made.size()[0]).map(<[bool]>::to_vec).collect()
}

/// The whole first row from its left to its right end.
fn across(made: &Cpr) -> DVec3 {
    let first = &rows(made)[0];
    first[first.len() - 1] - first[0]
}

fn assert_at(found: DVec3, expected: [f64; 3]) {
    assert!(found.distance(DVec3::from_array(expected)) < 1e-9, "{found} instead of {expected:?}");
}

#[test]
fn a_vessel_that_rises_is_seen_upside_down_and_not_mirrored() {
    for mode in [CprMode::Stretched, CprMode::Straightened] {
        let rising = rows(&seen(&line(&[[0., 0., -10.], [0., 0., 10.]]), mode, FRONT, [10.0, 1.0]));
        let falling = rows(&seen(&line(&[[0., 0., 10.], [0., 0., -10.]]), mode, FRONT, [10.0, 1.0]));
        for (up, down) in rising.iter().flatten().zip(falling.iter().flatten().rev()) {
            assert!(up.distance(*down) < 1e-12, "{mode:?}");
        }
        let (right, down) = (rising[0][1] - rising[0][0], rising[1][0] - rising[0][0]);
        assert_at(right.cross(down), [0.0, 1.0, 0.0]);
    }
    let projected = seen(&line(&[[0., 0., -10.], [0., 0., 10.]]), CprMode::Projected, FRONT, [10.0, 1.0]);
    assert_at(rows(&projected)[0][5], [0.0, 0.0, 10.0]);
    let arc_length = projected.arc_length(NEVER).unwrap();
    assert!(arc_length.iter().enumerate().all(|(j, at)| (at - (20.0 - j as f64)).abs() < 1e-12));
}

#[test]
fn the_vessel_lies_where_its_row_says() {
    for mode in MODES {
        let made = seen(&wave(160), mode, FRONT, [60.0, 0.5]);
        let (folded, middle) = (folded(&made), (made.size()[0] - 1) / 2);
        for (j, at) in made.arc_length(NEVER).unwrap().into_iter().enumerate() {
            if mode == CprMode::Projected && folded[j][middle] {
                continue;
            }
            let point = along(&wave(160), at);
            let pixel = made.pixel_from_world(point);
            assert!((pixel.y - j as f64).abs() < 1e-6, "{mode:?}, row {j}: {pixel}");
            assert!(made.world_from_pixel(pixel).distance(point) < 1e-9);
            assert!(mode != CprMode::Straightened || (pixel.x - middle as f64).abs() < 1e-9);
        }
    }
}

#[test]
fn beyond_the_image_a_vessel_goes_on_straight() {
    for mode in MODES {
        let made = seen(&line(&[[0., 0., 20.], [0., 0., -20.]]), mode, FRONT, [40.0, 1.0]);
        let pixel = |point: [f64; 3]| made.pixel_from_world(DVec3::from_array(point));
        assert!(pixel([7., 11., 5.]).distance(DVec2::new(27.0, 15.0)) < 1e-9, "{mode:?}");
        assert!(pixel([7., 0., 25.]).distance(DVec2::new(27.0, -5.0)) < 1e-9, "{mode:?}");
        assert_at(made.world_from_pixel(DVec2::new(27.0, 43.0)), [7.0, 0.0, -23.0]);
    }
}

#[test]
fn rows_that_several_points_share_show_the_nearest_and_are_folded() {
    // Down, then up again, farther away; the lowest row contains only the turning point.
    let points = line(&[[-10., 0., 10.], [-10., 0., -10.], [10., 6., 10.]]);
    let made = seen(&points, CprMode::Projected, FRONT, [40.0, 1.0]);
    let (folded, rows) = (folded(&made), rows(&made));
    let last = folded.len() - 1;
    assert!(folded[..last].iter().flatten().all(|pixel| *pixel) && !folded[last].contains(&true));
    // At height 0 the vessel is at x = -10, y = 0 and at x = 0, y = 3.
    for (i, place) in rows[10].iter().enumerate() {
        let x = i as f64 - 20.0;
        assert_at(*place, [x, if x > -5.0 { 3.0 } else { 0.0 }, 0.0]);
    }
    assert!((made.arc_length(NEVER).unwrap()[10] - 10.0).abs() < 1e-9);
}

#[test]
fn a_level_stretch_is_shown_in_its_row() {
    let points = line(&[[0., 0., 5.], [0., 0., 0.], [8., 4., 0.], [8., 4., -5.]]);
    let made = seen(&points, CprMode::Projected, FRONT, [30.0, 1.0]);
    for (j, row) in folded(&made).iter().enumerate() {
        assert_eq!(row.contains(&true), j == 5, "row {j}");
    }
    for place in &rows(&made)[5] {
        assert!((place.y - place.x.clamp(0.0, 8.0) / 2.0).abs() < 1e-12);
    }
}

#[test]
fn lengths_on_a_stretched_surface_are_true() {
    let rows = rows(&seen(&wave(400), CprMode::Stretched, FRONT, [40.0, 0.5]));
    for two in rows.windows(2) {
        for (above, below) in two[0].windows(2).zip(two[1].windows(2)) {
            assert!((above[0].distance(above[1]) - 0.5).abs() < 1e-9);
            // Chords of a curved surface are slightly shorter than the path along the surface.
            let down = above[0].distance(below[0]);
            assert!(down <= 0.5 + 1e-9 && down > 0.5 * 0.999, "{down}");
            assert!((above[0].distance(below[1]) / 0.5f64.sqrt() - 1.0).abs() < 1e-3);
        }
    }
}

#[test]
fn a_stretched_helix_has_its_closed_form() {
    let (radius, rise) = (12.0, 3.0);
    let points = curve(1500, PI, |a| [radius * a.cos(), radius * a.sin(), -rise * a]);
    let made = seen(&points, CprMode::Stretched, FRONT, [60.0, 0.5]);
    // Seen along x, a step is (dy, dz); its length is an elliptic integral, summed here in small steps.
    let (steps, mut down, mut j) = (200_000, 0.0, 0);
    let arc_length = made.arc_length(NEVER).unwrap();
    for n in 0..steps {
        let step = PI / f64::from(steps);
        let a = (f64::from(n) + 0.5) * step;
        if down >= 0.5 * j as f64 && j < arc_length.len() {
            let expected = f64::hypot(radius, rise) * (a - step / 2.0);
            assert!((arc_length[j] - expected).abs() < 1e-3, "row {j}: {} mm", arc_length[j]);
            let place = made.pixel_from_world(along(&points, arc_length[j]));
            assert!((place.y - j as f64).abs() < 2e-3);
            assert!(((place.x - 60.0) * 0.5 - radius * (a - step / 2.0).cos()).abs() < 1e-3);
            j += 1;
        }
        down += f64::hypot(radius * a.cos(), rise) * step;
    }
    assert_eq!([j, made.size()[1]], [(down / 0.5) as usize + 1; 2]);
}

#[test]
fn a_planar_arc_is_stretched_to_its_length() {
    // From the front a half circle in the sagittal plane has no width, but a length of π R.
    let points = curve(2000, PI, |a| [0.0, 15.0 * a.sin(), 15.0 * a.cos()]);
    let made = seen(&points, CprMode::Stretched, FRONT, [50.0, 0.5]);
    assert_eq!(made.size(), [101, (PI * 15.0 / 0.5) as usize + 1]);
    let arc_length = made.arc_length(NEVER).unwrap();
    assert!(arc_length.iter().enumerate().all(|(j, at)| (at - 0.5 * j as f64).abs() < 1e-4));
}

#[test]
fn a_stretched_vessel_that_returns_is_folded_where_it_was_shown_before() {
    // Down and up again in one coronal plane: every line of the second half repeats one of the first.
    let points = line(&[[-8., 0., 10.], [-8., 0., -10.], [8., 0., -10.], [8., 0., 10.]]);
    let made = seen(&points, CprMode::Stretched, FRONT, [32.0, 1.0]);
    assert_eq!(made.size()[1], 41);
    let folded = folded(&made);
    for j in [3, 12, 17] {
        for i in 0..33 {
            assert_eq!(folded[j][i], i > 16, "row {j}, column {i}");
            // In the middle both limbs are equally near: the upper row gets the point.
            assert_eq!(folded[40 - j][i], i <= 16, "row {}, column {i}", 40 - j);
        }
    }
}

#[test]
fn limbs_of_a_v_are_parted_in_the_middle_between_them() {
    let points = line(&[[-8., 0., 10.], [-2., 0., -10.], [2., 0., -10.], [8., 0., 10.]]);
    let folded = folded(&seen(&points, CprMode::Stretched, FRONT, [32.0, 1.0]));
    for j in [3, 12, 17] {
        assert!((0..33).all(|i| folded[j][i] == (i > 16) && folded[40 - j][i] == (i <= 16)), "row {j}");
    }
}

#[test]
fn by_default_25_mm_beside_the_vessel_are_shown() {
    let vessel = Vessel::new(line(&[[4., 0., 20.], [34., 0., 0.]]), None).unwrap();
    for mode in [CprMode::Projected, CprMode::Stretched] {
        let path = CenterlinePath::new(&vessel, 0.0).unwrap();
        assert_eq!(Cpr::new(path, mode, FRONT, None, 0.5).unwrap().size(), [161, 41], "{mode:?}");
    }
}

#[test]
fn sections_of_a_helix_are_perpendicular_and_do_not_turn() {
    let (radius, rise) = (12.0, 3.0);
    let (step, turns) = (f64::hypot(radius, rise), 3.0 * PI);
    let points = curve(1500, turns, |a| [radius * a.cos(), radius * a.sin(), -rise * a]);
    let made = seen(&points, CprMode::Straightened, FRONT, [8.0, 0.25]);
    let arc_length = made.arc_length(NEVER).unwrap();
    assert!((arc_length[arc_length.len() - 1] - step * turns).abs() < 0.25);
    let mut first = None;
    for (row, at) in rows(&made).iter().zip(arc_length) {
        let across = (row[row.len() - 1] - row[0]).normalize();
        let (sine, cosine) = (at / step).sin_cos();
        let tangent = DVec3::new(-radius * sine, radius * cosine, -rise) / step;
        let normal = DVec3::new(-cosine, -sine, 0.0);
        assert!(across.dot(tangent).abs() < 5e-3);
        // Relative to the Frenet frame, the frame without rotation turns by the integral of the torsion.
        let turned = across.dot(tangent.cross(normal)).atan2(across.dot(normal));
        let expected = *first.get_or_insert(turned) + rise / (step * step) * at;
        let away = (turned - expected + PI).rem_euclid(2.0 * PI) - PI;
        assert!(away.abs() < 2e-3, "{away} at {at} mm");
    }
}

#[test]
fn the_first_section_is_seen_from_the_front_and_turns_to_the_right() {
    let first = |points: &[[f64; 3]], mode, view| across(&seen(&line(points), mode, view, [10.0, 1.0]));
    let down = [[0., 0., 10.], [0., 0., -10.]];
    let oblique = first(&[[0., 0., 10.], [1., -3., -10.]], CprMode::Straightened, FRONT);
    assert!(oblique.x > 9.9 && oblique.y.abs() < 0.2);
    // A vessel that starts along the view direction is seen from below, like axial slices.
    let level = first(&[[0., -10., 0.], [0., 10., 0.]], CprMode::Straightened, FRONT);
    assert_at(level, [10.0, 0.0, 0.0]);
    let normal = View { normal: Some(DVec3::new(5.0, 0.0, 1.0)), ..FRONT };
    assert_at(first(&down, CprMode::Straightened, normal), [0.0, 10.0, 0.0]);
    for mode in MODES {
        assert_at(first(&down, mode, View { angle: FRAC_PI_2, ..FRONT }), [0.0, 10.0, 0.0]);
    }
}

#[test]
fn cross_lines_beyond_the_centre_of_curvature_are_folded() {
    // Half of a circle of 10 mm in the coronal plane, with its centre on the right in the picture.
    let points = curve(800, PI, |a| [-10.0 * a.sin(), 0.0, 10.0 * a.cos()]);
    let made = seen(&points, CprMode::Straightened, FRONT, [40.0, 0.5]);
    let (rows, folded) = (rows(&made), folded(&made));
    let side = (rows[40][80] - rows[40][0]).x.signum();
    for (i, x) in (0..81).map(|i| (i, (f64::from(i) - 40.0) * 0.5 * side)) {
        for row in &folded[8..folded.len() - 8] {
            assert!((x.abs() - 10.0).abs() < 0.1 || row[i as usize] == (x > 10.0), "column {i}");
        }
    }
}

#[test]
fn limbs_that_cross_lines_reach_are_folded_there() {
    // A hairpin in the coronal plane, 16 mm wide: its symmetry axis separates the pixels of both limbs.
    let bend = curve(200, PI, |a| [-8.0 * a.cos(), 0.0, -10.0 - 8.0 * a.sin()]);
    let points = [line(&[[-8., 0., 20.]]), bend, line(&[[8., 0., 20.]])].concat();
    let made = seen(&points, CprMode::Straightened, FRONT, [30.0, 0.5]);
    let [width, height] = made.size();
    for (i, folded) in folded(&made)[20].iter().enumerate() {
        let x = (i as f64 - (width / 2) as f64) * 0.5;
        assert_eq!(*folded, x > 8.0, "{x} mm beside the limb");
        if x > 8.1 {
            let back = made.pixel_from_world(made.world_from_pixel(DVec2::new(i as f64, 20.0)));
            assert!(back.y > height as f64 / 2.0, "shown by the other limb");
        }
    }
}

#[test]
fn right_angles_inflections_and_straight_runs_leave_no_jump() {
    let points = line(&[
        [0., 0., 30.],
        [0., 0., 10.],
        [20., 0., 10.],
        [20., 15., 10.],
        [20., 15., -10.],
        [22., 15., -15.],
        [20., 15., -20.],
    ]);
    let made = seen(&points, CprMode::Straightened, FRONT, [6.0, 0.25]);
    let across: Vec<DVec3> = rows(&made).iter().map(|row| row[row.len() - 1] - row[0]).collect();
    assert!(across.iter().all(|way| (way.length() - 6.0).abs() < 1e-9));
    for (at, direction) in [(10.0, DVec3::Z), (30.0, DVec3::X), (47.5, DVec3::Y), (65.0, DVec3::Z)] {
        assert!(across[(at / 0.25) as usize].dot(direction).abs() < 1e-9, "at {at} mm");
    }
    assert!(across.windows(2).all(|two| two[0].distance(two[1]) < 0.6));
    assert!(folded(&made).iter().all(|row| !row[made.size()[0] / 2]));
}

#[test]
fn vessels_on_a_lattice_that_turn_back_have_a_layout() {
    // Steps of 3 mm along the axes, chosen by a digit: many repeat a way or run along the view.
    for seed in 1..9u64 {
        let mut points = vec![DVec3::new(0.0, 0.0, 9.0)];
        for n in 0..12 {
            let axis = [DVec3::X, DVec3::Y, DVec3::NEG_Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z];
            let step = axis[(seed * 7919 / 5u64.pow(n % 7) + u64::from(n)) as usize % 6] * 3.0;
            points.push(points[points.len() - 1] + step);
        }
        points.push(points[points.len() - 1] - DVec3::Z * 2.0);
        for mode in MODES {
            let made = seen(&points, mode, FRONT, [12.0, 0.7]);
            let (rows, folded) = (rows(&made), folded(&made));
            for (j, i) in (0..rows.len()).flat_map(|j| (0..rows[j].len()).map(move |i| (j, i))) {
                assert!(rows[j][i].is_finite());
                let pixel = DVec2::new(i as f64, j as f64);
                let back = made.pixel_from_world(rows[j][i]);
                assert!(folded[j][i] || back.distance(pixel) < 1e-5, "{mode:?} {seed}: {pixel} {back}");
            }
        }
    }
}
