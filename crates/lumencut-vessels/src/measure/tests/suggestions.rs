use glam::DVec3;

use super::super::profile::Source;
use super::*;

/// A profile of circles of these diameters and uncertainties (mm), 0.5 mm apart.
fn profile(sections: &[[f64; 2]]) -> Profile {
    let count = sections.len();
    let numbers = |of: &dyn Fn(&[f64; 2]) -> f64| sections.iter().map(of).collect::<Vec<_>>();
    let diameter = numbers(&|[diameter, _]| *diameter);
    Profile {
        arc_length: (0..count).map(|n| 0.5 * n as f64).collect(),
        diameter_min: diameter.clone(),
        diameter_max: diameter,
        area: numbers(&|[diameter, _]| PI * diameter * diameter / 4.0),
        uncertainty: numbers(&|[_, uncertainty]| *uncertainty),
        flags: vec![0; count],
        center: vec![DVec3::ZERO; count],
        normal: vec![DVec3::Z; count],
        axes: vec![[DVec3::X, DVec3::Y]; count],
        contour: vec![Vec::new(); count],
        half_axes: vec![[DVec3::ZERO; 2]; count],
        inscribed_radius: vec![0.0; count],
        levels: vec![[300.0, 50.0]; count],
        noise: 10.0,
        fwhm: 1.0,
        fwhm_source: Source::Given,
        on_vessel: vec![DVec3::ZERO; count],
    }
}

fn narrowest(sections: &[[f64; 2]]) -> [f64; 2] {
    let spot = profile(sections).narrowest().expect("a place");
    [spot.at, spot.diameter]
}

#[test]
fn a_fit_that_is_not_sure_is_not_suggested() {
    let mut sections = vec![[12.0, 0.8]; 20];
    sections[4..7].fill([10.0, 0.8]);
    // Between the struts of a stent.
    sections[12..15].fill([1.0, 0.8]);
    assert_eq!(narrowest(&sections), [2.0, 10.0]);
}

#[test]
fn a_narrow_lumen_that_is_sure_is_suggested() {
    let mut sections = vec![[6.0, 0.1]; 20];
    sections[12..15].fill([1.0, 0.1]);
    assert_eq!(narrowest(&sections), [6.0, 1.0]);
}

#[test]
fn where_none_is_sure_all_count() {
    let mut sections = vec![[2.0, 0.8]; 9];
    sections[3..6].fill([1.5, 0.8]);
    assert_eq!(narrowest(&sections), [1.5, 1.5]);
    assert!(profile(&[[f64::NAN, f64::NAN]; 4]).narrowest().is_none());
}

/// A vessel of 12 mm that becomes one of 8 mm at a branch 20 mm from its beginning, with a narrowing at 30 mm.
fn branched(sections: usize) -> Profile {
    let width = |n: usize| match n {
        0..40 => 12.0,
        58..63 => 4.0,
        _ => 8.0,
    };
    let mut profile = profile(&(0..sections).map(|n| [width(n), 0.1]).collect::<Vec<_>>());
    profile.flags[38..42].fill(BRANCH);
    profile
}

#[test]
fn no_branch_lies_between_a_place_and_its_reference() {
    let [before, after] = branched(120).suggested_references(30.0).expect("a place on it");
    assert_eq!((before.map(|spot| spot.diameter), after.map(|spot| spot.diameter)), (Some(8.0), Some(8.0)));
    assert!(before.is_some_and(|spot| spot.at > 20.5), "{before:?}");
}

#[test]
fn where_no_reference_lies_before_a_branch_it_is_passed() {
    // The vessel ends behind the narrowing, and the branch is just before it.
    let mut profile = branched(64);
    profile.flags[38..50].fill(BRANCH);
    let [before, after] = profile.suggested_references(30.0).expect("a place on it");
    assert_eq!((before.map(|spot| spot.diameter), after), (Some(12.0), None));
}
