//! The stages of the pipeline, one room each, in the order of the paper's Fig. 4.

pub mod composite;
pub mod context;
pub mod depth;
pub mod depth_filter;
pub mod distance;
pub mod levels;
pub mod silhouette;
pub mod surface;

use crate::camera::Camera;
use crate::error::{Error, Result};
use crate::math::lanes::{Isa, ROWS};

/// Asked between rows of tiles, from any thread, whether to stop.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// What every stage of one view shares.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// The view.
    pub camera: &'a Camera,
    /// The instruction set of the kernels; the result does not depend on it.
    pub isa: Isa,
    /// Whether to stop.
    pub stop: Stop<'a>,
}

impl View<'_> {
    /// The width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.camera.size()
    }

    /// The pixels of one row of tiles.
    pub fn tile_row(&self) -> usize {
        ROWS * self.camera.size()[0]
    }

    /// An error where the caller asks to stop.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Interrupted`].
    pub fn go_on(&self) -> Result<()> {
        if (self.stop)() { Err(Error::interrupted()) } else { Ok(()) }
    }
}
