//! Tangential CPR: one vessel as a camera sees it; its surroundings have the depth of its nearest point. Tangential
//! CPR is CR of one vessel without a threshold: each pixel takes the depth of the vessel's nearest point in the
//! image. The paper of CSR mentions it; as we did not find a description, the definition is ours
//! (docs/method/reformations.md).

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::layout::Layout;
use super::uncurl::Uncurl;
use crate::camera::Camera;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::Curved;
use crate::math::centerline_path::CenterlinePath;
use crate::stop::Stop;

/// The tangential CPR of one vessel in the pixels of a camera.
#[derive(Clone, Debug)]
pub struct Tangential {
    camera: Camera,
    /// The vessel with an uncurl amount of 0.
    curled: Uncurl,
}

impl Tangential {
    /// Fails with [`ErrorKind::Camera`] for a vessel that the camera sees as one point.
    pub fn new(path: Arc<CenterlinePath>, camera: Camera) -> Result<Self> {
        let along = path.direction().iter().map(|direction| direction.cross(camera.direction()).length());
        if along.fold(0.0, f64::max) < 1e-6 {
            let found = "a vessel parallel to the direction of view";
            let error = Error::new(
                ErrorKind::Camera,
                "camera of the tangential CPR",
                found,
                "a view across the vessel",
            );
            return Err(error.mend("turn the camera, or take the straightened CPR"));
        }
        Ok(Self { camera, curled: Uncurl::new(path, camera, 0.0, None)? })
    }
}

impl Layout for Tangential {
    fn size(&self) -> [usize; 2] {
        self.camera.size()
    }

    fn pixel_spacing(&self) -> f64 {
        self.camera.pixel_spacing()
    }

    fn curved(&self, stop: Stop) -> Result<Curved> {
        self.curled.curved(stop)
    }

    fn arc_length(&self, stop: Stop) -> Result<Vec<f64>> {
        self.curled.arc_length(stop)
    }

    fn folded(&self, stop: Stop) -> Result<Vec<bool>> {
        self.curled.folded(stop)
    }

    fn world_from_pixel(&self, pixel: DVec2) -> DVec3 {
        self.curled.world_from_pixel(pixel)
    }

    /// Where the camera sees a point, even if the image shows another depth there.
    fn pixel_from_world(&self, point: DVec3) -> DVec2 {
        let [seen, first] = [
            self.camera.view_from_world(point).truncate(),
            DVec2::new(self.camera.view_x(0), self.camera.view_y(0)),
        ];
        DVec2::new(seen.x - first.x, first.y - seen.y) / self.camera.pixel_spacing()
    }
}

#[cfg(test)]
#[path = "tests/tangential.rs"]
mod tests;
