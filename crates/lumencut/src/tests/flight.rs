use glam::DVec3;

use super::*;

fn camera(center: [f64; 3], direction: [f64; 3], spacing: f64) -> Camera {
    let [center, direction] = [center, direction].map(DVec3::from_array);
    Camera::new(center, direction, DVec3::Z, [200, 100], spacing).unwrap()
}

fn ends() -> [Camera; 2] {
    [camera([0.0, 0.0, 0.0], [0.0, 1.0, 0.0], 2.0), camera([30.0, -12.0, 40.0], [1.0, -0.4, 0.7], 0.25)]
}

fn turn(from: &Camera, to: &Camera) -> f64 {
    orientation(from).angle_between(orientation(to))
}

#[test]
fn it_begins_and_ends_with_the_cameras_themselves() {
    let [from, to] = ends();
    for frames in [2, 3, 37] {
        let views = flight(&from, &to, frames).unwrap();
        assert_eq!((views.len(), views[0], views[frames - 1]), (frames, from, to));
    }
    let views = flight(&from, &from, 5).unwrap();
    for view in views {
        assert!(view.center().abs_diff_eq(from.center(), 1e-12));
        assert!(view.direction().abs_diff_eq(from.direction(), 1e-12));
        assert!((view.pixel_spacing() - from.pixel_spacing()).abs() < 1e-12);
    }
}

#[test]
fn turn_and_zoom_go_evenly_with_the_way_by_the_shortest_rotation() {
    let [from, to] = ends();
    let views = flight(&from, &to, 41).unwrap();
    let all = turn(&from, &to);
    assert!(all < std::f64::consts::PI);
    for (n, view) in views.iter().enumerate() {
        let time = n as f64 / 40.0;
        let way = time * time * (3.0 - 2.0 * time);
        assert!((turn(&from, view) - way * all).abs() < 1e-7, "frame {n}");
        assert!((turn(view, &to) - (1.0 - way) * all).abs() < 1e-7, "frame {n}");
        let zoom = (view.pixel_spacing() / from.pixel_spacing()).ln();
        assert!((zoom - way * (0.125f64).ln()).abs() < 1e-9, "frame {n}");
        assert!(view.up().dot(view.direction()).abs() < 1e-12);
    }
    // The flight is slow at both ends and fastest in the middle.
    let step = |n: usize| turn(&views[n], &views[n + 1]);
    assert!(step(0) < 0.1 * step(20) && step(39) < 0.1 * step(20));
}

#[test]
fn half_a_turn_is_flown_too() {
    let (from, to) = (camera([0.0; 3], [0.0, 1.0, 0.0], 1.0), camera([0.0; 3], [0.0, -1.0, 0.0], 1.0));
    let views = flight(&from, &to, 11).unwrap();
    let total: f64 = views.windows(2).map(|pair| turn(&pair[0], &pair[1])).sum();
    assert!((total - std::f64::consts::PI).abs() < 1e-6);
    assert!(views.iter().all(|view| view.center().length() < 1e-12));
}

#[test]
fn what_is_in_the_middle_of_the_closer_view_goes_straight_there() {
    // Without rotation, positions in the pictures can be compared.
    let (from, to) =
        (camera([0.0; 3], [0.0, 1.0, 0.0], 2.0), camera([60.0, 3.0, -20.0], [0.0, 1.0, 0.0], 0.1));
    let views = flight(&from, &to, 21).unwrap();
    let seen = |view: &Camera| view.view_from_world(to.center()).truncate() / view.pixel_spacing();
    let first = seen(&from);
    for (n, view) in views.iter().enumerate() {
        let time = n as f64 / 20.0;
        let left = 1.0 - time * time * (3.0 - 2.0 * time);
        assert!(seen(view).abs_diff_eq(first * left, 1e-9), "frame {n}");
    }
}

#[test]
fn a_flight_back_is_the_same_from_its_end() {
    let [from, to] = ends();
    let (there, mut back) = (flight(&from, &to, 13).unwrap(), flight(&to, &from, 13).unwrap());
    back.reverse();
    for (one, other) in there.iter().zip(&back) {
        assert!(one.center().abs_diff_eq(other.center(), 1e-9));
        assert!(one.direction().abs_diff_eq(other.direction(), 1e-9));
        assert!(one.up().abs_diff_eq(other.up(), 1e-9));
        assert!((one.pixel_spacing() / other.pixel_spacing() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn other_flights_are_refused() {
    let [from, to] = ends();
    let error = flight(&from, &to, 1).unwrap_err();
    assert_eq!(error.to_string(), "frames of the flight: found 1 frame(s); expected 2 to 1000000 frames");
    for frames in [0, MOST_FRAMES + 1, usize::MAX] {
        assert_eq!(flight(&from, &to, frames).unwrap_err().subject, "frames of the flight");
    }
    let small = Camera::new(to.center(), to.direction(), to.up(), [50, 50], 1.0).unwrap();
    assert_eq!(flight(&from, &small, 5).unwrap_err().subject, "size of the flight");
}
