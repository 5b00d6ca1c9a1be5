use std::f64::consts::FRAC_PI_2;

use super::*;

#[test]
fn every_view_lies_across_the_stretch() {
    for along in [[0.3, -0.5, 0.8], [0.0, 0.0, -1.0], [0.9, 0.1, -0.2], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]] {
        let along = DVec3::from_array(along).normalize();
        let least = least_turned(along);
        assert!(towards_detector(least).dot(along).abs() < 1e-9, "{along}: {least:?}");
        for degrees in [-60.0_f64, -20.0, 0.0, 35.0] {
            let Ok(turned) = angulated(along, degrees.to_radians()) else {
                assert!(along.z.abs() < 1e-9);
                continue;
            };
            assert!(towards_detector(turned).dot(along).abs() < 1e-9);
            // No other view perpendicular to the vessel is nearer to the frontal one.
            let cosine = |arm| -towards_detector(arm).y;
            assert!(cosine(turned) <= cosine(least) + 1e-9);
        }
    }
}

#[test]
fn signs_are_those_of_the_field() {
    // The detector is on the patient's left, and above the head.
    assert!(towards_detector(CArm { lao: FRAC_PI_2, cranial: 0.0 }).abs_diff_eq(DVec3::X, 1e-12));
    assert!(towards_detector(CArm { lao: 0.3, cranial: FRAC_PI_2 }).abs_diff_eq(DVec3::Z, 1e-12));
    assert!(towards_detector(CArm { lao: 0.0, cranial: 0.0 }).abs_diff_eq(DVec3::NEG_Y, 1e-12));
    // A vessel that runs towards the feet and the front is best seen from below.
    let neck = DVec3::new(0.0, -1.0, -1.0).normalize();
    let arm = least_turned(neck);
    assert!(arm.lao.abs() < 1e-12 && (arm.cranial.abs() - FRAC_PI_2 / 2.0).abs() < 1e-12);
    assert!(towards_detector(arm).dot(neck).abs() < 1e-12);
}

#[test]
fn a_vessel_towards_the_viewer_is_seen_from_the_side() {
    let arm = least_turned(DVec3::NEG_Y);
    assert!((arm.lao - FRAC_PI_2).abs() < 1e-12 && arm.cranial.abs() < 1e-12);
    assert!(angulated(DVec3::X, 0.5).is_err());
    assert!(angulated(DVec3::Z, f64::NAN).is_err());
}

#[test]
fn the_head_is_up_at_the_detector() {
    for (lao, cranial) in [(0.0, 0.0), (0.7, 0.4), (-1.2, -1.0), (2.0, 1.5)] {
        let arm = CArm { lao, cranial };
        let (view, up) = (towards_detector(arm), up_at_detector(arm));
        assert!(up.is_normalized() && up.dot(view).abs() < 1e-12);
        assert!(up.abs_diff_eq(DVec3::Z.reject_from_normalized(view).normalize(), 1e-9));
    }
    assert!(up_at_detector(CArm { lao: 0.0, cranial: FRAC_PI_2 }).abs_diff_eq(DVec3::Y, 1e-12));
    assert!(up_at_detector(CArm { lao: 0.0, cranial: -FRAC_PI_2 }).abs_diff_eq(DVec3::NEG_Y, 1e-12));
}

#[test]
fn a_detour_is_told_in_straight_distances() {
    assert!((Stretch { length: 30.0, straight: 20.0 }.tortuosity() - 1.5).abs() < 1e-12);
    assert_eq!(Stretch { length: 30.0, straight: 0.0 }.tortuosity(), f64::INFINITY);
}
