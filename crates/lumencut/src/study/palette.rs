//! The colours of vessels: those of Okabe and Ito that stand out on a dark picture, told apart also by the colour-blind.

/// The colours that vessels get, in this order. Hosts name them in their own words.
pub const PALETTE: [&str; 8] =
    ["#f0e442", "#56b4e9", "#cc79a7", "#00b98a", "#ffffff", "#d5763f", "#5b8ff9", "#b8b06a"];

/// The colour of the palette that the fewest vessels have, the first of several such.
pub fn next_color(taken: &[&str]) -> &'static str {
    let count = |color: &&str| taken.iter().filter(|taken| *taken == color).count();
    PALETTE.into_iter().min_by_key(count).unwrap_or(PALETTE[0])
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
        assert_eq!(taken[..PALETTE.len()], PALETTE);
        assert_eq!(taken[PALETTE.len()], taken[0]);
    }

    #[test]
    fn a_color_that_no_vessel_has_any_longer_is_free_again() {
        assert_eq!(next_color(&[PALETTE[0], PALETTE[2]]), PALETTE[1]);
        assert_eq!(next_color(&["#123456"]), PALETTE[0]);
    }
}
