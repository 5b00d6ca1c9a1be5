//! The colours of vessels: those of Okabe and Ito that stand out on a dark picture, told apart also by the colour-blind.

use serde::Serialize;

/// A colour that a vessel can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct NamedColor {
    /// `#rrggbb`.
    pub color: &'static str,
    /// What it is called.
    pub words: &'static str,
}

const fn named(color: &'static str, words: &'static str) -> NamedColor {
    NamedColor { color, words }
}

/// The colours that vessels get, in this order.
pub const PALETTE: [NamedColor; 8] = [
    named("#f0e442", "yellow"),
    named("#56b4e9", "sky blue"),
    named("#cc79a7", "pink"),
    named("#00b98a", "green"),
    named("#ffffff", "white"),
    named("#d5763f", "copper"),
    named("#5b8ff9", "blue"),
    named("#b8b06a", "olive"),
];

/// The colour of the palette that the fewest vessels have, the first of several such.
pub fn next_color(taken: &[&str]) -> &'static str {
    let count = |named: &&NamedColor| taken.iter().filter(|color| **color == named.color).count();
    PALETTE.iter().min_by_key(count).map_or(PALETTE[0].color, |named| named.color)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_differ_as_long_as_there_are_some_and_then_the_first_comes_again() {
        let mut taken: Vec<&str> = Vec::new();
        for _ in 0..=PALETTE.len() {
            taken.push(next_color(&taken));
        }
        assert_eq!(taken[..PALETTE.len()], PALETTE.map(|named| named.color));
        assert_eq!(taken[PALETTE.len()], taken[0]);
    }

    #[test]
    fn a_color_that_no_vessel_has_any_longer_is_free_again() {
        let all: Vec<&str> = PALETTE.iter().map(|named| named.color).collect();
        assert_eq!(next_color(&[all[0], all[2]]), all[1]);
        assert_eq!(next_color(&["#123456"]), all[0]);
    }
}
