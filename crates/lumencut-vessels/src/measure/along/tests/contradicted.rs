use super::*;
use crate::measure::section::Track;
use crate::measure::section::blur::Blur;
use crate::measure::section::rays::Rays;
use crate::measure::section::scale::Scale;
use crate::measure::uncertainty::Parts;
use crate::voxels::Voxels;
use glam::{DAffine3, DMat3, DVec2, DVec3};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels as Stored};

const SIZE: [usize; 3] = [41, 41, 41];
const MIDDLE: usize = 20;

fn section(diameter: f64) -> Section {
    let fit = Fit {
        ellipse: Ellipse::circle(DVec2::ZERO, 0.5 * diameter),
        lumen: [1.0, 0.01],
        background: 0.0,
        wall: None,
        missed: 0.1,
        uncertainty: 0.1,
        parts: Parts::unknown(),
        free: 1.0,
        other: None,
    };
    Section { fit: Some(fit), flags: 0, ..Section::none() }
}

/// The flags in the middle of a vessel of 20 mm, whose fit there has this diameter (mm), if the lumen is `true_one` mm wide.
fn flags(fitted: f64, true_one: f64) -> u32 {
    let value = |n: usize| {
        let [x, y, z] = [n % SIZE[0], n / SIZE[0] % SIZE[1], n / (SIZE[0] * SIZE[1])];
        let away = DVec2::new(x as f64 - 20.0, y as f64 - 20.0).length();
        let width = if z.abs_diff(MIDDLE) <= 2 { true_one } else { 20.0 };
        f32::from(u8::from(away <= 0.5 * width))
    };
    let values: Vec<f32> = (0..SIZE.iter().product()).map(value).collect();
    let affine = DAffine3::IDENTITY;
    let volume = Volume::new(Stored::F32(&values), SIZE, [1, SIZE[0], SIZE[0] * SIZE[1]], affine).unwrap();
    let voxels = Voxels::new(&volume);
    let rays = Rays { voxels: &voxels, scale: Scale { outside: 0.0, contrast: 1.0 } };
    let bench = Bench { rays, blur: Blur::new(1.0, DMat3::IDENTITY), fwhm: 1.0, wall: None, doubt: None };
    let vessel = Vessel::new(vec![DVec3::new(20.0, 20.0, 0.0), DVec3::new(20.0, 20.0, 40.0)], None).unwrap();
    let places = Track::new(&vessel, None).and_then(|track| track.places(1.0)).unwrap();
    let mut sections: Vec<Section> = (0..places.len()).map(|_| section(20.0)).collect();
    sections[MIDDLE] = section(fitted);
    flag_contradicted(&bench, &places, &mut sections);
    assert!((0..sections.len()).all(|n| n == MIDDLE || sections[n].flags == 0));
    sections[MIDDLE].flags
}

#[test]
fn a_contour_within_the_lumen_does_not_count() {
    assert_eq!(flags(8.0, 20.0), NO_EDGE);
}

#[test]
fn a_narrowing_that_the_values_show_counts() {
    assert_eq!(flags(8.0, 8.0), 0);
    assert_eq!(flags(15.0, 20.0), 0, "less than half of the area is missing");
}
