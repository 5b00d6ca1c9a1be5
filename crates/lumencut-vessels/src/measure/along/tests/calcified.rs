use super::*;
use crate::measure::fit::Fit;
use crate::measure::model::ellipse::Ellipse;
use crate::measure::section::Track;
use crate::measure::uncertainty::Parts;
use glam::{DVec2, DVec3};
use lumencut_core::vessel_tree::Vessel;

fn section(diameter: f64, flags: u32, bounds: [f64; 2]) -> Section {
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
    Section { fit: Some(fit), flags, bounds, ..Section::none() }
}

/// Sections 0.5 mm apart of a vessel of 4 mm: calcium from 10 to 12 mm, where the fits have these diameters.
fn settled(at_calcium: f64, beside: f64) -> Vec<Section> {
    let vessel = Vessel::new(vec![DVec3::ZERO, DVec3::Z * 25.0], None).expect("a vessel");
    let places = Track::new(&vessel, None).and_then(|track| track.places(0.5)).expect("places");
    let made = |n: usize| match n {
        20..=24 => section(at_calcium, CALCIUM, [4.3, 5.0]),
        19 | 25 => section(beside, 0, [f64::NAN; 2]),
        _ => section(4.0, 0, [f64::NAN; 2]),
    };
    let mut sections: Vec<Section> = (0..places.len()).map(made).collect();
    settle(&places, &mut sections, 1.0);
    sections
}

#[test]
fn a_fit_that_collapsed_between_calcium_has_no_number() {
    let sections = settled(1.0, 4.0);
    assert!(sections[22].fit.is_none());
    assert_eq!((sections[22].flags, sections[22].bounds), (CALCIUM | NO_EDGE, [4.0, 5.0]));
    assert!(settled(1.4, 4.0)[22].fit.is_some(), "a narrow lumen keeps its number");
}

#[test]
fn blooming_along_the_vessel_is_flagged() {
    let sections = settled(3.0, 4.5);
    assert_eq!((sections[19].flags, sections[19].bounds), (CALCIUM, [4.0, 4.5]));
    assert_eq!(sections[18].flags, 0);
    assert_eq!(settled(3.0, 4.1)[19].flags, 0);
}
