use super::*;
use crate::tube::tube;
use lumencut_vessels::measure::flags::{CALCIUM, METAL};

#[test]
fn where_places_are_suggested_or_marked_there_is_no_reason() {
    let tube = tube();
    assert_eq!(not_suggested(&tube, None, &[]), Vec::<String>::new());
    assert_eq!(not_suggested(&tube, Some(30.0), &[45.0]), Vec::<String>::new());
}

#[test]
fn where_nothing_is_safe_the_hindrances_are_told() {
    let mut stent = tube();
    stent.flags.fill(METAL);
    stent.flags[7] = CALCIUM;
    stent.uncertainty[9] = 20.0;
    let [reason] = &not_suggested(&stent, None, &[])[..] else { panic!("one reason") };
    // A branch is no more there: all flags were written over.
    assert_eq!(
        reason,
        "No narrowest place is suggested, as no section is safe: calcium, metal, unsure diameter. Mark the place yourself."
    );
    // A place that is marked has no reference then.
    let [reason] = &not_suggested(&stent, Some(30.0), &[])[..] else { panic!("one reason") };
    assert!(reason.starts_with("No reference is suggested for 30.0 mm: no place within 50 mm"), "{reason}");
}

#[test]
fn each_hindrance_has_a_word() {
    assert_eq!(of_hindrances(METAL | CHANGE_OF_LUMEN | FLAP), ["metal", "change of lumen", "flap"]);
    assert_eq!(of_hindrances(0), Vec::<String>::new());
}
