//! The reduction of the values along rays. Shaders follow one ray at a time, the CPU sixteen
//! (`stages/along_rays.rs`).

use super::blocks::HUGE;
use crate::settings::SlabMode;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// The mean, weighted by length along the ray.
    Mean,
    /// The largest.
    Largest,
    /// The smallest.
    Smallest,
}

impl Reduction {
    pub fn of(mode: SlabMode) -> Self {
        match mode {
            SlabMode::Mean => Self::Mean,
            SlabMode::Max => Self::Largest,
            SlabMode::Min => Self::Smallest,
        }
    }

    pub const fn code(self) -> u32 {
        self as u32
    }

    pub(crate) fn no_limit(self) -> f32 {
        if self == Self::Smallest { -HUGE } else { HUGE }
    }
}
