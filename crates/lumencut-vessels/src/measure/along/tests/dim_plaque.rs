use super::*;
use crate::measure::fit::Fit;
use crate::measure::model::ellipse::Ellipse;
use crate::measure::section::Track;
use crate::measure::uncertainty::Parts;
use glam::{DVec2, DVec3};
use lumencut_core::vessel_tree::Vessel;

const SURE: Parts = Parts { noise: 0.1, point_spread: 0.0, wall: 0.0, lumen: 0.0, surroundings: 0.0 };

fn section(diameter: f64, lumen: f64) -> Section {
    let fit = Fit {
        ellipse: Ellipse::circle(DVec2::ZERO, 0.5 * diameter),
        lumen: [lumen, 0.01],
        background: 0.0,
        wall: None,
        missed: 0.1,
        uncertainty: SURE.total(),
        parts: SURE,
        free: 1.0,
        other: None,
    };
    Section { fit: Some(fit), flags: 0, ..Section::none() }
}

/// The middle one of the sections of a vessel of 3 mm with walls of 0.3 of the contrast, if it has this fit.
fn middle(diameter: f64, lumen: f64) -> Section {
    let vessel = Vessel::new(vec![DVec3::ZERO, DVec3::Z * 20.0], None).expect("a vessel");
    let places = Track::new(&vessel, None).and_then(|track| track.places(0.5)).expect("places");
    let made = |n: usize| if n == 20 { section(diameter, lumen) } else { section(3.0, 1.0) };
    let mut sections: Vec<Section> = (0..places.len()).map(made).collect();
    flag_dim_plaque(&places, &mut sections, &vec![1.0; places.len()], 0.3);
    let [beside, middle] = [19, 20].map(|n| sections[n].clone());
    assert_eq!((beside.flags, beside.fit.expect("a fit").uncertainty), (0, 0.1));
    middle
}

#[test]
fn a_dim_and_narrow_section_may_be_plaque() {
    let found = middle(2.5, 0.7);
    assert_eq!(found.flags, PLAQUE);
    // 0.4 of 0.7 above the wall is 0.57; without plaque of 0.3 it is 0.39 of the area.
    let narrower = 2.5 * (1.0 - (0.4_f64 / 0.7 - 0.3).sqrt() / 0.7_f64.sqrt());
    assert!((found.fit.expect("a fit").uncertainty - narrower.hypot(0.1)).abs() < 1e-9);
}

#[test]
fn a_lumen_that_is_only_dim_or_only_narrow_is_measured() {
    for (diameter, lumen) in [(3.0, 0.7), (2.0, 0.98)] {
        let found = middle(diameter, lumen);
        assert_eq!((found.flags, found.fit.expect("a fit").uncertainty), (0, 0.1));
    }
}
