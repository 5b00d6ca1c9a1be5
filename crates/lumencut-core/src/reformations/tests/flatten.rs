use super::*;
use crate::stop::NEVER;
use crate::vessel_tree::Vessel;

fn curve(points: impl IntoIterator<Item = DVec3>) -> CenterlinePath {
    CenterlinePath::new(&Vessel::new(points.into_iter().collect(), None).unwrap(), 0.0).unwrap()
}

fn arc(radius: f64, height: f64, turn: f64) -> CenterlinePath {
    let angle = |n: i32| f64::from(n) / 400.0 * turn;
    curve((0..=400).map(|n| DVec3::new(radius * angle(n).cos(), radius * angle(n).sin(), height)))
}

/// The largest relative error of a distance between neighbouring pixels along rows and columns, and of their right angle.
fn distortion(made: &Flattened) -> [f64; 3] {
    let [width, height] = made.size();
    let mut most = [0.0_f64; 3];
    for j in 0..height - 1 {
        for i in 0..width - 1 {
            let [here, right, down] = [(i, j), (i + 1, j), (i, j + 1)]
                .map(|(i, j)| made.world_from_pixel(DVec2::new(i as f64, j as f64)));
            if !(here + right + down).is_finite() {
                continue;
            }
            let [across, along] = [right - here, down - here];
            let side = made.pixel_spacing();
            most[0] = most[0].max((across.length() / side - 1.0).abs());
            most[1] = most[1].max((along.length() / side - 1.0).abs());
            most[2] = most[2].max(across.dot(along).abs() / side / side);
        }
    }
    most
}

#[test]
fn a_plane_keeps_all_lengths_and_angles() {
    let ends = [[0.0, 0.0], [0.0, 20.0], [0.0, 35.0]];
    let lines = ends.map(|[x, y]| curve([DVec3::new(x, y, 0.0), DVec3::new(x + 40.0, y, 0.0)]));
    for keep in [Keep::Lines, Keep::Rows] {
        for count in [2, 3] {
            let made = Flattened::new(&lines[..count], keep, 0.5).unwrap();
            assert!(distortion(&made).iter().all(|error| *error < 1e-9), "{:?}", distortion(&made));
            assert_eq!(made.size()[1], 81);
        }
    }
}

#[test]
fn a_cylinder_and_a_cone_lose_nothing() {
    let cylinder = [arc(30.0, 0.0, 2.0), arc(30.0, 25.0, 2.0)];
    let made = Flattened::new(&cylinder, Keep::Lines, 0.5).unwrap();
    // Chords of 400 parts are shorter than the arc by 1e-6 of it.
    assert_eq!(made.size(), [51, 119]);
    assert!(distortion(&made).iter().all(|error| *error < 2e-3), "{:?}", distortion(&made));
    // Across its generators a cone's lines have true lengths; the curve in the middle too.
    let cone = [arc(20.0, 0.0, 2.0), arc(40.0, 20.0, 2.0)];
    let made = Flattened::new(&cone, Keep::Lines, 0.5).unwrap();
    let [across, _, angle] = distortion(&made);
    assert!(across < 1e-9 && angle < 2e-2, "{across} {angle}");
    let middle = made.middle.x;
    let far = [0.0, 60.0].map(|row| made.world_from_pixel(DVec2::new(middle, row)));
    let chord = 2.0 * 30.0 * (30.0_f64 / 30.0 / 2.0).sin();
    assert!((far[0].distance(far[1]) - chord).abs() < 1e-3, "{}", far[0].distance(far[1]));
}

#[test]
fn lengths_are_true_along_what_is_kept() {
    let wave = |y: f64, lift: f64| {
        curve((0..=300).map(move |n| {
            let x = f64::from(n) * 0.2;
            DVec3::new(x, y + 3.0 * (x / 9.0).sin(), lift * (x / 7.0).cos())
        }))
    };
    let curves = [wave(0.0, 2.0), wave(14.0, -3.0), wave(22.0, 5.0), wave(35.0, 0.0)];
    for keep in [Keep::Lines, Keep::Rows] {
        let made = Flattened::new(&curves, keep, 0.25).unwrap();
        let [width, height] = made.size();
        // A thousand chords between two pixels are as long as the pixels are far apart.
        let length = |from: DVec2, to: DVec2| {
            let points: Vec<_> =
                (0..=1000).map(|n| made.world_from_pixel(from.lerp(to, f64::from(n) / 1000.0))).collect();
            points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>()
        };
        let middle = made.middle;
        let (across, along) = (DVec2::new(middle.x + 30.0, 0.0), DVec2::new(0.0, middle.y + 60.0));
        let pairs = match keep {
            Keep::Lines => [
                (DVec2::new(middle.x, 3.0), DVec2::new(middle.x, along.y)),
                (DVec2::new(middle.x - 20.0, 37.0), DVec2::new(across.x, 37.0)),
            ],
            Keep::Rows => [
                (DVec2::new(9.0, middle.y), DVec2::new(across.x, middle.y)),
                (DVec2::new(17.0, middle.y - 40.0), DVec2::new(17.0, along.y)),
            ],
        };
        for (from, to) in pairs {
            let expected = from.distance(to) * 0.25;
            assert!((length(from, to) - expected).abs() < 1e-4, "{keep:?} {} {expected}", length(from, to));
        }
        assert!(width > 100 && height > 200);
    }
}

