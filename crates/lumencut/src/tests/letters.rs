//! Tests of the letters of directions and of the edges of pictures.

use glam::DVec3;

use super::{EdgeLetters, grid_letters, nearest_axes, sides};

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

#[test]
fn each_axis_of_the_patient_has_one_axis_of_a_grid() {
    let known = [
        ([DVec3::X, DVec3::Y, DVec3::Z], "LPS"),
        ([DVec3::NEG_Y * 2.0, DVec3::Z * 0.5, DVec3::X], "ASL"),
        // Two of these directions point mainly to the right.
        (
            [DVec3::new(-0.24, 0.80, -0.55), DVec3::new(-0.63, -0.56, -0.53), DVec3::new(-0.73, 0.22, 0.64)],
            "PRS",
        ),
    ];
    for (directions, letters) in known {
        let letters: String = letters.to_owned();
        assert_eq!(grid_letters(directions), letters);
    }
}

#[test]
fn no_other_axes_of_the_same_handedness_are_nearer() {
    for n in 0..100 {
        let n = f64::from(n);
        let first = DVec3::new((1.3 * n).sin(), (0.7 * n).cos(), (2.1 * n).sin()).normalize();
        let second = first.any_orthonormal_vector();
        for third in [first.cross(second), second.cross(first)] {
            let [a, b, c] = nearest_axes([first, second, third]);
            assert_eq!(a.cross(b).dot(c).signum(), first.cross(second).dot(third).signum());
            let near = a.dot(first) + b.dot(second) + c.dot(third);
            for swapped in [
                [b, a, -c],
                [a, c, -b],
                [c, b, -a],
                [-a, -b, c],
                [-a, b, -c],
                [a, -b, -c],
                [b, c, a],
                [c, a, b],
            ] {
                let other = swapped[0].dot(first) + swapped[1].dot(second) + swapped[2].dot(third);
                assert!(near >= other - 1e-5, "{first}");
            }
        }
    }
}
