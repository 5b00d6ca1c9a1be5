//! Captions that explain what the rows and columns of a reformation show.

use crate::text::{fixed, rounded};

/// A reformation whose axes are explained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axes {
    /// The untangled CPR.
    Untangled,
    /// The network map.
    Network,
    /// A vessel straightened by an amount from 0 (as it is) to 1 (straight).
    Uncurled(f64),
    /// The spiral CPR, sampled at even arc lengths; the number is the pitch (mm).
    SpiralByArc(f64),
    /// The spiral CPR, sampled at even angles.
    SpiralByAngle,
    /// The lumen map; the number is the radius (mm) at which the width of its columns is true to scale.
    Map(f64),
    /// The endoscopy; the number is the place of the eye (mm).
    Inside(f64),
}

impl Axes {
    /// The caption.
    pub fn words(self) -> String {
        match self {
            Self::Untangled => {
                "Along each vessel: its length, in mm. Across it: to its sides, in mm. Branches are spread apart: angles between vessels differ from those in the body."
                    .to_owned()
            }
            Self::Network => {
                "Along each vessel: its length, in mm. Across it: its diameter. Branches are spread apart: angles between vessels differ from those in the body."
                    .to_owned()
            }
            Self::Uncurled(amount) => format!(
                "The vessel as the camera sees it, straightened by {} %; its length is kept.",
                fixed(100.0 * amount, 0)
            ),
            Self::SpiralByArc(pitch) => format!(
                "Down: along the vessel, in mm. Across: each section, unrolled along a spiral; width = area / {} mm.",
                rounded(pitch, 3)
            ),
            Self::SpiralByAngle => {
                "Down: along the vessel, in mm. Across: each section, unrolled along a spiral at even angles; width is not area."
                    .to_owned()
            }
            Self::Map(radius) => format!(
                "Down: along the vessel, in mm. Across: once around the wall, true to scale {} mm from the centre.",
                fixed(radius, 1)
            ),
            Self::Inside(at) => format!(
                "From inside the vessel, {} mm from its start; white: calcium or metal. Sizes are not to scale.",
                fixed(at, 1)
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Axes;

    #[test]
    fn numbers_stand_in_the_words_as_readers_write_them() {
        assert!(Axes::Uncurled(0.25).words().contains("straightened by 25 %"));
        assert!(Axes::SpiralByArc(1.25).words().ends_with("width = area / 1.25 mm."));
        assert!(Axes::Inside(41.26).words().contains("41.3 mm from its start"));
        assert!(Axes::Map(6.0).words().contains("true to scale 6.0 mm from"));
    }
}
