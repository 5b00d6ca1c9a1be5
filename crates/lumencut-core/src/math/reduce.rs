//! What rays are reduced to. The shader follows each ray on its own; on the CPU sixteen are followed together, by
//! `stages/along_rays.rs`.

use super::blocks::HUGE;
use crate::settings::SlabMode;

/// What is kept of the values along a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// The mean, each value weighted with the length that it takes of the ray.
    Mean,
    /// The largest.
    Largest,
    /// The smallest.
    Smallest,
}

impl Reduction {
    /// What a slab shows.
    pub fn of(mode: SlabMode) -> Self {
        match mode {
            SlabMode::Mean => Self::Mean,
            SlabMode::Max => Self::Largest,
            SlabMode::Min => Self::Smallest,
        }
    }

    /// The number by which the shaders know it.
    pub const fn code(self) -> u32 {
        self as u32
    }

    /// A limit that no value reaches.
    pub fn no_limit(self) -> f32 {
        if self == Self::Smallest { -HUGE } else { HUGE }
    }
}
