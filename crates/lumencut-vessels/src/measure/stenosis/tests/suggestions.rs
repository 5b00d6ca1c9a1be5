use super::super::hindrances::UNSURE;
use super::super::made_profile::profile;
use super::*;
use crate::measure::section::flags::{
    CALCIUM, METAL, NEIGHBOR, NO_EDGE, OUTSIDE, PLAQUE, RECENTERED, RESTLESS_LINE,
};

fn narrowest(sections: &[[f64; 2]]) -> [f64; 2] {
    let spot = profile(sections).narrowest().expect("a place");
    [spot.at, spot.diameter]
}

#[test]
fn a_fit_that_is_not_sure_is_not_suggested() {
    let mut sections = vec![[12.0, 0.8]; 20];
    sections[4..7].fill([10.0, 0.8]);
    // Fits between the struts of a stent are too narrow.
    sections[12..15].fill([1.0, 0.8]);
    assert_eq!(narrowest(&sections), [2.0, 10.0]);
}

#[test]
fn a_narrower_place_that_is_passed_over_is_known_with_its_hindrances() {
    let mut sections = vec![[12.0, 0.8]; 20];
    sections[4..7].fill([10.0, 0.8]);
    assert_eq!(profile(&sections).passed_over(), None);
    let mut made = profile(&sections);
    for n in 12..15 {
        (made.area[n], made.flags[n]) = (16.0 * std::f64::consts::PI, METAL);
    }
    let (spot, hindrances) = made.passed_over().expect("a place");
    assert_eq!((spot.at, hindrances & METAL), (6.0, METAL));
    assert!((spot.diameter - 8.0).abs() < 1e-9 && made.narrowest().is_some_and(|spot| spot.diameter == 10.0));
}

#[test]
fn a_narrow_lumen_that_is_sure_is_suggested() {
    let mut sections = vec![[6.0, 0.1]; 20];
    sections[12..15].fill([1.0, 0.1]);
    assert_eq!(narrowest(&sections), [6.0, 1.0]);
}

#[test]
fn a_place_beside_bright_plaque_is_suggested_though_it_is_not_sure() {
    let mut made = profile(&[[6.0, 0.1]; 20]);
    for n in 12..15 {
        (made.area[n], made.uncertainty[n], made.flags[n]) = (3.0, 0.8, PLAQUE);
    }
    assert_eq!(made.narrowest().map(|spot| spot.at), Some(6.0));
}

#[test]
fn where_nothing_is_safe_none_is_suggested_and_the_reason_is_known() {
    let mut sections = vec![[2.0, 0.8]; 9];
    sections[3..6].fill([1.5, 0.8]);
    let unsure = profile(&sections);
    assert_eq!((unsure.narrowest(), unsure.none_safe()), (None, Some(UNSURE)));
    let mut stent = profile(&[[8.0, 0.1]; 9]);
    stent.flags.fill(METAL);
    stent.flags[4] = NO_EDGE | NEIGHBOR;
    assert_eq!((stent.narrowest(), stent.none_safe()), (None, Some(METAL | NO_EDGE)));
    stent.flags[7] = 0;
    assert_eq!((stent.narrowest().map(|spot| spot.at), stent.none_safe()), (Some(3.5), None));
    assert!(profile(&[[f64::NAN, f64::NAN]; 4]).narrowest().is_none());
}

#[test]
fn the_narrowest_place_is_never_one_that_is_flagged_or_unsafe() {
    for flags in [METAL, CALCIUM, NO_EDGE, BRANCH, OUTSIDE, RECENTERED, RESTLESS_LINE, NEIGHBOR | IRREGULAR] {
        let mut made = profile(&[[8.0, 0.1]; 120]);
        made.area[40] = 3.0;
        made.flags[40] = flags;
        let spot = made.narrowest().expect("a safe place");
        assert_eq!(spot.diameter, 8.0, "{flags}");
    }
}

/// A vessel of 12 mm that narrows to 8 mm at a branch at 20 mm, and has a stenosis at 35 mm.
fn branched(sections: usize) -> Profile {
    let width = |n: usize| match n {
        0..40 => 12.0,
        68..73 => 4.0,
        _ => 8.0,
    };
    let mut profile = profile(&(0..sections).map(|n| [width(n), 0.1]).collect::<Vec<_>>());
    profile.flags[38..42].fill(BRANCH);
    profile
}

#[test]
fn no_branch_lies_between_a_place_and_its_reference() {
    let [before, after] = branched(120).suggested_references(35.0).expect("a place on it");
    assert_eq!((before.map(|spot| spot.diameter), after.map(|spot| spot.diameter)), (Some(8.0), Some(8.0)));
    assert!(before.is_some_and(|spot| spot.at > 20.5), "{before:?}");
}

#[test]
fn where_no_reference_lies_before_a_branch_it_is_passed() {
    // The vessel ends soon after the narrowing, and the branch lies just before the narrowing.
    let mut profile = branched(74);
    profile.flags[38..60].fill(BRANCH);
    let [before, after] = profile.suggested_references(35.0).expect("a place on it");
    assert_eq!((before.map(|spot| spot.diameter), after), (Some(12.0), None));
}

/// A vessel of 8 mm with a stenosis of 4 mm at 30 mm, and `beyond` mm wide from 45 mm on.
fn stepped(beyond: f64) -> Profile {
    let width = |n: usize| match n {
        58..63 => 4.0,
        0..90 => 8.0,
        _ => beyond,
    };
    profile(&(0..160).map(|n| [width(n), 0.1]).collect::<Vec<_>>())
}