#[test]
fn world_points_come_back_to_their_pixels() {
    let bowed = |z: f64| {
        curve((0..=200).map(move |n| {
            let t = f64::from(n) / 200.0 * 2.4 - 1.2;
            DVec3::new(40.0 * t.sin(), 30.0 * t.cos() + 0.1 * z, z)
        }))
    };
    for keep in [Keep::Lines, Keep::Rows] {
        let made = Flattened::new(&[bowed(0.0), bowed(12.0), bowed(30.0)], keep, 0.5).unwrap();
        for pixel in [DVec2::new(5.0, 20.0), DVec2::new(31.25, 77.5), made.middle, DVec2::new(44.0, 120.0)] {
            let back = made.pixel_from_world(made.world_from_pixel(pixel));
            assert!(back.distance(pixel) < 1e-5, "{keep:?} {pixel} {back}");
        }
        // A point next to the surface has the pixel of its foot.
        let (point, normal) = made.point(DVec2::new(30.0, 60.0)).unwrap();
        let foot = made.pixel_from_world(point + normal);
        assert!(foot.distance(DVec2::new(30.0, 60.0)) < 1e-3, "{foot}");
    }
}

#[test]
fn a_curve_that_runs_against_the_others_is_turned() {
    let line = |y: f64| [DVec3::new(0.0, y, 0.0), DVec3::new(30.0, y, 0.0)];
    let mut against = line(10.0);
    against.reverse();
    let [same, turned] = [line(10.0), against]
        .map(|other| Flattened::new(&[curve(line(0.0)), curve(other)], Keep::Lines, 1.0).unwrap());
    let pixel = DVec2::new(3.0, 7.0);
    assert_eq!(same.world_from_pixel(pixel), turned.world_from_pixel(pixel));
}

#[test]
fn what_is_no_surface_is_rejected() {
    let line = |from: [f64; 2], to: [f64; 2]| curve([from, to].map(|[x, y]| DVec3::new(x, y, 0.0)));
    let one = line([0.0, 0.0], [30.0, 0.0]);
    let refused = |curves: &[CenterlinePath], side: f64| {
        Flattened::new(curves, Keep::Lines, side).map(|_| ()).unwrap_err()
    };
    assert_eq!(refused(std::slice::from_ref(&one), 1.0).kind, ErrorKind::VesselTree);
    let crossing = refused(&[one.clone(), line([10.0, -5.0], [20.0, 5.0])], 1.0);
    assert_eq!(crossing.found, "curves 0 and 1 that cross");
    assert_eq!(refused(&[one.clone(), line([0.0, 9.0], [30.0, 9.0])], 0.0).kind, ErrorKind::Camera);
    // Curves may begin at one point.
    assert!(Flattened::new(&[one, line([0.0, 0.0], [30.0, 9.0])], Keep::Lines, 1.0).is_ok());
}

#[test]
fn a_sphere_is_folded_nowhere_and_a_surface_on_its_back_is() {
    let meridian = |turn: f64| {
        curve((0..=100).map(move |n| {
            let t = f64::from(n) / 100.0 * 2.0 - 1.0;
            DVec3::new(30.0 * t.cos() * turn.cos(), 30.0 * t.cos() * turn.sin(), 30.0 * t.sin())
        }))
    };
    let sphere = Flattened::new(&[meridian(0.0), meridian(0.4), meridian(0.8)], Keep::Rows, 0.5).unwrap();
    assert!(sphere.folded(NEVER).unwrap().iter().all(|folded| !folded));
    let row = |y: f64, z: f64| curve([DVec3::new(0.0, y, z), DVec3::new(20.0, y, z)]);
    let back = Flattened::new(&[row(0.0, 0.0), row(10.0, 0.1), row(0.0, 0.2)], Keep::Lines, 0.25).unwrap();
    assert!(back.folded(NEVER).unwrap().iter().any(|folded| *folded));
}
