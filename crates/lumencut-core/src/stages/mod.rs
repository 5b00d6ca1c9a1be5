//! The stages of the pipeline, one module each, in the order of the paper's Fig. 4, and the table of them. Hidden
//! modules are public only for the other crates of this workspace.

#[doc(hidden)]
pub mod along_rays;
#[doc(hidden)]
pub mod body;
#[doc(hidden)]
pub mod composite;
#[doc(hidden)]
pub mod context;
#[doc(hidden)]
pub mod depth;
#[doc(hidden)]
pub mod depth_filter;
#[doc(hidden)]
pub mod distance;
#[doc(hidden)]
pub mod far_rim;
#[doc(hidden)]
pub mod focus;
#[doc(hidden)]
pub mod leap;
#[doc(hidden)]
pub mod levels;
#[doc(hidden)]
pub mod occlusion;
#[doc(hidden)]
pub mod rim;
#[doc(hidden)]
pub mod silhouette;
#[doc(hidden)]
pub mod steady;
#[doc(hidden)]
pub mod surface;
mod table;
#[doc(hidden)]
pub use table::{Image, ImageSet, Stage};

use crate::error::Result;
use crate::math::lanes::{Isa, ROWS};
use crate::progress::Progress;
use crate::stop::{Stop, go_on};

/// The common input of all stages of one view.
#[derive(Clone, Copy)]
#[doc(hidden)]
pub struct Work<'a> {
    pub size: [usize; 2],
    /// The instruction set of the kernels; the result does not depend on it.
    pub isa: Isa,
    pub stop: Stop<'a>,
    pub progress: Option<&'a Progress>,
}

impl Work<'_> {
    pub fn pixels(&self) -> usize {
        self.size[0] * self.size[1]
    }

    pub(crate) fn tile_row(&self) -> usize {
        ROWS * self.size[0]
    }

    /// Begins this number of pixels, unless the caller asks to stop.
    pub fn begin(&self, pixels: usize) -> Result<()> {
        if let Some(progress) = self.progress {
            progress.begin_pixels(pixels);
        }
        go_on(self.stop)
    }

    /// Panics unless the image has one entry for each pixel of the view.
    pub(crate) fn expect_whole<T>(&self, image: Image, pixels: &[T]) {
        let [width, height] = self.size;
        assert_eq!(
            pixels.len(),
            width * height,
            "entries of the image {image:?} of {width} × {height} pixels"
        );
    }
}