fn diameters(profile: &Profile, at: f64) -> [Option<f64>; 2] {
    profile.suggested_references(at).expect("a place on it").map(|spot| spot.map(|spot| spot.diameter))
}

#[test]
fn no_step_of_the_calibre_lies_between_a_place_and_its_reference() {
    assert_eq!(diameters(&stepped(12.0), 30.0), [Some(8.0), Some(8.0)]);
    // If there is no other place for a reference, the step of the calibre is ignored.
    let mut made = stepped(12.0);
    made.flags[..88].fill(CALCIUM);
    assert_eq!(diameters(&made, 30.0), [None, Some(12.0)]);
}

#[test]
fn no_reference_is_narrower_than_the_place() {
    let made = profile(&(0..120).map(|n| [if n < 60 { 6.0 } else { 4.8 }, 0.1]).collect::<Vec<_>>());
    assert_eq!(diameters(&made, 28.0), [Some(6.0), None]);
}

#[test]
fn no_reference_is_offered_where_something_hinders() {
    for flags in [METAL, CALCIUM, RECENTERED, NEIGHBOR | IRREGULAR] {
        let mut made = stepped(8.0);
        made.flags[..58].fill(flags);
        assert_eq!(diameters(&made, 30.0)[0], None, "{flags}");
    }
}

/// Suggested longest diameter of a vessel that is 9 mm wide at 10 mm, if the section at `at` mm has `flags`.
fn offered(at: f64, flags: u32) -> Option<f64> {
    let mut sections = vec![[8.0, 0.1]; 60];
    sections[20][0] = 9.0;
    let mut profile = profile(&sections);
    profile.flags[(at / 0.5).round() as usize] = flags;
    profile.offered_widest().map(|spot| spot.at)
}

#[test]
fn an_odd_longest_diameter_is_not_offered() {
    for flags in [IRREGULAR, BRANCH, BRANCH | CALCIUM] {
        for at in [9.0, 10.5, 11.0] {
            assert_eq!(offered(at, flags), None, "{flags} at {at} mm");
        }
        assert_eq!((offered(8.5, flags), offered(11.5, flags)), (Some(10.0), Some(10.0)));
    }
    assert_eq!(offered(10.0, IRREGULAR), None);
    assert_eq!(offered(10.0, CALCIUM), Some(10.0));
}

#[test]
fn the_longest_diameter_that_is_not_offered_is_known_all_the_same() {
    let mut odd = profile(&[[8.0, 0.1]; 20]);
    odd.flags[4] = IRREGULAR;
    assert_eq!(odd.widest().map(|spot| spot.at), Some(0.0));
    odd.flags[0] = IRREGULAR;
    assert_eq!((odd.widest().map(|spot| spot.at), odd.offered_widest()), (Some(0.0), None));
    assert_eq!(profile(&[[f64::NAN; 2]; 4]).offered_widest(), None);
}

/// A vessel of 24 mm whose `sections` have this longest and shortest diameter.
fn spiked(longest: f64, shortest: f64, sections: std::ops::Range<usize>) -> Profile {
    let mut profile = profile(&[[24.0, 0.2]; 60]);
    for n in sections {
        profile.diameter_max[n] = longest;
        profile.diameter_min[n] = shortest;
        profile.area[n] = std::f64::consts::PI * longest * shortest / 4.0;
    }
    profile
}

#[test]
fn a_spike_of_the_fit_is_not_offered_as_the_longest_diameter() {
    let spike = spiked(37.43, 24.1, 30..31);
    assert_eq!(spike.widest().map(|spot| spot.diameter), Some(37.43));
    assert_eq!(spike.offered_widest(), None, "the spike has the largest area too");
    let mut beside_wider = spike;
    beside_wider.diameter_max[50] = 33.0;
    beside_wider.diameter_min[50] = 31.0;
    beside_wider.area[50] = 900.0;
    assert_eq!(beside_wider.offered_widest(), Some(Spot { at: 25.0, diameter: 33.0 }));
}

#[test]
fn a_long_lumen_is_offered_where_its_neighbours_agree() {
    assert_eq!(spiked(36.0, 24.0, 25..35).offered_widest().map(|spot| spot.diameter), Some(36.0));
    assert_eq!(spiked(60.0, 24.0, 25..35).offered_widest(), None, "no lumen is so long");
    assert_eq!(spiked(30.0, 24.0, 30..31).offered_widest().map(|spot| spot.diameter), Some(30.0));
}

#[test]
fn the_thin_end_of_a_vessel_is_no_narrowing() {
    let taper: Vec<[f64; 2]> = (0..100).map(|n| [20.0 - 0.13 * f64::from(n), 0.1]).collect();
    let only_thinner = profile(&taper);
    assert_eq!((only_thinner.narrowest(), only_thinner.none_safe()), (None, None));
    assert_eq!(only_thinner.thin_end().map(|spot| spot.at), Some(49.5));
    let mut narrowed = profile(&taper);
    for n in 40..45 {
        narrowed.area[n] = 12.0_f64.powi(2) * std::f64::consts::PI / 4.0;
    }
    let spot = narrowed.narrowest().expect("a narrowing");
    assert_eq!((spot.diameter, narrowed.thin_end()), (12.0, None));
    assert!((20.0..=22.0).contains(&spot.at));
}
