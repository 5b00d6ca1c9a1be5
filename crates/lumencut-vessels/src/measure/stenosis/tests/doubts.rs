use super::made_profile::profile;
use super::*;
use crate::measure::section::flags::{CALCIUM, METAL, NO_EDGE};

fn flagged(flags: &[(f64, u32)]) -> Profile {
    let mut made = profile(&[[4.0, 0.1]; 61]);
    for (at, flags) in flags {
        made.flags[(at / 0.5).round() as usize] |= flags;
    }
    made
}

#[test]
fn the_flags_are_those_of_all_places_that_are_compared() {
    let made = flagged(&[(10.0, CALCIUM), (20.0, METAL), (15.0, METAL)]);
    assert_eq!(made.doubts(5.0, Method::Nascet, &[25.0]), Doubts::default());
    assert_eq!(made.doubts(10.2, Method::Nascet, &[25.0]).flags, CALCIUM);
    assert_eq!(made.doubts(10.0, Method::Nascet, &[20.1, 25.0]).flags, CALCIUM | METAL);
    assert_eq!(made.doubts(20.0, Method::Nascet, &[]), Doubts { flags: METAL, is_branch_between: false });
}

#[test]
fn a_reference_has_the_flags_of_all_sections_of_its_median() {
    let made = flagged(&[(11.5, METAL), (8.0, CALCIUM), (9.0, NO_EDGE)]);
    assert_eq!(made.doubts(25.0, Method::Nascet, &[10.0]).flags, METAL, "only sections that count are used");
    assert_eq!(made.doubts(10.0, Method::Nascet, &[25.0]).flags, 0, "the narrowest place is one section");
}

#[test]
fn a_branch_counts_between_the_place_and_a_reference_alone() {
    let between =
        |at: f64| flagged(&[(at, BRANCH)]).doubts(15.0, Method::Nascet, &[10.0, 20.0]).is_branch_between;
    assert!(between(10.5) && between(14.5) && between(15.5) && between(19.5));
    assert!(!between(9.5) && !between(20.5));
    // A branch at a used place is reported by its flag.
    for at in [10.0, 15.0, 20.0] {
        let doubts = flagged(&[(at, BRANCH)]).doubts(15.0, Method::Nascet, &[10.0, 20.0]);
        assert_eq!(doubts, Doubts { flags: BRANCH, is_branch_between: false });
    }
}

#[test]
fn ecst_is_not_doubtful_for_references_that_it_does_not_use() {
    let made = flagged(&[(10.0, CALCIUM), (12.0, BRANCH)]);
    let compared = Compared { reference: vec![10.0], original: Some(6.0), comparison: None };
    let ecst = made.stenosis(15.0, Method::Ecst, &compared).expect("a stenosis");
    assert_eq!(ecst.doubts, Doubts::default());
    let area = made.stenosis(15.0, Method::Area, &compared).expect("a stenosis");
    assert_eq!(area.doubts, Doubts { flags: CALCIUM, is_branch_between: true });
}

#[test]
fn a_section_that_does_not_count_tells_nothing_between_it_and_one_that_does() {
    let mut made = flagged(&[(10.0, NO_EDGE)]);
    made.area[20] *= 4.0;
    made.uncertainty[20] = 2.8;
    assert_eq!(made.diameter_at(9.9).expect("a diameter"), (4.0, 0.1));
    assert_eq!(made.diameter_at(10.4).expect("a diameter"), (4.0, 0.1));
    // A place at a section uses only the values of that section.
    assert_eq!(made.diameter_at(10.0).expect("a diameter"), (8.0, 2.8));
    assert_eq!(made.doubts(9.9, Method::Nascet, &[]).flags, NO_EDGE);
}
