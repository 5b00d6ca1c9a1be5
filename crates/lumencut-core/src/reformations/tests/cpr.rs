use super::*;
use crate::stop::NEVER;
use crate::vessel_tree::Vessel;

const FRONT: View = View { up: DVec3::Z, angle: 0.0, normal: None };
const MODES: [CprMode; 3] = [CprMode::Projected, CprMode::Stretched, CprMode::Straightened];

fn layout(points: &[DVec3], mode: CprMode, view: View) -> Result<Cpr> {
    Cpr::new(CenterlinePath::new(&Vessel::new(points.to_vec(), None)?, 0.0)?, mode, view, Some(20.0), 0.5)
}

fn wave(n: i32) -> DVec3 {
    let t = f64::from(n) * 0.05;
    DVec3::new(8.0 * t.sin(), 5.0 * (0.7 * t).cos(), 60.0 - 6.0 * t)
}

#[test]
fn a_straight_vessel_is_the_same_plane_in_all_modes() {
    let points = [DVec3::new(3.0, 4.0, 30.0), DVec3::new(3.0, 4.0, 10.0)];
    for mode in MODES {
        let cpr = layout(&points, mode, FRONT).unwrap();
        assert_eq!(cpr.size(), [41, 41]);
        let curved = cpr.curved(NEVER).unwrap();
        for (p, place) in curved.position().iter().enumerate() {
            let [i, j] = [p % 41, p / 41].map(|n| n as f64);
            let expected = DVec3::new(3.0 + 0.5 * (i - 20.0), 4.0, 30.0 - 0.5 * j);
            assert!(place.distance(expected) < 1e-12, "{mode:?} {place} {expected}");
        }
        assert!(curved.slab_direction().iter().all(|direction| direction.distance(glam::Vec3::Y) < 1e-6));
        assert!(!cpr.folded(NEVER).unwrap().contains(&true));
    }
}

#[test]
fn pixels_and_world_are_inverse_in_all_modes() {
    let points: Vec<_> = (0..200).map(wave).collect();
    for (mode, angle) in MODES.into_iter().flat_map(|mode| [0.0, 0.8].map(|angle| (mode, angle))) {
        let cpr = layout(&points, mode, View { angle, ..FRONT }).unwrap();
        let (folded, [width, height]) = (cpr.folded(NEVER).unwrap(), cpr.size());
        let mut tried = 0;
        for p in (0..width * height).step_by(7).filter(|p| mode == CprMode::Projected || !folded[*p]) {
            let pixel = DVec2::new((p % width) as f64, (p / width) as f64);
            let back = cpr.pixel_from_world(cpr.world_from_pixel(pixel));
            assert!(back.distance(pixel) < 1e-6, "{mode:?} {pixel} {back}");
            tried += 1;
        }
        assert!(tried > 200);
    }
}

#[test]
fn a_turned_layout_is_one_made_at_that_angle() {
    let points: Vec<_> = (0..200).map(wave).collect();
    for mode in MODES {
        let made = layout(&points, mode, View { angle: 1.1, ..FRONT }).unwrap().curved(NEVER).unwrap();
        let turned = layout(&points, mode, FRONT).unwrap().rotated(1.1).unwrap().curved(NEVER).unwrap();
        assert_eq!(made.position(), turned.position());
    }
}

#[test]
fn views_are_from_the_front_or_below() {
    for (up, across, ahead) in [
        (DVec3::Z, DVec3::X, DVec3::Y),
        (DVec3::NEG_Y, DVec3::X, DVec3::Z),
        (DVec3::X, DVec3::NEG_Z, DVec3::Y),
        (DVec3::new(0.0, 3.0, 4.0), DVec3::X, DVec3::new(0.0, 0.8, -0.6)),
    ] {
        let axes = View { up, ..FRONT }.unturned().unwrap();
        assert!(axes.across.distance(across) < 1e-12 && axes.ahead.distance(ahead) < 1e-12, "{axes:?}");
    }
    let axes = View { angle: std::f64::consts::FRAC_PI_2, ..FRONT }.turned().unwrap();
    assert!(axes.ahead.distance(DVec3::NEG_X) < 1e-12, "seen from the patient's left");
}

#[test]
fn what_makes_no_picture_is_refused() {
    let level = [DVec3::ZERO, DVec3::X * 30.0];
    let short = |mode| layout(&level, mode, FRONT).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(short(CprMode::Projected).contains("lies in one row of the projected CPR"));
    assert!(short(CprMode::Stretched).contains("lies in one row of the stretched CPR"));
    let tall = [DVec3::ZERO, DVec3::Z * 30.0];
    for view in [
        View { up: DVec3::ZERO, ..FRONT },
        View { angle: f64::NAN, ..FRONT },
        View { normal: Some(DVec3::Z), ..FRONT },
        View { normal: Some(DVec3::NAN), ..FRONT },
    ] {
        assert_eq!(layout(&tall, CprMode::Straightened, view).err().map(|e| e.kind), Some(ErrorKind::Camera));
    }
    let path = || CenterlinePath::new(&Vessel::new(tall.to_vec(), None).unwrap(), 0.0).unwrap();
    for (width, spacing) in
        [(Some(0.0), 1.0), (Some(f64::NAN), 1.0), (None, 0.0), (None, f64::NAN), (Some(10.0), 1e-5)]
    {
        let error = Cpr::new(path(), CprMode::Straightened, FRONT, width, spacing).err();
        assert_eq!(error.map(|e| e.kind), Some(ErrorKind::Camera));
    }
}
