use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec2};

use super::*;

fn front() -> Camera {
    Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [100, 50], 1.0).unwrap()
}

fn assert_near(found: DVec3, expected: DVec3) {
    assert!(found.abs_diff_eq(expected, 1e-12), "{found} is not {expected}");
}

#[test]
fn from_the_front_the_patients_left_is_on_the_right() {
    let rights = [
        ("anterior", DVec3::X),
        ("posterior", DVec3::NEG_X),
        ("left", DVec3::Y),
        ("right", DVec3::NEG_Y),
        ("superior", DVec3::NEG_X),
        ("inferior", DVec3::X),
    ];
    for (name, right) in rights {
        let view = named(name).unwrap();
        let camera = Camera::new(DVec3::ZERO, view.direction, view.up, [4, 4], 1.0).unwrap();
        assert_eq!((view.name, camera.right(), camera.up()), (name, right, view.up));
    }
}

#[test]
fn an_unknown_view_is_named_with_all_that_are_known() {
    let error = named("front").unwrap_err();
    let expected = "one of anterior, posterior, left, right, superior, inferior";
    assert_eq!(error.to_string(), format!("name of the view: found 'front'; expected {expected}"));
}

#[test]
fn unit_vectors_that_were_kept_elsewhere_are_taken_to_the_last_bit() {
    let camera = front();
    let nudged = DVec3::new(0.0, 1f64.next_down(), 0.0);
    let kept = camera.with_axes(nudged, camera.right(), camera.up()).unwrap();
    assert_eq!(kept.direction(), nudged);
    // Cameras that are derived from this camera have axes of unit length.
    assert_eq!(zoomed(&kept, 2.0).unwrap().direction(), DVec3::Y);
    let error = camera.with_axes(nudged, camera.up(), camera.right()).unwrap_err();
    assert_eq!(error.subject, "axes of the camera");
}

#[test]
fn a_fitted_view_leaves_the_margin_free_on_the_wider_side() {
    // The points are 44 mm across and 11 mm high. They fill 88 of 100 pixels, 0.5 mm each.
    let corners = [DVec3::new(10.0, -7.0, 5.0), DVec3::new(54.0, 9.0, 16.0)];
    let fitted = fitted(&front(), &corners).unwrap();
    assert_near(fitted.center(), DVec3::new(32.0, 1.0, 10.5));
    assert!((fitted.pixel_spacing() - 0.5).abs() < 1e-12);
    assert_eq!((fitted.direction(), fitted.up(), fitted.size()), (DVec3::Y, DVec3::Z, [100, 50]));
}

#[test]
fn a_single_point_is_seen_at_the_finest_spacing() {
    let fitted = fitted(&front(), &[DVec3::new(1.0, 2.0, 3.0); 2]).unwrap();
    assert_eq!((fitted.center(), fitted.pixel_spacing()), (DVec3::new(1.0, 2.0, 3.0), 1e-3));
}

#[test]
fn nothing_cannot_be_fitted() {
    let error = fitted(&front(), &[]).unwrap_err();
    assert_eq!((error.kind, error.found.as_str()), (ErrorKind::Camera, "no points"));
}

#[test]
fn turning_is_counterclockwise_as_seen_against_the_axis() {
    assert_near(rotated(&front(), FRAC_PI_2, Axis::Up).unwrap().direction(), DVec3::NEG_X);
    assert_near(rotated(&front(), FRAC_PI_2, Axis::Superior).unwrap().direction(), DVec3::NEG_X);
    assert_near(rotated(&front(), FRAC_PI_2, Axis::Right).unwrap().direction(), DVec3::Z);
    assert_near(rotated(&front(), FRAC_PI_2, Axis::Direction).unwrap().up(), DVec3::X);
    let about = Axis::World(DVec3::new(0.0, 0.0, 1e-200));
    assert_near(rotated(&front(), FRAC_PI_2, about).unwrap().direction(), DVec3::NEG_X);
}

fn oblique() -> Camera {
    let direction = DVec3::new(0.3, 0.9, -0.2);
    Camera::new(DVec3::new(3.0, -4.0, 5.0), direction, DVec3::new(0.1, 0.0, 1.0), [60, 40], 0.7).unwrap()
}

/// Column and row of a world point.
fn pixel(camera: &Camera, point: DVec3) -> DVec2 {
    let place = camera.view_from_world(point) / camera.pixel_spacing();
    DVec2::new(place.x + 29.5, 19.5 - place.y)
}

fn assert_same(one: &Camera, other: &Camera) {
    for (a, b) in
        [(one.center(), other.center()), (one.direction(), other.direction()), (one.up(), other.up())]
    {
        assert!(a.distance(b) < 1e-9, "{a} is not {b}");
    }
    assert!((one.pixel_spacing() / other.pixel_spacing() - 1.0).abs() < 1e-12);
}

#[test]
fn turning_a_view_is_turning_the_world_the_other_way_and_can_be_undone() {
    let (view, point) = (oblique(), DVec3::new(12.0, -31.0, 8.0));
    let world = DVec3::new(0.4, 2.0, 1.3);
    for (name, axis) in [
        (Axis::Up, view.up()),
        (Axis::Right, view.right()),
        (Axis::Direction, view.direction()),
        (Axis::World(world), world.normalize()),
    ] {
        for angle in [-7.0, -1.3, 0.4, 2.9f64] {
            let turned = rotated(&view, angle, name).unwrap();
            let back = DQuat::from_axis_angle(axis, -angle) * (point - view.center()) + view.center();
            assert!(pixel(&turned, point).distance(pixel(&view, back)) < 1e-9, "{angle} about {axis}");
            // An axis of the view stays where it is.
            assert_same(&rotated(&turned, -angle, name).unwrap(), &view);
            let half = rotated(&view, angle / 2.0, name).unwrap();
            assert_same(&rotated(&half, angle / 2.0, name).unwrap(), &turned);
        }
    }
}

