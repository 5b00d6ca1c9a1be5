use super::*;
use crate::pipeline::Request;
use crate::reformations::cr::{CrParameters, cr};
use crate::scene::LeveledTree;
use crate::settings::Settings;
use crate::stop::NEVER;
use crate::vessel_tree::{Vessel, VesselTree};

fn camera(direction: DVec3) -> Camera {
    Camera::new(DVec3::ZERO, direction, DVec3::Z, [97, 131], 0.7).unwrap()
}

fn winding() -> Vessel {
    let point = |t: f64| DVec3::new(15.0 * (2.0 * t).sin(), 10.0 * (3.0 * t).cos(), 25.0 * t.cos());
    Vessel::new((0..=200).map(|n| point(f64::from(n) / 70.0)).collect(), None).unwrap()
}

fn tangential(vessel: &Vessel, camera: Camera) -> Tangential {
    Tangential::new(Arc::new(CenterlinePath::new(vessel, 0.0).unwrap()), camera).unwrap()
}

#[test]
fn it_is_cr_of_one_vessel_without_a_threshold() {
    for direction in [DVec3::Y, DVec3::new(0.5, 0.7, -0.4)] {
        let (camera, settings) = (camera(direction), Settings::default());
        let tree = LeveledTree::new(VesselTree::new(vec![winding()]).unwrap());
        let parameters = CrParameters { arc_threshold: 1e6, ..CrParameters::default() };
        let frame = cr(&tree, &parameters, &Request::new(&camera, &settings)).unwrap();
        let curved = tangential(&winding(), camera).curved(NEVER).unwrap();
        let same = |(point, depth): (&DVec3, &f32)| {
            (camera.view_from_world(*point).z - f64::from(*depth)).abs() < 1e-3
        };
        let equal = curved.position().iter().zip(frame.depth()).filter(|both| same(*both)).count();
        // If two positions are equally near up to rounding, either may be shown.
        assert!(equal + 2 >= 97 * 131, "{equal} pixels");
    }
}

#[test]
fn a_straight_tube_is_as_wide_as_it_is_from_every_side() {
    // The chord of a tube across its projection is its diameter.
    let axis = DVec3::new(0.3, 0.5, -0.8).normalize();
    let vessel = Vessel::new(vec![axis * -60.0, axis * 60.0], None).unwrap();
    for direction in [DVec3::Y, DVec3::X, DVec3::new(0.6, -0.3, 0.2)] {
        let camera = camera(direction);
        let layout = tangential(&vessel, camera);
        let seen = DVec2::new(axis.dot(camera.right()), -axis.dot(camera.up())).normalize();
        for aside in [-6.0, 2.5, 4.0] {
            let pixel = DVec2::new(48.0, 65.0) + seen.perp() * (aside / 0.7);
            let distance = layout.world_from_pixel(pixel).reject_from_normalized(axis).length();
            assert!((distance - f64::abs(aside)).abs() < 1e-9, "{distance} instead of {aside}");
        }
    }
}

#[test]
fn a_plane_arc_is_shown_as_it_is() {
    let arc =
        (0..=90).map(|n| f64::from(n).to_radians()).map(|t| DVec3::new(20.0 * t.cos(), 4.0, 20.0 * t.sin()));
    let layout = tangential(&Vessel::new(arc.collect(), None).unwrap(), camera(DVec3::Y));
    for point in layout.curved(NEVER).unwrap().position() {
        assert!((point.y - 4.0).abs() < 1e-9);
    }
    let arc_length = layout.arc_length(NEVER).unwrap();
    let pixel = layout.pixel_from_world(DVec3::new(12.0, 4.0, 12.0));
    let at = arc_length[pixel.y.round() as usize * 97 + pixel.x.round() as usize];
    assert!((at - 20.0 * std::f64::consts::FRAC_PI_4).abs() < 0.7);
}

#[test]
fn every_point_has_the_pixel_where_it_is_seen() {
    let layout = tangential(&winding(), camera(DVec3::new(0.5, 0.7, -0.4)));
    let pixel = DVec2::new(33.3, 71.9);
    assert!(layout.pixel_from_world(layout.world_from_pixel(pixel)).distance(pixel) < 1e-9);
    let nearer = layout.world_from_pixel(pixel) - layout.camera.direction() * 7.0;
    assert!(layout.pixel_from_world(nearer).distance(pixel) < 1e-9);
    assert!(layout.folded(NEVER).unwrap().iter().all(|folded| !folded));
}

#[test]
fn a_vessel_seen_as_one_point_is_refused() {
    let along = Vessel::new(vec![DVec3::ZERO, DVec3::Y * 30.0], None).unwrap();
    let path = Arc::new(CenterlinePath::new(&along, 0.0).unwrap());
    let error = Tangential::new(path, camera(DVec3::Y)).expect_err("one point");
    assert_eq!(error.kind, ErrorKind::Camera);
}
