//! What is found of a second lumen behind a flap.

use std::f64::consts::PI;

use glam::DVec3;

/// Whether both lumens of a dissected vessel are visible in a section, or why not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flap {
    /// Both lumens are visible.
    Seen,
    /// No flap parts the lumen.
    Absent,
    /// Metal hides it.
    Metal,
    /// A lumen is not enclosed by a wall, or not within reach.
    Open,
    /// A lumen is partly dim, so that its edge is in doubt.
    Dim,
    /// The lumens are not similar over 10 mm.
    Uneven,
    /// Nothing says which values a flap has.
    NoLevel,
}

impl Flap {
    /// All cases; their order is that of stored numbers.
    pub const ALL: [Self; 7] =
        [Self::Seen, Self::Absent, Self::Metal, Self::Open, Self::Dim, Self::Uneven, Self::NoLevel];
}

/// The lumen in which the line lies, and the other one behind the flap.
#[derive(Clone, Debug)]
pub(crate) struct LumenPair {
    pub found: Flap,
    /// Points of both contours (mm, LPS); empty if they are not visible.
    pub contours: [Vec<DVec3>; 2],
    /// Areas of both lumens, each with its standard deviation (mm²).
    pub areas: [[f64; 2]; 2],
}

impl LumenPair {
    pub(crate) fn none(found: Flap) -> Self {
        Self { found, contours: Default::default(), areas: [[f64::NAN; 2]; 2] }
    }

    pub(super) fn other_moves(&self, next: &Self) -> f64 {
        let [here, there] = [self, next].map(|pair| {
            let corners = &pair.contours[1];
            corners.iter().sum::<DVec3>() / corners.len().max(1) as f64
        });
        here.distance(there)
    }

    pub(super) fn other_diameter(&self) -> f64 {
        2.0 * (self.areas[1][0] / PI).sqrt()
    }
}