#[test]
fn zooming_and_panning_move_pixels_and_can_be_undone() {
    let (view, point) = (oblique(), DVec3::new(12.0, -31.0, 8.0));
    let middle = DVec2::new(29.5, 19.5);
    for factor in [0.01, 0.5, 3.0, 100.0] {
        let zoomed = zoomed(&view, factor).unwrap();
        let expected = (pixel(&view, point) - middle) * factor;
        assert!((pixel(&zoomed, point) - middle).distance(expected) < 1e-6 * factor);
        assert_same(&super::zoomed(&zoomed, 1.0 / factor).unwrap(), &view);
    }
    for (right, up) in [(3.0, -2.0), (-90.0, 41.0)] {
        let panned = panned(&view, right, up).unwrap();
        let shift = DVec2::new(-right, up) / view.pixel_spacing();
        assert!(pixel(&panned, point).distance(pixel(&view, point) + shift) < 1e-9);
        assert_same(&super::panned(&panned, -right, -up).unwrap(), &view);
    }
}

#[test]
fn a_fitted_view_holds_all_points_in_its_middle_and_little_more() {
    for (count, size) in [(2, [60, 40]), (5, [8, 200]), (9, [200, 9])] {
        let points: Vec<DVec3> = (0..count)
            .map(|n| f64::from(n * 7 + 1))
            .map(|n| DVec3::new(90.0 * n.sin(), 70.0 * (1.7 * n).cos(), 40.0 * (2.9 * n).sin()))
            .collect();
        let camera = Camera::new(DVec3::ZERO, DVec3::new(1.0, 1.0, -1.0), DVec3::Z, size, 1.0).unwrap();
        let fitted = fitted(&camera, &points).unwrap();
        let seen = |point: &DVec3| fitted.view_from_world(*point).truncate() / fitted.pixel_spacing();
        let low = points.iter().map(seen).reduce(DVec2::min).unwrap();
        let high = points.iter().map(seen).reduce(DVec2::max).unwrap();
        assert!((low + high).length() < 1e-6, "{low} to {high}");
        let used = ((high - low) / DVec2::new(size[0] as f64, size[1] as f64)).max_element();
        assert!(used > 0.85 && used < 0.9, "{used} of the view");
    }
}

#[test]
fn axes_have_names() {
    let named = |name: &str| Axis::named(name).unwrap().of(&front());
    assert_eq!(["superior", "up", "right", "direction"].map(named), [DVec3::Z, DVec3::Z, DVec3::X, DVec3::Y]);
    assert_eq!(Axis::named("left").unwrap_err().found, "'left'");
}

#[test]
fn a_rotation_needs_a_finite_angle_and_an_axis() {
    let found = |angle: f64, axis: DVec3| rotated(&front(), angle, Axis::World(axis)).unwrap_err().found;
    assert_eq!(found(1.0, DVec3::ZERO), "angle 1.0 about [0.0, 0.0, 0.0]");
    assert_eq!(found(f64::NAN, DVec3::X), "angle nan about [1.0, 0.0, 0.0]");
    assert_eq!(found(2.5, DVec3::new(f64::INFINITY, 0.0, 1e-5)), "angle 2.5 about [inf, 0.0, 1e-05]");
    assert_eq!(found(0.0, DVec3::new(1.0, f64::NAN, 0.0)), "angle 0.0 about [1.0, nan, 0.0]");
}

#[test]
fn zooming_changes_the_spacing_and_panning_the_center() {
    let zoomed = zoomed(&front(), 4.0).unwrap();
    assert_eq!((zoomed.pixel_spacing(), zoomed.center()), (0.25, DVec3::ZERO));
    let panned = panned(&front(), 3.0, -2.0).unwrap();
    assert_eq!((panned.pixel_spacing(), panned.center()), (1.0, DVec3::new(3.0, 0.0, -2.0)));
}

#[test]
fn zooming_and_panning_need_finite_numbers() {
    for (factor, text) in [(0.0, "0.0"), (-1.0, "-1.0"), (f64::NAN, "nan"), (f64::INFINITY, "inf")] {
        assert_eq!(zoomed(&front(), factor).unwrap_err().found, text);
    }
    assert_eq!(panned(&front(), f64::NAN, 1.0).unwrap_err().found, "[nan, 1.0]");
    assert_eq!(panned(&front(), 0.0, 1e7).unwrap_err().subject, "center of the camera");
}

#[test]
fn a_bent_vessel_fits_at_every_amount_and_fills_the_view_at_one() {
    let points: Vec<DVec3> = (0..=60)
        .map(|n| {
            let turn = f64::from(n) * 0.1;
            DVec3::new(20.0 * turn.cos(), 20.0 * turn.sin(), -f64::from(n))
        })
        .collect();
    let vessel = Vessel::new(points, None).expect("a vessel");
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [300, 200], 1.0).expect("a camera");
    let fit = fitted_uncurling(&camera, &vessel, 0.0).expect("a view");
    let path = Arc::new(CenterlinePath::new(&vessel, 0.0).expect("a path"));
    let taken = (0..=8).map(|step| {
        let uncurl = Uncurl::new(Arc::clone(&path), fit, f64::from(step) / 8.0, None).expect("a layout");
        let extent = uncurl.extent() * 2.0 / fit.pixel_spacing();
        (extent.x / 300.0).max(extent.y / 200.0)
    });
    let most = taken.fold(0.0, f64::max);
    assert!(most > 0.85 && most < 0.9 + 1e-9, "{most}");
    assert_eq!((fit.direction(), fit.up(), fit.size()), (camera.direction(), camera.up(), camera.size()));
}
