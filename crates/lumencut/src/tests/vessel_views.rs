use std::f64::consts::{FRAC_PI_3, TAU};

use super::*;

fn vessel(points: &[[f64; 3]], radius: f64) -> Vessel {
    let radii = vec![radius; points.len()];
    Vessel::new(points.iter().map(|point| DVec3::from_array(*point)).collect(), Some(radii)).unwrap()
}

fn front() -> Camera {
    Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [100, 80], 1.0).unwrap()
}

#[test]
fn about_a_place_the_vessel_runs_upwards_through_the_middle() {
    // The head is up for both orders of the points.
    for points in [[[1.0, 2.0, -30.0], [7.0, 2.0, 70.0]], [[7.0, 2.0, 70.0], [1.0, 2.0, -30.0]]] {
        let along = (DVec3::from_array(points[1]) - DVec3::from_array(points[0])).normalize();
        let camera = about(&vessel(&points, 2.0), 40.0, 0.0, [100, 80]).unwrap();
        assert!(camera.center().abs_diff_eq(DVec3::from_array(points[0]) + along * 40.0, 1e-9));
        assert!(camera.up().abs_diff_eq(along * along.z.signum(), 1e-12));
        assert!(camera.direction().abs_diff_eq(DVec3::Y, 1e-12), "the vessel lies across the anterior view");
        assert!((camera.pixel_spacing() - 32.0 / 80.0).abs() < 1e-12, "eight radii to each side");
    }
}

#[test]
fn its_angle_is_that_of_a_turn_about_up() {
    let tube = vessel(&[[0.0, 3.0, -30.0], [5.0, -9.0, 20.0], [20.0, -9.0, 50.0]], 3.0);
    let first = about(&tube, 47.0, 0.0, [64, 64]).unwrap();
    for angle in [FRAC_PI_3, -2.0, TAU] {
        let [found, turned] =
            [about(&tube, 47.0, angle, [64, 64]).unwrap(), rotated(&first, angle, Axis::Up).unwrap()];
        for (one, other) in [
            (found.center(), turned.center()),
            (found.direction(), turned.direction()),
            (found.up(), turned.up()),
        ] {
            assert!(one.abs_diff_eq(other, 1e-12), "{one} beside {other}");
        }
    }
}

#[test]
fn a_vessel_along_the_anterior_view_is_seen_from_below() {
    let camera = about(&vessel(&[[0.0, 0.0, 0.0], [0.0, 50.0, 0.0]], 2.0), 10.0, 0.0, [64, 64]).unwrap();
    assert!(camera.direction().abs_diff_eq(DVec3::Z, 1e-12));
    assert!(camera.up().abs_diff_eq(DVec3::Y, 1e-12));
}

#[test]
fn a_place_lies_on_the_vessel() {
    let tube = vessel(&[[0.0, 0.0, 0.0], [0.0, 0.0, 50.0]], 2.0);
    assert!(about(&tube, 0.0, 0.0, [8, 8]).is_ok() && about(&tube, 50.0, 0.0, [8, 8]).is_ok());
    for at in [-0.1, 50.1, f64::NAN] {
        let error = about(&tube, at, 0.0, [8, 8]).unwrap_err();
        assert_eq!((error.kind, error.subject.as_str()), (ErrorKind::Camera, "place of the view"));
    }
    let without = Vessel::new(vec![DVec3::ZERO, DVec3::Z * 9.0], None).unwrap();
    assert_eq!(about(&without, 3.0, 0.0, [16, 16]).unwrap().pixel_spacing(), 1.0, "1 mm for no radius");
}

#[test]
fn a_vessel_in_a_plane_is_seen_across_that_plane() {
    let normal = DVec3::new(0.4, 0.9, 0.2).normalize();
    let (u, v) = (normal.any_orthonormal_pair().0, normal.any_orthonormal_pair().1);
    let arch: Vec<[f64; 3]> = (0..=40)
        .map(|n| ((f64::from(n) * PI / 40.0).sin_cos(), n))
        .map(|((sine, cosine), _)| ((u * cosine + v * sine) * 50.0).to_array())
        .collect();
    let found = refocused(&front(), &vessel(&arch, 4.0)).unwrap().direction();
    // The tried directions are about 12 degrees apart.
    assert!(found.dot(normal).abs() > 0.97, "{found} beside the normal {normal}");
    assert!(found.dot(DVec3::Y) > 0.0, "from the side that is nearer");
}

#[test]
fn a_view_of_a_vessel_shows_its_walls_and_what_lies_beside_them() {
    // One vessel is shorter than wide, the other is longer; each fills 80 pixels minus 6 % margin on each side.
    for (length, seen) in [(10.0, 10.0 + 4.0 * 15.0), (400.0, 400.0 + 4.0 * 15.0)] {
        let thick = vessel(&[[0.0, 0.0, 0.0], [0.0, 0.0, length]], 15.0);
        let found = refocused(&front(), &thick).unwrap();
        assert!(found.center().abs_diff_eq(DVec3::Z * length / 2.0, 1e-6));
        // The sampled positions end half a step before the ends of the vessel.
        let height = 80.0 * 0.88 * found.pixel_spacing();
        assert!((height - seen).abs() < 0.01 * length, "{height} mm of {seen}");
    }
}

#[test]
fn a_loop_is_not_seen_through_itself() {
    // Two parts lie behind each other as seen from the front, so the front view hides half of the vessel.
    let legs = vessel(&[[0.0, 0.0, -60.0], [0.0, 0.0, 60.0], [0.0, 30.0, 60.0], [0.0, 30.0, -60.0]], 5.0);
    let found = refocused(&front(), &legs).unwrap();
    assert!(found.direction().x.abs() > 0.5, "{}", found.direction());
    let straight = vessel(&[[0.0, 0.0, -60.0], [0.0, 0.0, 60.0]], 5.0);
    assert_eq!(
        refocused(&front(), &straight).unwrap().direction(),
        DVec3::Y,
        "nothing to be gained by a turn"
    );
}

#[test]
fn directions_lie_evenly_all_around() {
    let all: Vec<_> = directions().collect();
    assert_eq!(all.len(), TRIED_DIRECTIONS);
    assert!(all.iter().sum::<DVec3>().length() < 1.0);
    for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE.normalize()] {
        let nearest = all.iter().map(|direction| direction.dot(axis)).fold(-1.0, f64::max);
        assert!(nearest > 0.18f64.cos(), "{nearest} along {axis}");
    }
}
