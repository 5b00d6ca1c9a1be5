//! Flat pictures: patient slices and sections across a vessel.

use glam::{DVec3, Vec3};
use lumencut_core::geometry::{Curved, Geometry};
use serde::{Deserialize, Serialize};

use crate::study::failure::Result;

/// A flat picture: centre in world space, unit vectors right and down (LPS), size in pixels, pixel side (mm).
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Plane {
    pub center: [f64; 3],
    pub right: [f64; 3],
    pub(crate) down: [f64; 3],
    pub size: [usize; 2],
    pub pixel_spacing: f64,
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
}
