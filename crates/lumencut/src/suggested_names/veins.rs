//! Rules for veins and the heart: their brightness, compared with the aorta's, and their place.

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::math::statistics::median;
use lumencut_core::volume::Volume;
use lumencut_vessels::voxels::Voxels;

use crate::parts::parts;
use crate::suggested_names::graph::Tube;

/// The brightness is taken where the radius is at least this (mm): the blur dims thinner vessels.
const WIDE: f64 = 2.5;
/// Vessels that are wide over a shorter length get no suggestion (mm).
const LENGTH: f64 = 40.0;
/// The contrast as a share of the aorta's. No artery is brighter than the aorta: contrast medium flows in, or through the lungs.
const BRIGHT: f64 = 1.1;
const PALE: [f64; 2] = [0.4, 0.7];
/// A pale vein is at least this many diameters long; shorter tubes may be bone or an organ.
const SLENDER: f64 = 6.0;
/// A pale vessel nearer to the wall of the aorta may be a false lumen (mm).
const BESIDE: f64 = 8.0;
/// The aorta is read in as many parts: contrast medium fills true and false lumen differently.
const PARTS: usize = 6;
/// The surroundings of the aorta are read at this multiple of its radius.
const AROUND: f64 = 1.8;

/// The brightness of the aorta, from points on it and their radii (mm).
pub(super) struct Aorta<'a> {
    voxels: Voxels<'a>,
    points: Vec<(DVec3, f64)>,
    /// The contrast of the palest and of the brightest part.
    contrast: [f64; 2],
    background: f64,
}

impl<'a> Aorta<'a> {
    /// None if its contrast is not seen.
    pub(super) fn of(volume: &Volume<'a>, points: Vec<(DVec3, f64)>) -> Option<Self> {
        let voxels = Voxels::new(volume);
        let value = |point: DVec3| f64::from(voxels.at(point));
        let around = points.iter().flat_map(|(point, radius)| {
            [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y].map(|way| *point + way * AROUND * *radius)
        });
        let background = usual(around.map(value))?;
        let parts = points.chunks(points.len().div_ceil(PARTS).max(1));
        let parts = parts.filter_map(|part| usual(part.iter().map(|(point, _)| value(*point))));
        let contrast = parts.map(|level| level - background);
        let contrast = contrast.fold([f64::INFINITY, 0.0], |[low, high], one| [one.min(low), one.max(high)]);
        (contrast[0] > 0.0).then_some(Self { voxels, points, contrast, background })
    }

    /// For each tube, whether it seems to be a vein or part of the heart; those in `named` are not.
    pub(super) fn veins_and_heart(&self, tubes: &[Tube], named: &[bool]) -> Vec<bool> {
        let mut is_vein: Vec<bool> = (0..tubes.len()).map(|n| !named[n] && self.is_pale(tubes[n])).collect();
        let lines: Vec<&[DVec3]> = tubes.iter().map(|(points, _)| *points).collect();
        for part in parts(&lines).into_iter().filter(|part| !part.iter().any(|n| named[*n])) {
            let contrast = self.contrast(part.iter().map(|n| tubes[*n]));
            if contrast.is_some_and(|contrast| contrast >= BRIGHT * self.contrast[1]) {
                part.into_iter().for_each(|n| is_vein[n] = true);
            }
        }
        is_vein
    }

    fn is_pale(&self, tube: Tube) -> bool {
        let length = arc_lengths(tube.0).last().copied().unwrap_or_default();
        let diameter = 2.0 * usual(tube.1.iter().copied()).unwrap_or_default();
        if length < SLENDER * diameter {
            return false;
        }
        let share = self.contrast([tube].into_iter()).map(|contrast| contrast / self.contrast[0]);
        share.is_some_and(|share| (PALE[0]..=PALE[1]).contains(&share)) && !self.is_beside(tube.0)
    }

    /// The contrast of tubes where they are wide.
    fn contrast<'t>(&self, tubes: impl Iterator<Item = Tube<'t>>) -> Option<f64> {
        let (mut values, mut length) = (Vec::new(), 0.0);
        for (points, radius) in tubes {
            for (pair, _) in points.windows(2).zip(radius).filter(|(_, radius)| **radius >= WIDE) {
                values.push(f64::from(self.voxels.at(pair[0])));
                length += pair[0].distance(pair[1]);
            }
        }
        let level = usual(values.into_iter()).filter(|_| length >= LENGTH)?;
        Some(level - self.background)
    }

    /// Whether any part of a line runs near the wall of the aorta.
    fn is_beside(&self, line: &[DVec3]) -> bool {
        let near = |point: &DVec3, (place, radius): &(DVec3, f64)| point.distance(*place) < radius + BESIDE;
        line.iter().any(|point| self.points.iter().any(|place| near(point, place)))
    }
}

/// The median of the finite values.
fn usual(values: impl Iterator<Item = f64>) -> Option<f64> {
    median(&mut values.filter(|value| value.is_finite()).collect::<Vec<_>>())
}
