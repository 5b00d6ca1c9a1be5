//! Vessel colours for dark backgrounds, after Okabe and Ito. Yellow, orange and red are omitted, since they mark warnings.

/// Colours with their names, in the order in which vessels get them.
pub(crate) const PALETTE: [(&str, &str); 12] = [
    ("#56b4e9", "sky blue"),
    ("#cc79a7", "pink"),
    ("#00b98a", "green"),
    ("#b18cff", "violet"),
    ("#8fdc6a", "light green"),
    ("#ffa6dc", "rose"),
    ("#3f6fe0", "blue"),
    ("#8ff0e8", "turquoise"),
    ("#c44df0", "purple"),
    ("#2f8f9f", "teal"),
    ("#9aa8b6", "grey"),
    ("#ffffff", "white"),
];

pub(crate) fn next_color(taken: &[&str]) -> &'static str {
    let count = |color: &&str| taken.iter().filter(|taken| *taken == color).count();
    PALETTE.map(|(color, _)| color).into_iter().min_by_key(count).unwrap_or(PALETTE[0].0)
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
        assert_eq!(taken[..PALETTE.len()], PALETTE.map(|(color, _)| color));
        assert_eq!(taken[PALETTE.len()], taken[0]);
    }

    #[test]
    fn a_color_that_no_vessel_has_any_longer_is_free_again() {
        assert_eq!(next_color(&[PALETTE[0].0, PALETTE[2].0]), PALETTE[1].0);
        assert_eq!(next_color(&["#123456"]), PALETTE[0].0);
    }

    /// Red, green and blue (0 to 1).
    fn rgb(color: &str) -> [f64; 3] {
        [1, 3, 5].map(|n| f64::from(u8::from_str_radix(&color[n..n + 2], 16).expect("hexadecimal")) / 255.0)
    }

    #[test]
    fn no_color_is_one_that_warns_and_all_are_told_apart() {
        for (n, (color, _)) in PALETTE.iter().enumerate() {
            let [red, green, blue] = rgb(color);
            // In yellow, orange and red, blue is low relative to red.
            assert!(blue > 0.6 * red, "{color}");
            for (other, _) in &PALETTE[..n] {
                let apart: f64 =
                    rgb(other).iter().zip([red, green, blue]).map(|(a, b)| (a - b).powi(2)).sum();
                assert!(apart.sqrt() > 0.25, "{color} and {other}");
            }
        }
    }
}
