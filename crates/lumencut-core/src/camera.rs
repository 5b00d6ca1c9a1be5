//! The orthographic camera: position and directions of the view in world space, and its pixels.

use glam::DVec3;

use crate::error::{Error, ErrorKind, Result};
use crate::vessel_tree::MAX_COORDINATE;

pub(crate) const MAX_SIZE: usize = 32_768;

/// The largest number of pixels of an image; the buffers of such an image take a few gigabytes.
pub const MAX_PIXELS: usize = 1 << 27;

/// The largest pixel spacing (mm); it keeps coordinates below the numbers that kernels use as markers.
pub(crate) const MAX_PIXEL_SPACING: f64 = 1e4;

/// An orthographic view: x right, y up, z away from the viewer, origin at `center`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    center: DVec3,
    direction: DVec3,
    right: DVec3,
    up: DVec3,
    size: [usize; 2],
    pixel_spacing: f64,
}

impl Camera {
    /// A camera that looks along `direction` with `up` upwards, `size` = (width, height) pixels of `pixel_spacing`
    /// mm. `up` need not be perpendicular to `direction`. Fails with [`ErrorKind::Camera`] for vectors that are not
    /// finite, zero or parallel, an empty or oversized image, or a pixel spacing that is not positive and finite.
    pub fn new(
        center: DVec3,
        direction: DVec3,
        up: DVec3,
        size: [usize; 2],
        pixel_spacing: f64,
    ) -> Result<Self> {
        let wrong = |subject: &str, found: String, expected: &str| {
            Err(Error::new(ErrorKind::Camera, subject, found, expected))
        };
        if !center.is_finite() || center.abs().max_element() > MAX_COORDINATE {
            return wrong(
                "center of the camera",
                format!("{center}"),
                "finite coordinates within 1e6 mm of the origin",
            );
        }
        let Some(unit) = direction.try_normalize() else {
            return wrong(
                "direction of the camera",
                format!("{direction}"),
                "a finite vector other than zero",
            );
        };
        let Some(unit_up) = up.try_normalize() else {
            return wrong("up of the camera", format!("{up}"), "a finite vector other than zero");
        };
        let across = unit.cross(unit_up);
        if across.length() < 1e-6 {
            let found = format!("up {up} parallel to direction {direction}");
            return wrong("up of the camera", found, "an up that is not parallel to the direction");
        }
        if size.iter().any(|n| *n == 0 || *n > MAX_SIZE) {
            return wrong("size of the camera", format!("{size:?}"), "1 to 32768 pixels along each side");
        }
        if size[0] * size[1] > MAX_PIXELS {
            let found = format!("{} × {} pixels", size[0], size[1]);
            return wrong("size of the camera", found, "at most 2^27 (134,217,728) pixels in all");
        }
        if !(1e-6..=MAX_PIXEL_SPACING).contains(&pixel_spacing) {
            return wrong(
                "pixel_spacing of the camera",
                format!("{pixel_spacing}"),
                "between 1e-6 and 1e4 mm",
            );
        }
        let right = across.normalize();
        Ok(Self { center, direction: unit, right, up: right.cross(unit), size, pixel_spacing })
    }

    /// The same view with these stored unit vectors; normalising them again could change their last bits.
    /// Fails with [`ErrorKind::Camera`] for vectors that differ from the camera's own by more than rounding.
    pub fn with_axes(self, direction: DVec3, right: DVec3, up: DVec3) -> Result<Self> {
        let kept = Self { direction, right, up, ..self };
        let pairs = [(direction, self.direction), (right, self.right), (up, self.up)];
        if pairs.iter().any(|(axis, own)| !axis.abs_diff_eq(*own, 1e-9)) {
            let found = format!("direction {direction}, right {right}, up {up}");
            let expected = format!("direction {}, right {}, up {}", self.direction, self.right, self.up);
            return Err(Error::new(ErrorKind::Camera, "axes of the camera", found, expected));
        }
        Ok(kept)
    }

    /// Origin of view space (mm, LPS): the middle of the image at depth 0.
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Unit vector from the viewer into the scene.
    pub fn direction(&self) -> DVec3 {
        self.direction
    }

    /// Unit vector to the right in the image.
    pub fn right(&self) -> DVec3 {
        self.right
    }

    /// Unit vector upwards in the image, perpendicular to the direction.
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The side of a pixel (mm).
    pub fn pixel_spacing(&self) -> f64 {
        self.pixel_spacing
    }

    /// View x of the centre of column `i` (mm).
    #[inline(always)]
    pub fn view_x(&self, i: usize) -> f64 {
        (i as f64 + 0.5 - self.size[0] as f64 / 2.0) * self.pixel_spacing
    }

    /// View y of the centre of row `j` (mm).
    #[inline(always)]
    pub fn view_y(&self, j: usize) -> f64 {
        (self.size[1] as f64 / 2.0 - j as f64 - 0.5) * self.pixel_spacing
    }

    /// View coordinates (mm) of a world point: x right, y up, z = depth.
    #[inline(always)]
    pub fn view_from_world(&self, world: DVec3) -> DVec3 {
        let p = world - self.center;
        DVec3::new(p.dot(self.right), p.dot(self.up), p.dot(self.direction))
    }

    /// World point (mm, LPS) of view coordinates.
    #[inline(always)]
    pub fn world_from_view(&self, view: DVec3) -> DVec3 {
        self.center + self.right * view.x + self.up * view.y + self.direction * view.z
    }
}
