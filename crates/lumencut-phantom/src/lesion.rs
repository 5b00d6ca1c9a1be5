//! Stenoses and plaques: their true values and their shapes.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::curve::Curve;

/// The composition of a plaque.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaqueKind {
    /// Non-calcified plaque, which fills the space between the lumen and the healthy lumen.
    Soft,
    /// Calcified plaque.
    Calcified,
}

/// A concentric stenosis: narrowest over the middle two fifths, with half-cosine transitions to the reference radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stenosis {
    /// Vessel id.
    pub vessel: usize,
    /// Arc length of the middle of the stenosis (mm).
    pub arc_length: f64,
    /// Length of the stenosis along the vessel (mm).
    pub length: f64,
    /// Diameter reduction at the middle (percent of the reference).
    pub percent: f64,
}

/// A plaque in the wall of a vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plaque {
    /// Vessel id.
    pub vessel: usize,
    /// Arc length of the middle of the plaque (mm).
    pub arc_length: f64,
    /// Composition of the plaque.
    pub kind: PlaqueKind,
    /// Direction from the centerline to the middle (radians), right-handed about the vessel's direction; 0 is nearest to anterior,
    /// or to superior if the vessel runs anteriorly.
    pub angle: f64,
    /// Length of the plaque along the vessel (mm).
    pub length: f64,
    /// Angular extent (radians); 2π for a ring.
    pub angular_extent: f64,
    /// Thickness at the middle (mm).
    pub thickness: f64,
    /// World position of the middle (mm, LPS); on the centerline for a ring.
    pub position: DVec3,
}

/// The fraction of a stenosis's length over which it is narrowest.
const PLATEAU: f64 = 0.4;

/// The progress of the narrowing (0 to 1) at `offset` mm from the middle of a stenosis.
pub(crate) fn narrowing(offset: f64, length: f64) -> f64 {
    let u = 2.0 * offset.abs() / length;
    if u >= 1.0 {
        return 0.0;
    }
    let v = ((u - PLATEAU) / (1.0 - PLATEAU)).max(0.0);
    0.5 + 0.5 * (PI * v).cos()
}

/// The unit vector across a vessel in the direction `angle`, defined as [`Plaque::angle`].
pub(crate) fn across(tangent: DVec3, angle: f64) -> DVec3 {
    let anterior = DVec3::NEG_Y;
    let zero = if tangent.dot(anterior).abs() < 0.95 { anterior } else { DVec3::Z };
    let zero = zero.reject_from_normalized(tangent).normalize();
    zero * angle.cos() + tangent.cross(zero) * angle.sin()
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Calcification {
    pub(crate) arc_length: f64,
    pub(crate) length: f64,
    pub(crate) angle: f64,
    pub(crate) angular_extent: f64,
    pub(crate) thickness: f64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Rod {
    pub(crate) ends: [DVec3; 2],
    pub(crate) radius: [f64; 2],
}

impl Calcification {
    /// The position of the plaque's middle (mm, LPS), outside a lumen of radius `lumen`.
    pub(crate) fn position(&self, curve: &Curve, lumen: f64) -> DVec3 {
        let direction = across(curve.tangent(self.arc_length), self.angle);
        curve.at(self.arc_length).0 + direction * (lumen + self.thickness / 2.0)
    }

    /// Fills the plaque with rods on the outside of the lumen; they are thinner towards the rim of the plaque.
    pub(crate) fn rods(&self, curve: &Curve, lumen: impl Fn(f64) -> f64) -> Vec<Rod> {
        let radius = lumen(self.arc_length) + self.thickness / 2.0;
        let steps = (radius * self.angular_extent / (0.5 * self.thickness)).ceil().max(2.0) as usize;
        let pieces = (self.length / 1.5).ceil().max(2.0) as usize;
        // Grid positions run from −1 to 1, so that the rods end within the stated extent.
        let grid = |n: usize, of: usize| 2.0 * n as f64 / of as f64 - 1.0;
        let rim = 0.2 * self.thickness;
        let arc_half = (self.angular_extent / 2.0 - rim / radius).max(0.0);
        let length_half = (self.length / 2.0 - rim).max(0.0);
        let knob = |u: f64, v: f64| {
            let half = self.thickness / 2.0 + (rim - self.thickness / 2.0) * (u * u + v * v).min(1.0);
            let s = self.arc_length + u * length_half;
            let direction = across(curve.tangent(s), self.angle + v * arc_half);
            (curve.at(s).0 + direction * (lumen(s) + half), half)
        };
        let mut rods = Vec::with_capacity(steps * pieces);
        for v in (0..=steps).map(|n| grid(n, steps)) {
            // The outline of the plaque is an ellipse.
            let reach = (1.0 - 0.8 * v * v).sqrt();
            for piece in 0..pieces {
                let (a, ra) = knob(reach * grid(piece, pieces), v);
                let (b, rb) = knob(reach * grid(piece + 1, pieces), v);
                rods.push(Rod { ends: [a, b], radius: [ra, rb] });
            }
        }
        rods
    }
}

/// The angular extent of a concentric plaque: a full turn.
pub(crate) const WHOLE_RING: f64 = TAU;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stenosis_is_full_in_its_middle_and_gone_at_its_ends() {
        assert_eq!(narrowing(0.0, 10.0), 1.0);
        assert_eq!(narrowing(1.9, 10.0), 1.0);
        assert!(narrowing(3.5, 10.0) > 0.4 && narrowing(3.5, 10.0) < 0.6);
        assert_eq!(narrowing(-5.0, 10.0), 0.0);
        assert_eq!(narrowing(9.0, 10.0), 0.0);
    }

    #[test]
    fn angles_start_anterior_and_turn_right_handed() {
        assert!(across(DVec3::Z, 0.0).distance(DVec3::NEG_Y) < 1e-12);
        assert!(across(DVec3::Z, PI / 2.0).distance(DVec3::X) < 1e-12);
        assert!(across(DVec3::NEG_Y, 0.0).distance(DVec3::Z) < 1e-12);
    }
}
