use super::super::flags::CALCIUM;
use super::super::made_profile::profile;
use super::*;

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

/// A vessel of 12 mm that becomes one of 8 mm at a branch 20 mm from its beginning, with a narrowing at 35 mm.
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
    // The vessel ends behind the narrowing, and the branch is just before it.
    let mut profile = branched(74);
    profile.flags[38..60].fill(BRANCH);
    let [before, after] = profile.suggested_references(35.0).expect("a place on it");
    assert_eq!((before.map(|spot| spot.diameter), after), (Some(12.0), None));
}

/// The place of the longest diameter that is offered, where that of 9 mm is at 10 mm and a section at `at` mm has `flags`.
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
        // Farther away it tells nothing.
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
