//! Position of every pixel in world space, independent of the method that found it.

use glam::{DVec3, Vec3};

use crate::camera::Camera;
use crate::error::{Error, ErrorKind, Result};

/// Position of every pixel in world space.
#[derive(Clone, Debug)]
pub enum Geometry {
    /// Positions on the rays of an orthographic camera.
    Orthographic {
        /// The view.
        camera: Camera,
        /// Depth of the cut surface in each pixel (mm); if empty, every ray crosses the entire volume.
        depth: Vec<f32>,
    },
    /// One position per pixel.
    Curved(Curved),
}

impl Geometry {
    /// The rays of a camera without a cut surface.
    pub fn rays(camera: Camera) -> Self {
        Self::Orthographic { camera, depth: Vec::new() }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        match self {
            Self::Orthographic { camera, .. } => camera.size(),
            Self::Curved(curved) => curved.size,
        }
    }

    /// The camera, if there is one.
    pub fn camera(&self) -> Option<&Camera> {
        match self {
            Self::Orthographic { camera, .. } => Some(camera),
            Self::Curved(_) => None,
        }
    }

    /// Depth of the cut surface (mm); empty without a camera or a cut surface.
    pub fn depth(&self) -> &[f32] {
        match self {
            Self::Orthographic { depth, .. } => depth,
            Self::Curved(_) => &[],
        }
    }

    /// Whether pixels have a position; false if every ray crosses the entire volume.
    pub fn has_surface(&self) -> bool {
        match self {
            Self::Orthographic { depth, .. } => !depth.is_empty(),
            Self::Curved(_) => true,
        }
    }
}

/// One position per pixel of an image without a camera, such as a straightened vessel.
#[derive(Clone, Debug)]
pub struct Curved {
    size: [usize; 2],
    position: Vec<DVec3>,
    slab_direction: Vec<Vec3>,
}

impl Curved {
    /// `position` holds the world point of every pixel (mm, LPS), row by row from the top. The thickness of a slab is
    /// measured along the pixel's unit vector `slab_direction`. A point that is not finite shows nothing. Fails with
    /// [`ErrorKind::Camera`] if `size` has no pixels or does not match the number of points or directions.
    pub fn new(size: [usize; 2], position: Vec<DVec3>, slab_direction: Vec<Vec3>) -> Result<Self> {
        let pixels = size[0] * size[1];
        if pixels == 0 || position.len() != pixels || slab_direction.len() != pixels {
            let found = format!(
                "{} points and {} directions for {size:?} pixels",
                position.len(),
                slab_direction.len()
            );
            let expected = "at least one pixel, with one point and one direction each";
            return Err(Error::new(ErrorKind::Camera, "curved geometry", found, expected));
        }
        Ok(Self { size, position, slab_direction })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The world point of each pixel (mm, LPS).
    pub fn position(&self) -> &[DVec3] {
        &self.position
    }

    /// The unit vector of each pixel along which the thickness of a slab is measured.
    pub fn slab_direction(&self) -> &[Vec3] {
        &self.slab_direction
    }
}

/// A ray per pixel from a common origin.
#[derive(Clone, Debug)]
pub struct Rays {
    size: [usize; 2],
    origin: DVec3,
    direction: Vec<Vec3>,
    span: Vec<[f32; 2]>,
}

impl Rays {
    /// `direction` holds the unit vector of every pixel, row by row from the top, and `span` where its ray starts and ends (mm
    /// from `origin`, a world point). A ray whose direction is zero shows nothing. Fails with [`ErrorKind::Camera`] if `size` has
    /// no pixels or does not match the number of directions or spans.
    pub fn new(size: [usize; 2], origin: DVec3, direction: Vec<Vec3>, span: Vec<[f32; 2]>) -> Result<Self> {
        let pixels = size[0] * size[1];
        if pixels == 0 || direction.len() != pixels || span.len() != pixels {
            let found =
                format!("{} directions and {} spans for {size:?} pixels", direction.len(), span.len());
            let expected = "at least one pixel, with one direction and one span each";
            return Err(Error::new(ErrorKind::Camera, "rays by pixel", found, expected));
        }
        Ok(Self { size, origin, direction, span })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The world point from which all rays start (mm, LPS).
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The unit vector of each pixel.
    pub fn direction(&self) -> &[Vec3] {
        &self.direction
    }

    /// Where the ray of each pixel starts and ends (mm from the origin).
    pub fn span(&self) -> &[[f32; 2]] {
        &self.span
    }
}
