//! What is told of stretches that were not measured.

use super::*;
use crate::tube::tube;

#[test]
fn a_vessel_that_has_a_wall_everywhere_tells_nothing() {
    assert_eq!(not_measured(&tube()), []);
}

#[test]
fn both_ends_are_told_with_the_place_to_cut() {
    let profile = Profile { without_wall: vec![[0.0, 9.5], [40.0, 60.0]], ..tube() };
    let [before, behind] = &not_measured(&profile)[..] else { panic!("both ends") };
    assert_eq!(before.words, "Not measured up to 10 mm: the vessel is as bright as its surroundings there.");
    assert_eq!(
        behind.words,
        "Not measured from 40 mm on: the vessel is as bright as its surroundings there."
    );
    assert_eq!([before.cut_mm, behind.cut_mm], [9.5, 40.0]);
}
