//! Lengths and directions of vessel segments, and C-arm angles.

use glam::DVec3;

use super::Profile;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::arc_length::point_at;

/// Lengths of a segment between two points of a vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Length along the vessel (mm).
    pub length: f64,
    /// Straight distance between the ends (mm).
    pub straight: f64,
}

impl Stretch {
    /// Length divided by straight distance; infinite if both ends coincide.
    pub fn tortuosity(&self) -> f64 {
        if self.straight > 0.0 { self.length / self.straight } else { f64::INFINITY }
    }
}

/// C-arm angles (radians).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CArm {
    /// Left anterior oblique rotation; negative for right anterior oblique.
    pub lao: f64,
    /// Cranial angulation; negative for caudal.
    pub cranial: f64,
}

impl Profile {
    /// Length between two arc lengths (mm). Errors: [`ErrorKind::Measuring`] for invalid or equal places.
    pub fn stretch(&self, [from, to]: [f64; 2]) -> Result<Stretch> {
        self.check_stretch([from, to])?;
        let straight = self.point_at(from).distance(self.point_at(to));
        Ok(Stretch { length: (to - from).abs(), straight })
    }

    /// Direction from one arc length to another (mm): that of a line fitted to the section centres. Errors:
    /// [`ErrorKind::Measuring`] for places beyond the vessel, or the same place twice.
    pub fn direction(&self, [from, to]: [f64; 2]) -> Result<DVec3> {
        self.check_stretch([from, to])?;
        let [low, high] = [from.min(to), from.max(to)];
        let inner = (0..self.len()).filter(|n| (low..=high).contains(&self.arc_length[*n]));
        let mut line: Vec<(f64, DVec3)> = inner.map(|n| (self.arc_length[n], self.center[n])).collect();
        if line.len() < 3 {
            line = [from, to].map(|at| (at, self.point_at(at))).to_vec();
        }
        let count = line.len() as f64;
        let middle = line.iter().map(|(at, _)| at).sum::<f64>() / count;
        // The direction is the least-squares slope of the points by arc length.
        let slope: DVec3 = line.iter().map(|(at, point)| *point * (at - middle)).sum();
        let direction = (slope * (to - from).signum()).try_normalize();
        direction.ok_or_else(|| {
            let found = format!("a stretch from {from:.1} to {to:.1} mm without direction");
            Error::new(
                ErrorKind::Measuring,
                "stretch of the vessel",
                found,
                "a stretch between two different positions",
            )
        })
    }

    /// Angle between two segments (radians); 0 for the same direction.
    pub fn angle_between(&self, first: [f64; 2], second: [f64; 2]) -> Result<f64> {
        Ok(self.direction(first)?.angle_between(self.direction(second)?))
    }

    /// C-arm angles that show a segment without foreshortening: at rotation `lao` (radians) if given, otherwise
    /// nearest to the frontal view. Errors: those of [`Profile::direction`], or if no angulation does so at `lao`.
    pub fn c_arm(&self, stretch: [f64; 2], lao: Option<f64>) -> Result<CArm> {
        let along = self.direction(stretch)?;
        match lao {
            None => Ok(least_turned(along)),
            Some(lao) => angulated(along, lao),
        }
    }

    /// Centerline point at an arc length (mm, LPS).
    pub fn point_at(&self, at: f64) -> DVec3 {
        point_at(&self.on_vessel, &self.arc_length, at)
    }

    pub(super) fn check_stretch(&self, ends: [f64; 2]) -> Result<()> {
        for end in ends {
            self.check_place("end of the stretch", end)?;
        }
        if ends[0] == ends[1] {
            let found = format!("{} mm twice", ends[0]);
            return Err(Error::new(
                ErrorKind::Measuring,
                "ends of the stretch",
                found,
                "two different arc lengths",
            ));
        }
        Ok(())
    }
}

/// Direction towards the detector (LPS): (sin α cos β, -cos α cos β, sin β) for LAO α and cranial β.
pub fn towards_detector(CArm { lao, cranial }: CArm) -> DVec3 {
    DVec3::new(lao.sin() * cranial.cos(), -lao.cos() * cranial.cos(), cranial.sin())
}

/// The direction that is up in the C-arm image (LPS), towards the head. In a view exactly from above or
/// below, it is the limit of neighbouring views: towards the back from above, towards the front from below.
pub fn up_at_detector(CArm { lao, cranial }: CArm) -> DVec3 {
    DVec3::new(-lao.sin() * cranial.sin(), lao.cos() * cranial.sin(), cranial.cos())
}

fn least_turned(along: DVec3) -> CArm {
    let front = DVec3::NEG_Y;
    // A vessel parallel to the frontal view direction is shown from the patient's left.
    let view = front.reject_from_normalized(along).try_normalize().unwrap_or(DVec3::X);
    let view = if (front.dot(along).abs() - 1.0).abs() < 1e-9 { DVec3::X } else { view };
    CArm { lao: view.x.atan2(-view.y), cranial: view.z.clamp(-1.0, 1.0).asin() }
}

/// C-arm angles at rotation `lao` that show a direction without foreshortening.
fn angulated(along: DVec3, lao: f64) -> Result<CArm> {
    let flat = along.x * lao.sin() - along.y * lao.cos();
    if !lao.is_finite() || (along.z.abs() < 1e-9 && flat.abs() > 1e-9) {
        let found = format!("{:.1}° for a stretch within the plane of rotation", lao.to_degrees());
        return Err(Error::new(ErrorKind::Measuring, "rotation of the C-arm", found, "another rotation"));
    }
    let cranial = if flat.abs() < 1e-9 { 0.0 } else { (-flat / along.z).atan() };
    Ok(CArm { lao, cranial })
}

#[cfg(test)]
#[path = "tests/stretch.rs"]
mod tests;
