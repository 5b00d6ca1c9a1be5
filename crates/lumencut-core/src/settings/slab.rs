//! The slab: the thickness of the cut surface, and which of the values in it is shown.

use crate::error::Result;
use crate::limits::Limits;
use crate::named::Named;

const THICKNESS: Limits = Limits::new(0.0, 1e3, "mm");

/// The value that a thick cut surface shows, among those along the view direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlabMode {
    /// The largest.
    Max,
    /// The mean.
    Mean,
    /// The smallest.
    Min,
}

impl Named for SlabMode {
    const NAMES: &'static [(&'static str, Self)] =
        &[("max", Self::Max), ("mean", Self::Mean), ("min", Self::Min)];
}

/// A thick cut surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Distance from the slab's near to its far side along the view (mm); the cut surface lies in the middle.
    pub thickness: f64,
    /// Which of the values in the slab is shown.
    pub mode: SlabMode,
}

impl Slab {
    /// Fails with [`crate::error::ErrorKind::Settings`] for a thickness outside its range.
    pub fn check(&self) -> Result<()> {
        THICKNESS.check("slab thickness", self.thickness)
    }
}
