//! The common form of all CPR modes: a surface of lines across the vessel, as an image without pixels.

use crate::math::same_place::ON_PICTURE;
use glam::{DVec2, DVec3};

use super::row::Row;
use crate::error::{Error, ErrorKind};

pub(super) trait Surface: Send + Sync {
    fn height(&self) -> f64;
    /// Extent of the vessel to each side of the middle (mm).
    fn reach(&self) -> f64;
    fn row(&self, y: f64) -> Row;
    fn image_from_world(&self, point: DVec3) -> DVec2;
    fn folded(&self, y: f64, x: &[f64]) -> Vec<bool>;
}

/// Whether the first of two positions (mm aside, mm down) has precedence: the nearer one, then the upper one.
pub(super) fn comes_first([aside, y]: [f64; 2], [other_aside, other_y]: [f64; 2]) -> bool {
    let nearer = other_aside - aside;
    if nearer.abs() > ON_PICTURE { nearer > 0.0 } else { y + ON_PICTURE < other_y }
}

pub(super) fn one_row(mode: &str, mend: &str) -> Error {
    let found = format!("a vessel that lies in one row of the {mode} CPR");
    Error::new(ErrorKind::Camera, "up of the CPR", found, "a vessel of several rows").mend(mend)
}
