//! Tests of the length, label and pixels of scale bars.

use super::ScaleBar;

#[test]
fn a_bar_is_the_longest_length_that_fits_a_quarter_of_the_width() {
    let rooms = [1.0, 1.99, 2.0, 4.9, 5.0, 9.9, 10.0, 75.0, 199.0, 200.0, 0.3, 0.0021];
    let lengths = [1.0, 1.0, 2.0, 2.0, 5.0, 5.0, 10.0, 50.0, 100.0, 200.0, 0.2, 0.002];
    for (room, length) in rooms.into_iter().zip(lengths) {
        assert_eq!(ScaleBar::new(4.0 * room, 1.0).expect("a bar").length, length, "{room} mm");
    }
}

#[test]
fn a_bar_says_its_length_and_has_as_many_pixels() {
    let bar = ScaleBar::new(640.0, 0.4).expect("a bar");
    assert_eq!((bar.length, bar.words.as_str(), bar.pixels), (50.0, "50 mm", 50.0 / 0.4));
    let fine = ScaleBar::new(400.0, 0.007).expect("a bar");
    assert_eq!((fine.length, fine.words.as_str(), fine.pixels), (0.5, "0.5 mm", 0.5 / 0.007));
}

#[test]
fn a_picture_without_a_width_has_no_bar() {
    for (width, spacing) in [(0.0, 1.0), (10.0, 0.0), (f64::NAN, 1.0), (f64::INFINITY, 1.0)] {
        assert_eq!(ScaleBar::new(width, spacing), None);
    }
}
