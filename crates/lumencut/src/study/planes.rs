//! Flat pictures: patient slices and sections across a vessel.

use glam::{DVec3, Vec3};
use lumencut_core::geometry::{Curved, Geometry};
use lumencut_core::settings::Slab;
use lumencut_io::session_file::{SliceAxes, Slices};
use serde::{Deserialize, Serialize};

use crate::study::failure::{Failure, Result};
use crate::study::settings::slab_of;

/// A flat picture: centre in world space, unit vectors right and down (LPS), size in pixels, pixel side (mm).
#[derive(Clone, Debug, Deserialize, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Plane {
    pub center: [f64; 3],
    pub right: [f64; 3],
    pub(crate) down: [f64; 3],
    pub size: [usize; 2],
    pub pixel_spacing: f64,
    /// Thickness (mm) and mode of a slab centred on the plane; without one, the picture shows the plane itself.
    #[serde(default)]
    #[cfg_attr(test, ts(as = "Option<Option<(f64, String)>>", optional))]
    pub(crate) slab: Option<(f64, String)>,
}

impl Plane {
    pub(crate) fn geometry(&self) -> Result<Geometry> {
        let [center, right, down] = [self.center, self.right, self.down].map(DVec3::from_array);
        let [width, height] = self.size;
        let away = |count: usize, n: usize| (n as f64 - (count as f64 - 1.0) / 2.0) * self.pixel_spacing;
        let row = |j| (0..width).map(move |i| center + right * away(width, i) + down * away(height, j));
        let position = (0..height).flat_map(row).collect();
        let across = right.cross(down).as_vec3();
        let directions: Vec<Vec3> = vec![across; width * height];
        Ok(Geometry::Curved(Curved::new(self.size, position, directions)?))
    }

    pub(crate) fn slab(&self) -> Result<Option<Slab>> {
        self.slab.as_ref().map(|(thickness, mode)| slab_of(*thickness, mode)).transpose()
    }
}

/// How far the axes of saved slices may be from perpendicular unit vectors.
const AXES_TOLERANCE: f64 = 1e-3;

/// Checks slices of a session: the axes of each and their normals are perpendicular unit vectors, the slab is valid.
pub(crate) fn check_slices(slices: &Slices) -> Result<()> {
    let planes = [slices.axial, slices.coronal, slices.sagittal].map(|SliceAxes { right, down }| {
        let [right, down] = [right, down].map(DVec3::from_array);
        [right, down, right.cross(down)]
    });
    let is_frame = |[a, b, c]: [DVec3; 3]| {
        let lengths = [a, b, c].map(|axis| axis.length() - 1.0);
        let angles = [a.dot(b), b.dot(c), c.dot(a)];
        lengths.into_iter().chain(angles).all(|error| error.abs() <= AXES_TOLERANCE)
    };
    let normals = planes.map(|[_, _, normal]| normal);
    if !planes.into_iter().chain([normals]).all(is_frame) {
        let found = "axes that are not perpendicular, or no unit vectors";
        let expected = "perpendicular unit vectors";
        return Err(Failure {
            kind: "session",
            ..Failure::of_message("slices of the session", &found, expected)
        });
    }
    slices.slab.as_ref().map_or(Ok(()), |(thickness, mode)| slab_of(*thickness, mode).map(|_| ()))
}
