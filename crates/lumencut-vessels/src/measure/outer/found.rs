//! What is found of the outer wall of a section.

use glam::DVec3;

/// Whether the outside of a thick wall is visible in a section, or why not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OuterWall {
    /// It is visible.
    Seen,
    /// No thick layer surrounds the lumen.
    Thin,
    /// The lumen of this section does not count.
    NotCounted,
    /// Metal hides the layer.
    Metal,
    /// Tissue as bright as the layer touches too much of it.
    Hidden,
    /// It is not similar over 5 mm.
    Uneven,
    /// Nothing says which values thrombus has.
    NoLevel,
}

impl OuterWall {
    /// All cases; their order is that of stored numbers.
    pub const ALL: [Self; 7] =
        [Self::Seen, Self::Thin, Self::NotCounted, Self::Metal, Self::Hidden, Self::Uneven, Self::NoLevel];
}

/// The outer wall of one section.
#[derive(Clone, Debug)]
pub(crate) struct Outer {
    pub found: OuterWall,
    /// Points of the outer wall (mm, LPS), one per ray; empty if it is not seen.
    pub contour: Vec<DVec3>,
    /// Diameter of a circle of the area within the outer wall, and its standard deviation (mm).
    pub diameter: [f64; 2],
}

impl Outer {
    pub(crate) fn none(found: OuterWall) -> Self {
        Self { found, contour: Vec::new(), diameter: [f64::NAN; 2] }
    }
}
