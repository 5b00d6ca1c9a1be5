//! What else is known of a cut surface, for those who judge it.

use super::pass::Lines;
use super::{CpuRenderer, Images, Request};
use crate::error::Result;
use crate::scene::LeveledTree;
use crate::stages::depth::Sheet;
use crate::stages::{Image, ImageSet, Stage};

/// Images of a cut surface that no frame has.
#[derive(Clone, Debug)]
pub struct SurfaceDetails {
    /// Slopes, radius and blend in each pixel.
    pub sheet: Vec<Sheet>,
    /// Where the surface leaps ([`crate::stages::leap`]).
    pub leap: Vec<u32>,
    /// The strength of the silhouettes, 0 to 1.
    pub strength: Vec<f32>,
}

impl CpuRenderer {
    /// The details of the cut surface of one view; of the request the images do not count.
    ///
    /// # Errors
    /// As [`CpuRenderer::render`].
    pub fn details(&mut self, tree: &LeveledTree, request: &Request) -> Result<SurfaceDetails> {
        let &Request { camera, settings, .. } = request;
        settings.check()?;
        let wanted = ImageSet::of(&[Image::Sheet, Image::Leap]);
        let request = Request { images: wanted, ..*request };
        self.prepare(tree, settings);
        self.project(camera, settings);
        let (pass, mut images) = (self.pass(&request), Images::default());
        for stage in Stage::of_cut_surface(settings, wanted) {
            pass.run(stage, &mut images)?;
        }
        let Images { unfiltered_depth, depth, vessel, leap, sheet, .. } = images;
        let depth = if depth.is_empty() { unfiltered_depth } else { depth };
        let lines = Lines { depth: &depth, vessel: &vessel, leap: &leap };
        let strength = lines.strength(&pass.work, settings, camera)?;
        Ok(SurfaceDetails { sheet, leap, strength })
    }
}
