use super::*;
use crate::measure::section::scale::Scale;
use crate::voxels::Voxels;
use glam::{DAffine3, DVec3};
use lumencut_core::volume::{Volume, Voxels as Stored};

const SIDE: usize = 41;

/// Whether a contour with a radius of 8 mm counts as lumen in a slice of 0.5 mm voxels with the values `share`.
fn is_plausible(share: impl Fn(DVec2) -> f32) -> bool {
    let at = |n: usize| (n as f64 - 20.0) * 0.5;
    let slice: Vec<f32> = (0..SIDE * SIDE).map(|n| share(DVec2::new(at(n % SIDE), at(n / SIDE)))).collect();
    let values = slice.repeat(3);
    let affine = DAffine3::from_scale(DVec3::splat(0.5));
    let volume = Volume::new(Stored::F32(&values), [SIDE, SIDE, 3], [1, SIDE, SIDE * SIDE], affine).unwrap();
    let voxels = Voxels::new(&volume);
    let rays = Rays { voxels: &voxels, scale: Scale { outside: 0.0, contrast: 1.0 } };
    let place = SectionPlane {
        at: 0.0,
        origin: DVec3::new(10.0, 10.0, 0.5),
        axes: [DVec3::X, DVec3::Y],
        normal: DVec3::Z,
    };
    encloses_lumen(&rays, &place, DVec2::ZERO, &[8.0; RAYS], 1.0, lumen_shares(1.0, 0.0))
}

#[test]
fn a_lumen_is_believed_however_its_medium_mixes() {
    assert!(is_plausible(|_| 1.0));
    assert!(is_plausible(|place| 1.0 + 0.05 * place.x as f32));
    // Values outside the contour do not matter.
    assert!(is_plausible(|place| if place.length() < 7.5 { 1.0 } else { 0.0 }));
}

#[test]
fn a_contour_across_a_flap_is_not() {
    assert!(!is_plausible(|place| if (place.x - 1.0).abs() < 1.0 { 0.1 } else { 1.0 }));
}

#[test]
fn a_contour_that_runs_into_another_lumen_or_out_of_its_own_is_not() {
    assert!(!is_plausible(|place| if place.x > 3.0 { 2.2 } else { 1.0 }));
    assert!(!is_plausible(|place| if place.x > 3.0 { 0.0 } else { 1.0 }));
}

#[test]
fn a_lumen_as_narrow_as_the_blur_shows_nothing_else() {
    let walls = [0.5; RAYS];
    let values = [0.0_f32; 27];
    let affine = DAffine3::IDENTITY;
    let volume = Volume::new(Stored::F32(&values), [3; 3], [1, 3, 9], affine).unwrap();
    let voxels = Voxels::new(&volume);
    let rays = Rays { voxels: &voxels, scale: Scale { outside: 0.0, contrast: 1.0 } };
    let place = SectionPlane { at: 0.0, origin: DVec3::ONE, axes: [DVec3::X, DVec3::Y], normal: DVec3::Z };
    assert!(encloses_lumen(&rays, &place, DVec2::ZERO, &walls, 1.0, lumen_shares(1.0, 0.0)));
}
