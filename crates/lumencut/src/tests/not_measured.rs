//! Tests of messages about unmeasured stretches.

use super::*;
use crate::tube::tube;

#[test]
fn a_vessel_that_has_a_wall_everywhere_tells_nothing() {
    assert_eq!(not_measured(&tube()), []);
}

/// The 60 mm tube, unmeasured outside these places (mm).
fn measured_within([low, high]: [f64; 2]) -> Profile {
    let mut profile = tube();
    for (area, at) in profile.area.iter_mut().zip(&profile.arc_length) {
        if *at < low || *at > high {
            *area = f64::NAN;
        }
    }
    profile
}

#[test]
fn both_ends_are_told_with_the_place_to_cut() {
    let profile = Profile { without_wall: vec![[42.0, 60.0]], ..measured_within([12.0, 40.0]) };
    let [before, behind] = &not_measured(&profile)[..] else { panic!("both ends") };
    assert_eq!(before.words, "Not measured up to 12 mm: no wall was found there.");
    assert_eq!(
        behind.words,
        "Not measured from 40 mm on: the vessel is as bright as its surroundings there."
    );
    assert_eq!([before.cut_mm, behind.cut_mm], [12.0, 40.0]);
    assert_eq!([behind.from_mm, behind.to_mm], [40.0, 60.0]);
}

#[test]
fn an_end_whose_lumen_is_much_darker_says_so_and_how_to_measure_it() {
    let mut profile = measured_within([20.0, 60.0]);
    for (n, at) in profile.arc_length.clone().into_iter().enumerate() {
        profile.line_values[n] = if at < 20.0 { 120.0 } else { 300.0 };
    }
    let [part] = &not_measured(&profile)[..] else { panic!("one end") };
    assert_eq!(
        part.words,
        "Not measured up to 20 mm: the lumen is much darker there, about 120 instead of 300. Cut the vessel there to measure both parts."
    );
    // A value of the surroundings is no darker lumen.
    profile.line_values[..40].fill(55.0);
    assert_eq!(not_measured(&profile)[0].words, "Not measured up to 20 mm: no wall was found there.");
}

#[test]
fn short_ends_are_not_told() {
    assert_eq!(not_measured(&measured_within([5.0, 55.0])), []);
}
