//! The stages of the pipeline, one module each, in the order of the paper's Fig. 4, and the table of them.

pub mod along_rays;
pub mod composite;
pub mod context;
pub mod depth;
pub mod depth_filter;
pub mod distance;
pub mod focus;
pub mod leap;
pub mod levels;
pub mod silhouette;
pub mod surface;
mod table;

pub use table::{Image, ImageSet, Stage};

use crate::error::Result;
use crate::math::lanes::{Isa, ROWS};
use crate::progress::Progress;
use crate::stop::{Stop, go_on};

/// What every stage of one view shares.
#[derive(Clone, Copy)]
pub struct Work<'a> {
    /// The width and height of the view in pixels.
    pub size: [usize; 2],
    /// The instruction set of the kernels; the result does not depend on it.
    pub isa: Isa,
    /// Whether to stop.
    pub stop: Stop<'a>,
    /// Receives the progress of the view.
    pub progress: Option<&'a Progress>,
}

impl Work<'_> {
    /// The number of pixels.
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

    /// Every image of a view has one entry for each of its pixels.
    ///
    /// # Panics
    /// If the caller's buffers are not of this view: a bug, never an input error.
    pub(crate) fn expect_whole<T>(&self, image: Image, pixels: &[T]) {
        let [width, height] = self.size;
        assert_eq!(
            pixels.len(),
            width * height,
            "entries of the image {image:?} of {width} × {height} pixels"
        );
    }
}
