//! Clicks that are taken although they lie beside lumen, or where hardly anything but lumen is around them.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::straight_tube;
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::traced::Traced;
use lumencut_vessels::trace::clicks::tracer::Tracer;

fn traced(volume: &Volume, clicks: &[DVec3]) -> lumencut_core::error::Result<Traced> {
    let clicks = Clicks { vessels: vec![clicks.to_vec()], ..Clicks::default() };
    Tracer::default().trace(volume, &clicks, &|| false, None).map(|mut lines| lines.remove(0))
}

/// A chamber of blood (470 HU, noise of 40) of radius 48 mm in fat, whose voxels are cubes of 1.5 mm: within 30 mm of its middle
/// there is nothing but blood.
fn chamber() -> (Vec<i16>, [usize; 3], DAffine3) {
    let side = 72;
    let mut seed = 7u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 16) / 65536.0 - 0.5
    };
    let value = |n: usize| {
        let index = DVec3::new((n % side) as f64, (n / side % side) as f64, (n / (side * side)) as f64);
        let is_blood = (index - DVec3::splat(35.5)).length() * 1.5 < 48.0;
        // Twelve even deviates have about the distribution of a normal one.
        let deviate: f64 = (0..12).map(|_| noise()).sum();
        (if is_blood { 470.0 } else { -90.0 } + 40.0 * deviate).round() as i16
    };
    let affine = DAffine3::from_scale(DVec3::splat(1.5)) * DAffine3::from_translation(DVec3::splat(-35.5));
    ((0..side * side * side).map(value).collect(), [side; 3], affine)
}

#[test]
fn clicks_in_blood_alone_are_no_tissue_whatever_the_noise() {
    let (values, size, affine) = chamber();
    let strides = [1, size[0], size[0] * size[1]];
    let volume = Volume::new(Voxels::I16(&values), size, strides, affine).unwrap();
    let clicks = [DVec3::new(0.4, -0.3, -10.0), DVec3::new(-0.6, 0.2, 9.0)];
    let line = traced(&volume, &clicks);
    assert!(line.is_ok(), "{:?}", line.err());
    assert!(traced(&volume, &[clicks[0], DVec3::Z * 51.0]).is_err(), "fat is refused as before");
}

#[test]
fn a_click_next_to_lumen_means_the_lumen_and_one_farther_away_is_refused() {
    let phantom = straight_tube().unwrap();
    let volume = phantom.volume().unwrap();
    let (from, to) = (DVec3::Z * -15.0, DVec3::new(0.3, 0.2, 15.0));
    // The tube has a radius of 4 mm; a place that looks like lumen on all sides lies about 3 mm from its middle.
    for first in [DVec3::new(4.6, 0.0, -15.0), DVec3::new(0.0, -4.6, -15.0)] {
        let line = traced(&volume, &[first, to]).unwrap().line;
        assert!(line.points[0].truncate().length() < 1.0, "{}", line.points[0]);
        assert!(traced(&volume, &[from, first + DVec3::Z * 30.0]).is_ok());
    }
    let refused = traced(&volume, &[from, DVec3::new(7.0, 0.0, 15.0)]).unwrap_err();
    assert!(refused.mend.contains("the nearest place that looks like lumen"), "{refused}");
    // What is refused before a second click, and what is not, is the same.
    let tracer = Tracer::default();
    assert!(tracer.check_click(&volume, DVec3::new(4.6, 0.0, -15.0)).is_ok());
    assert!(tracer.check_click(&volume, DVec3::new(7.0, 0.0, -15.0)).is_err());
}
