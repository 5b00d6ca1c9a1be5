//! The direction from which a vessel is seen.

use glam::DVec3;

use crate::error::{Error, ErrorKind, Result};

/// The direction from which a vessel is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Upwards in space; any length.
    pub up: DVec3,
    /// Rotation of the viewer to the right (radians): around `up`, or around a straightened vessel.
    pub angle: f64,
    /// Direction to the viewer at the first point of a straightened vessel (any length); `None`: the front.
    pub normal: Option<DVec3>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    /// To the right in the image.
    pub across: DVec3,
    pub up: DVec3,
    /// From the viewer into the scene.
    pub ahead: DVec3,
}

/// Vectors count as parallel if the tangent of their angle is below this.
pub(super) const PARALLEL: f64 = 0.05;

impl View {
    /// The view at angle 0: along +y, perpendicular to `up`; from below, like axial slices, if `up` is ±y.
    pub(super) fn unturned(&self) -> Result<Axes> {
        let up = unit("up of the CPR", self.up)?;
        let along = up.y.abs() * PARALLEL > up.x.hypot(up.z);
        let ahead = if along { DVec3::Z } else { DVec3::Y }.reject_from_normalized(up).normalize();
        Ok(Axes { across: ahead.cross(up), up, ahead })
    }

    pub(super) fn turned(&self) -> Result<Axes> {
        let Axes { across, up, ahead } = self.unturned()?;
        let (sine, cosine) = self.checked_angle()?.sin_cos();
        Ok(Axes { across: across * cosine + ahead * sine, up, ahead: ahead * cosine - across * sine })
    }

    pub(super) fn checked_angle(&self) -> Result<f64> {
        if self.angle.is_finite() {
            return Ok(self.angle);
        }
        Err(Error::new(ErrorKind::Camera, "angle of the CPR", format!("{}", self.angle), "a finite angle"))
    }
}

pub(super) fn unit(subject: &str, vector: DVec3) -> Result<DVec3> {
    let largest = vector.abs().max_element();
    let unit = if largest.is_finite() && largest > 0.0 { (vector / largest).try_normalize() } else { None };
    unit.ok_or_else(|| {
        Error::new(ErrorKind::Camera, subject, format!("{vector}"), "a finite vector other than zero")
    })
}
