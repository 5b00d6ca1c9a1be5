//! Colour maps for measured values, such as radius and thickness.

use lumencut_core::named::Named;

/// Viridis at even steps, by Nathaniel Smith and Stéfan van der Walt, public domain (CC0). Its lightness rises evenly, so that it
/// works in grey and for colour-blind readers.
const VIRIDIS: [[u8; 3]; 10] = [
    [68, 1, 84],
    [72, 40, 120],
    [62, 74, 137],
    [49, 104, 142],
    [38, 130, 142],
    [31, 158, 137],
    [53, 183, 121],
    [109, 205, 89],
    [180, 222, 44],
    [253, 231, 37],
];

const GREYS: [[u8; 3]; 2] = [[0; 3], [255; 3]];

/// From dark blue over green to pale green, in even steps of lightness. It has no yellow, the colour of silhouettes.
const SEA: [[u8; 3]; 6] =
    [[65, 61, 123], [55, 101, 158], [52, 143, 167], [64, 183, 173], [139, 218, 178], [222, 245, 229]];

/// From blue over light grey to red, a pair that colour-blind readers can tell apart; the middle is zero.
const BLUE_RED: [[u8; 3]; 5] =
    [[0, 90, 181], [120, 172, 226], [225, 225, 225], [233, 145, 128], [220, 50, 32]];

/// A colour map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// From dark blue over green to yellow.
    Viridis,
    /// From black to white.
    Grey,
    /// From dark blue to pale green, without yellow.
    Sea,
    /// From blue over grey to red.
    BlueRed,
}

impl Named for Colours {
    const NAMES: &'static [(&'static str, Self)] =
        &[("viridis", Self::Viridis), ("grey", Self::Grey), ("sea", Self::Sea), ("blue-red", Self::BlueRed)];
}

impl Colours {
    pub(crate) fn table(self) -> &'static [[u8; 3]] {
        match self {
            Self::Viridis => &VIRIDIS,
            Self::Grey => &GREYS,
            Self::Sea => &SEA,
            Self::BlueRed => &BLUE_RED,
        }
    }
}

/// RGBA colours of values between `low` and `high`, clamped; transparent if not finite.
pub fn coloured(values: &[f32], [low, high]: [f64; 2], colours: Colours) -> Vec<[u8; 4]> {
    let table = colours.table();
    let last = (table.len() - 1) as f64;
    let colour = |value: &f32| {
        if !value.is_finite() {
            return [0; 4];
        }
        let share = ((f64::from(*value) - low) / (high - low)).clamp(0.0, 1.0) * last;
        let before = (share as usize).min(table.len() - 2);
        let [from, to] = [table[before], table[before + 1]];
        let part = share - before as f64;
        let channel =
            |n: usize| (f64::from(from[n]) + part * (f64::from(to[n]) - f64::from(from[n]))).round() as u8;
        [channel(0), channel(1), channel(2), 255]
    };
    values.iter().map(colour).collect()
}

/// The upper end of a colour scale of lengths (mm): the largest length, rounded up to a multiple of 0.5 mm, at least 0.5 mm.
pub fn scale_end(values: &[f32]) -> f64 {
    let largest = values.iter().copied().filter(|value| value.is_finite()).fold(0.0, f32::max);
    ((f64::from(largest) * 2.0).ceil() / 2.0).max(0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_run_from_the_first_colour_to_the_last_and_what_is_none_is_transparent() {
        let shown = coloured(&[1.0, 3.0, 9.0, 2.0, f32::NAN], [1.0, 3.0], Colours::Viridis);
        assert_eq!(shown[0], [68, 1, 84, 255]);
        assert_eq!((shown[1], shown[2]), ([253, 231, 37, 255], [253, 231, 37, 255]));
        // With ten colours, the middle is half way between the fifth and the sixth.
        assert_eq!(shown[3], [35, 144, 140, 255]);
        assert_eq!(shown[4], [0; 4]);
        assert_eq!(coloured(&[0.5], [0.0, 1.0], Colours::Grey), [[128, 128, 128, 255]]);
    }

    #[test]
    fn a_scale_ends_at_half_a_millimetre() {
        assert_eq!(scale_end(&[3.2, f32::NAN, 1.0]), 3.5);
        assert_eq!(scale_end(&[]), 0.5);
    }
}
