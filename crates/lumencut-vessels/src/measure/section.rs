//! Planes across a vessel, in a frame that does not rotate about the axis of the vessel.

pub mod blur;
pub(crate) mod contour_check;
pub mod flags;
pub(crate) mod lumen_estimate;
pub(crate) mod measured_part;
pub(crate) mod rays;
pub(crate) mod scale;
pub(crate) mod slab;

use glam::{DVec2, DVec3};

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::arc_length::LinePlace;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::math::frames::{Frames, MovingFrame};
use lumencut_core::math::statistics::median;
use lumencut_core::vessel_tree::Vessel;

/// Directions are smoothed by a Gaussian. Its width is half of the radius, clamped to this range (mm).
const SMOOTHING: [f64; 2] = [1.0, 8.0];

/// Maximum number of sections of a vessel.
pub const MOST_SECTIONS: u32 = 20_000;

/// A vessel counts as parallel to an axis if the cosine of their angle exceeds this.
const ALONG: f64 = 0.9;

/// A point of a vessel and the plane across it.
#[derive(Clone, Copy, Debug)]
pub struct SectionPlane {
    /// Arc length (mm).
    pub at: f64,
    /// Point of the vessel (mm, LPS).
    pub origin: DVec3,
    /// Unit vectors within the plane that point right and down in its image. The image is seen along a vessel that
    /// starts towards the head, and against any other vessel. So axial sections show the patient's left on the right.
    pub axes: [DVec3; 2],
    /// Unit vector along the vessel.
    pub normal: DVec3,
}

impl SectionPlane {
    /// The point (mm, LPS) at coordinates within the plane (mm).
    pub fn point(&self, place: DVec2) -> DVec3 {
        self.origin + self.axes[0] * place.x + self.axes[1] * place.y
    }

    /// Coordinates of a vector within the plane, and its component along the vessel (mm).
    pub fn coordinates(&self, vector: DVec3) -> [f64; 3] {
        [vector.dot(self.axes[0]), vector.dot(self.axes[1]), vector.dot(self.normal)]
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Track {
    path: CenterlinePath,
    /// The smoothed centerline that gives the directions.
    smooth: CenterlinePath,
    frames: Frames,
    is_seen_along: bool,
}

impl Track {
    /// Smooths the directions by a Gaussian as wide as half of `radius` (1 to 8 mm; 1 mm if it is unknown).
    pub(crate) fn new(vessel: &Vessel, radius: Option<f64>) -> Result<Self> {
        let smoothing = (0.5 * radius.unwrap_or(0.0)).clamp(SMOOTHING[0], SMOOTHING[1]);
        let path = CenterlinePath::new(vessel, 0.0)?;
        let distinct = Vessel::new(path.points().to_vec(), None)?;
        let smooth = CenterlinePath::new(&distinct, smoothing)?;
        let begins = smooth.direction()[0];
        // Down in the image is the patient's back, or the feet if the vessel starts towards the front or back.
        let down = if begins.y.abs() > ALONG { DVec3::NEG_Z } else { DVec3::Y };
        let frames = Frames::new(&smooth, MovingFrame::looking(begins, down));
        Ok(Self { path, smooth, frames, is_seen_along: begins.z >= 0.0 })
    }

    pub(crate) fn length(&self) -> f64 {
        self.path.length()
    }

    pub(crate) fn at(&self, at: f64) -> SectionPlane {
        let frame = self.frames.at(self.along_smooth(at));
        let right = if self.is_seen_along { -frame.across } else { frame.across };
        SectionPlane { at, origin: self.path.at(at), axes: [right, frame.ahead], normal: frame.tangent }
    }

    /// Section planes from the start to the end of the vessel, at most `step` mm apart.
    pub(crate) fn places(&self, step: f64) -> Result<Vec<SectionPlane>> {
        if !(step > 0.0 && step.is_finite()) {
            let expected = "a number above 0 mm";
            return Err(Error::new(ErrorKind::Settings, "step", format!("{step} mm"), expected));
        }
        let count = (self.length() / step).ceil();
        // The number of sections is the number of steps plus one, because both ends have a section.
        if count >= f64::from(MOST_SECTIONS) {
            return Err(too_many(self.length(), step, count + 1.0));
        }
        let count = count.max(1.0);
        Ok((0..=count as usize).map(|n| self.at(self.length() * n as f64 / count)).collect())
    }

    fn along_smooth(&self, at: f64) -> f64 {
        let [own, smooth] = [self.path.arc_length(), self.smooth.arc_length()];
        LinePlace::at(&own[..own.len().min(smooth.len())], at).value(smooth)
    }
}

fn too_many(length: f64, step: f64, count: f64) -> Error {
    let found = format!("{step} mm, which makes {count:.0} sections of a vessel of {length:.0} mm");
    let least = (length / f64::from(MOST_SECTIONS - 1) * 100.0).ceil() / 100.0;
    let expected = format!("a step that makes at most {MOST_SECTIONS} sections");
    Error::new(ErrorKind::Settings, "step", found, expected)
        .mend(format!("give a step of {least} mm or more"))
}

/// Median radius of the points of a vessel (mm), if any have one.
pub fn known_radius(vessel: &Vessel) -> Option<f64> {
    let mut radii: Vec<f64> = vessel.radius()?.iter().copied().filter(|radius| *radius > 0.0).collect();
    median(&mut radii)
}

#[cfg(test)]
#[path = "section/tests/section.rs"]
mod tests;
