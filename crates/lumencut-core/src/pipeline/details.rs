//! Further images of a cut surface, for validation.

use super::images::Images;
use super::pass::{CutSurfacePass, Lines};
use crate::error::Result;
use crate::stages::depth::Sheet;
use crate::stages::{Image, ImageSet, Stage};

/// Images of a cut surface that no frame has.
#[derive(Clone, Debug)]
pub struct SurfaceDetails {
    /// Slopes, radius and blend in each pixel.
    pub sheet: Vec<Sheet>,
    /// Bits that mark depth jumps ([`crate::stages::leap`]).
    pub leap: Vec<u32>,
    /// The strength of the silhouettes, 0 to 1.
    pub strength: Vec<f32>,
}

impl SurfaceDetails {
    pub(super) const WANTED: ImageSet = ImageSet::of(&[Image::Sheet, Image::Leap]);

    pub(super) fn of(pass: &CutSurfacePass) -> Result<Self> {
        let (settings, mut images) = (pass.settings, Images::default());
        for stage in Stage::of_cut_surface(settings, Self::WANTED) {
            pass.run(stage, &mut images)?;
        }
        let Images { unfiltered_depth, depth, vessel, leap, sheet, .. } = images;
        let depth = if depth.is_empty() { unfiltered_depth } else { depth };
        let lines = Lines { depth: &depth, vessel: &vessel, leap: &leap, value: &[] };
        let strength = lines.strength(&pass.work, settings, pass.surface.camera())?;
        Ok(Self { sheet, leap, strength })
    }
}
