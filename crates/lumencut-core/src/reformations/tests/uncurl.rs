use std::f64::consts::{PI, TAU};

use super::*;
use crate::reformations::cpr::{Straightened, View};
use crate::stop::NEVER;
use crate::vessel_tree::Vessel;

fn path(points: Vec<DVec3>) -> Arc<CenterlinePath> {
    Arc::new(CenterlinePath::new(&Vessel::new(points, None).unwrap(), 0.0).unwrap())
}

fn helix(radius: f64, pitch: f64) -> Vec<DVec3> {
    let point = |t: f64| DVec3::new(radius * t.cos(), radius * t.sin(), 20.0 - pitch * t / TAU);
    (0..=600).map(|n| point(2.5 * TAU * f64::from(n) / 600.0)).collect()
}

fn camera(direction: DVec3) -> Camera {
    Camera::new(DVec3::new(1.0, -2.0, 3.0), direction, DVec3::Z, [121, 161], 1.0).unwrap()
}

fn oblique() -> Camera {
    camera(DVec3::new(0.4, 0.8, -0.2))
}

fn uncurled(points: Vec<DVec3>, amount: f64) -> Uncurl {
    Uncurl::new(path(points), oblique(), amount, None).unwrap()
}

#[test]
fn at_0_every_pixel_lies_on_its_ray_at_the_depth_of_the_nearest_place() {
    let uncurl = uncurled(helix(12.0, 20.0), 0.0);
    let curved = uncurl.curved(NEVER).unwrap();
    for (point, own) in uncurl.points().iter().zip(uncurl.path.points()) {
        assert!(point.distance(*own) < 1e-9);
    }
    let seen: Vec<_> = uncurl.path.points().iter().map(|point| oblique().view_from_world(*point)).collect();
    let depth_at = |pixel: DVec2| {
        let on = seen.windows(2).map(|ends| {
            let edge = (ends[1] - ends[0]).truncate();
            let share = ((pixel - ends[0].truncate()).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
            let foot = ends[0].lerp(ends[1], share);
            (foot.truncate().distance(pixel), foot.z)
        });
        let all: Vec<_> = on.collect();
        let least = all.iter().map(|(distance, _)| *distance).fold(f64::INFINITY, f64::min);
        // Of equally near positions, any may be shown.
        all.into_iter().filter(|(distance, _)| distance - least < 1e-4).map(|(_, z)| z).collect::<Vec<_>>()
    };
    for (n, point) in curved.position().iter().enumerate().step_by(7) {
        let view = oblique().view_from_world(*point);
        let pixel = DVec2::new(oblique().view_x(n % 121), oblique().view_y(n / 121));
        assert!(view.truncate().distance(pixel) < 1e-9, "pixel {n} left its ray");
        let depths = depth_at(pixel);
        assert!(
            depths.iter().any(|z| (z - view.z).abs() < 1e-3),
            "pixel {n}: {} instead of {depths:?}",
            view.z
        );
        assert!(curved.slab_direction()[n].as_dvec3().distance(oblique().direction()) < 1e-6);
    }
    assert!(uncurl.folded(NEVER).unwrap().iter().all(|folded| !folded));
}

#[test]
fn at_1_it_is_the_straightened_cpr() {
    for points in
        [helix(12.0, 20.0), (0..40).map(|n| DVec3::new(0.0, f64::from(n * n) / 60.0, f64::from(n))).collect()]
    {
        let uncurl = uncurled(points, 1.0);
        let view = View { up: DVec3::Z, angle: 0.0, normal: Some(-oblique().direction()) };
        let straightened = Straightened::new(Arc::clone(&uncurl.path), &view).unwrap();
        let curved = uncurl.curved(NEVER).unwrap();
        let half = uncurl.path.length() / 2.0;
        for (n, point) in curved.position().iter().enumerate() {
            let (x, y) = (oblique().view_x(n % 121), half - oblique().view_y(n / 121));
            let expected = straightened.world_from_straightened(DVec3::new(x, 0.0, y));
            assert!(point.distance(expected) < 1e-8, "pixel {n}: {point} instead of {expected}");
            let ahead = straightened.frame(y.clamp(0.0, 2.0 * half)).ahead;
            assert!(curved.slab_direction()[n].as_dvec3().distance(ahead) < 1e-6);
        }
    }
}

#[test]
fn lengths_stay_true_and_the_middle_of_the_chord_moves_evenly() {
    let own = helix(12.0, 20.0);
    let middle = (own[0] + own[600]) / 2.0;
    for amount in [0.0, 0.2, 0.5, 0.9, 1.0] {
        let uncurl = uncurled(own.clone(), amount);
        for (ends, own) in uncurl.points().windows(2).zip(own.windows(2)) {
            assert!((ends[0].distance(ends[1]) - own[0].distance(own[1])).abs() < 1e-9);
        }
        let here = (uncurl.points()[0] + uncurl.points()[600]) / 2.0;
        assert!(here.distance(middle.lerp(oblique().center(), amount)) < 1e-9);
    }
    let down = uncurled(own, 1.0);
    let chord = (down.points()[600] - down.points()[0]).normalize();
    assert!(chord.distance(-oblique().up()) < 1e-9);
}

#[test]
fn a_helix_stays_a_helix_of_the_same_torsion() {
    // With curvature κ and torsion τ: radius = κ / (κ² + τ²), and a turn is 2π / √(κ² + τ²) long.
    let (radius, pitch) = (12.0, 60.0);
    let rise = pitch / TAU;
    let square = radius * radius + rise * rise;
    let (curvature, torsion) = (radius / square, rise / square);
    for amount in [0.3, 0.7] {
        let uncurl = uncurled(helix(radius, pitch), amount);
        let bent = curvature * (1.0 - amount);
        let rate = (bent * bent + torsion * torsion).sqrt();
        let along = uncurl.path.length() / 600.0;
        // Points whole turns apart differ only along the axis: by torsion / rate times their arc length.
        let step = (TAU / rate / along).round() as usize;
        let chord = uncurl.points()[step + 20].distance(uncurl.points()[20]);
        let expected = torsion / rate * step as f64 * along;
        assert!((chord / expected - 1.0).abs() < 2e-3, "{amount}: {chord} instead of {expected}");
        // Points half a turn apart also differ by the diameter.
        let half = step / 2;
        let across = uncurl.points()[half + 20].distance(uncurl.points()[20]);
        let expected = (2.0 * bent / rate / rate).hypot(torsion / rate * half as f64 * along);
        assert!((across / expected - 1.0).abs() < 2e-3, "{amount}: {across} instead of {expected}");
    }
}

#[test]
fn places_and_pixels_are_inverse() {
    for amount in [0.0, 0.4, 1.0] {
        let uncurl = uncurled(helix(12.0, 20.0), amount);
        let curved = uncurl.curved(NEVER).unwrap();
        for pixel in [[60.0, 80.0], [57.3, 70.8], [63.1, 99.9], [40.5, 90.25]].map(DVec2::from_array) {
            let there = uncurl.world_from_pixel(pixel);
            let back = uncurl.pixel_from_world(there);
            assert!(back.distance(pixel) < 1e-5, "{amount}: {pixel} came back as {back}");
        }
        let position = curved.position()[75 * 121 + 52];
        assert!(position.distance(uncurl.world_from_pixel(DVec2::new(52.0, 75.0))) < 1e-9);
        assert!(uncurl.pixel_from_world(DVec3::new(500.0, 500.0, 500.0)).is_nan());
    }
}

#[test]
fn a_pixel_beyond_the_middle_of_an_arc_is_folded_once_it_is_straight() {
    let arc =
        (0..=360).map(|n| PI * f64::from(n) / 360.0).map(|t| DVec3::new(20.0 * t.sin(), 0.0, 20.0 * t.cos()));
    let uncurl = Uncurl::new(path(arc.collect()), camera(DVec3::Y), 1.0, None).unwrap();
    let folded = uncurl.folded(NEVER).unwrap();
    // The middle of the arc lies to the left of a vessel that bends to the left.
    let at = |millimetres: f64| folded[80 * 121 + (60.0 + millimetres) as usize];
    assert_eq!([-25.0, -15.0, 0.0, 15.0, 40.0].map(at), [true, false, false, false, false]);
}

#[test]
fn what_lies_beyond_the_width_is_left_out() {
    let uncurl = Uncurl::new(path(helix(12.0, 20.0)), oblique(), 0.5, Some(20.0)).unwrap();
    let whole = uncurled(helix(12.0, 20.0), 0.5);
    let (curved, arc_length) = (uncurl.curved(NEVER).unwrap(), uncurl.arc_length(NEVER).unwrap());
    let left_out = curved.position().iter().filter(|point| point.is_nan()).count();
    assert!(left_out > 1000 && left_out < 121 * 161 - 1000, "{left_out} pixels");
    for (n, point) in curved.position().iter().enumerate() {
        let foot = whole.feet.of(DVec2::new(oblique().view_x(n % 121), oblique().view_y(n / 121)));
        if (foot.aside.length() - 10.0).abs() > 1e-3 {
            assert_eq!(point.is_nan(), foot.aside.length() > 10.0, "pixel {n}");
            assert_eq!(point.is_nan(), arc_length[n].is_nan());
        }
    }
    assert!(uncurl.world_from_pixel(DVec2::ZERO).is_nan());
}

#[test]
fn a_vessel_that_runs_to_the_head_or_along_the_view_turns_downwards() {
    for (points, direction) in [
        (vec![DVec3::ZERO, DVec3::new(0.0, 0.0, 30.0)], DVec3::Y),
        (vec![DVec3::ZERO, DVec3::new(0.0, 30.0, 0.0)], DVec3::Y),
        (vec![DVec3::ZERO, DVec3::X * 9.0, DVec3::ONE * 9.0, DVec3::ZERO], DVec3::new(0.1, 1.0, 0.3)),
    ] {
        for amount in [0.0, 0.5, 1.0] {
            let uncurl = Uncurl::new(path(points.clone()), camera(direction), amount, None).unwrap();
            assert!(uncurl.points().iter().all(|point| point.is_finite()), "{points:?} at {amount}");
            assert!(uncurl.curved(NEVER).unwrap().position().iter().all(|point| point.is_finite()));
        }
        let straight = Uncurl::new(path(points), camera(direction), 1.0, None).unwrap();
        let ends = [straight.points()[0], straight.points()[straight.points().len() - 1]];
        assert!((ends[1] - ends[0]).normalize().distance(-camera(direction).up()) < 1e-9);
    }
}

#[test]
fn what_cannot_be_uncurled_is_refused() {
    let refused = |amount, width| Uncurl::new(path(helix(12.0, 20.0)), oblique(), amount, width).err();
    for amount in [-0.1, 1.1, f64::NAN] {
        assert_eq!(refused(amount, None).map(|error| error.kind), Some(ErrorKind::Settings));
    }
    for width in [0.0, -3.0, f64::INFINITY] {
        assert_eq!(refused(0.5, Some(width)).map(|error| error.kind), Some(ErrorKind::Camera));
    }
}

#[test]
fn a_vessel_turns_little_from_one_picture_to_the_next() {
    // An arch like the aorta that leaves its plane; its first segment runs against the straight vessel.
    let point =
        |t: f64| DVec3::new(8.0 * t.sin() * t, 30.0 * t.cos(), 20.0 * t.sin() - 25.0 * (t / PI).powi(2));
    let arch: Vec<_> = (0..=200).map(|n| point(1.2 * PI * f64::from(n) / 200.0)).collect();
    let ahead = |amount: f64| {
        let uncurl = Uncurl::new(path(arch.clone()), camera(DVec3::X), amount, None).unwrap();
        let at = uncurl.path.length() / 2.0;
        uncurl.bent.true_from_bent(at) * camera(DVec3::X).direction()
    };
    for n in 0..50 {
        let [one, next] = [n, n + 1].map(|n| ahead(f64::from(n) / 50.0));
        assert!(one.angle_between(next) < 0.1, "{} radians after {n}", one.angle_between(next));
    }
}
