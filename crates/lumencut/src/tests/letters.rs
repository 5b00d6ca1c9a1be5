//! The letters of directions and of the edges of pictures.

use glam::DVec3;

use super::{EdgeLetters, sides};

#[test]
fn the_strongest_side_comes_first_and_small_parts_are_not_named() {
    let named = [
        ([1.0, 0.0, 0.0], "L"),
        ([-2.0, 0.0, 0.0], "R"),
        ([0.0, 3.0, 0.0], "P"),
        ([0.0, -1.0, 0.0], "A"),
        ([0.0, 0.0, 9.0], "S"),
        ([0.0, 0.0, -1.0], "I"),
        ([0.6, -0.8, 0.0], "AL"),
        ([-3.0, 1.0, 2.0], "RSP"),
        ([1.0, 0.19, 0.0], "L"),
        ([1.0, 0.21, 0.0], "LP"),
        ([0.0, 0.0, 0.0], ""),
    ];
    for (direction, letters) in named {
        assert_eq!(sides(DVec3::from_array(direction)), letters, "{direction:?}");
    }
}

#[test]
fn the_order_of_equal_parts_does_not_depend_on_rounding() {
    for away in [-1e-9, 0.0, 1e-9] {
        assert_eq!(sides(DVec3::new(1.0, 1.0 + away, 1.0 - away)), "LPS");
    }
}

#[test]
fn a_picture_from_the_front_has_the_left_of_the_patient_on_the_right() {
    let found = EdgeLetters::new(DVec3::X, DVec3::NEG_Z);
    assert_eq!([found.left, found.right, found.top, found.bottom], ["R", "L", "S", "I"]);
}
