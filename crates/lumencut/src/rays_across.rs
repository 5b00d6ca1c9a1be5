//! Casts rays across a vessel, from its middle to the end of the lumen.

use std::f64::consts::TAU;

use glam::DVec3;

use lumencut_core::reformations::cpr::Straightened;
use lumencut_vessels::voxels::Voxels;

/// Distance between samples on a ray, in units of [`Voxels::sampling_side`].
const SAMPLE_STEP: f64 = 0.4;

/// Values above the lumen by more than this fraction of the contrast are calcium or metal.
pub(crate) const TOO_BRIGHT: f64 = 0.5;

/// A ray is followed beyond its reach by this fraction, to detect touching bone or calcium.
const EXTRA_REACH: f64 = 0.5;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fall {
    /// A wall at this distance (mm).
    Wall(f64),
    Open,
    /// The ray begins outside the lumen, or leaves the volume.
    Unknown,
}

impl Fall {
    /// The distance of the wall (mm), if it is above 0.
    pub(crate) fn radius(self) -> Option<f64> {
        match self {
            Self::Wall(radius) if radius > 0.0 => Some(radius),
            _ => None,
        }
    }
}

pub(crate) struct RaysAcross<'a, 'v> {
    pub voxels: &'a Voxels<'v>,
    pub straightened: &'a Straightened,
    pub directions: usize,
}

impl RaysAcross<'_, '_> {
    /// What each ray of a section meets within its reach (mm). The wall is where values first fall midway from lumen to
    /// surroundings. If values rise to touching bone just beyond the reach, the wall is where they are lowest before the rise.
    pub(crate) fn falls(
        &self,
        at: f64,
        [lumen, around]: [f64; 2],
        reach: impl Fn(usize) -> f64,
    ) -> Vec<Fall> {
        let frame = self.straightened.frame(at);
        let index = &self.voxels.index_from_world;
        let middle = self.straightened.world_from_straightened(DVec3::new(0.0, 0.0, at));
        let start = index.transform_point3(middle);
        let step = SAMPLE_STEP * self.voxels.sampling_side;
        let depth = |value: f32| (f64::from(value) - lumen) / (around - lumen);
        let ray = |k: usize| {
            let (sine, cosine) = (TAU * k as f64 / self.directions as f64).sin_cos();
            let stride = index.transform_vector3(frame.across * cosine + frame.ahead * sine) * step;
            let samples = |reach: f64| (reach / step).ceil() as usize + 1;
            let mut values = Vec::new();
            let mut depths = |reach: f64| -> Vec<f64> {
                while values.len() < samples(reach) {
                    self.voxels.along(start, stride, &mut values);
                }
                values[..samples(reach)].iter().map(|value| depth(*value)).collect()
            };
            match fall(&depths(reach(k)), step) {
                Fall::Open => touching(&depths((1.0 + EXTRA_REACH) * reach(k)), step),
                met => met,
            }
        };
        (0..self.directions).map(ray).collect()
    }
}

/// Where the depths of a ray (0 in lumen, 1 outside; `step` mm apart) first pass one half, or where the ray meets calcium or metal.
fn fall(depths: &[f64], step: f64) -> Fall {
    let mut before = f64::NAN;
    for (n, &depth) in depths.iter().enumerate() {
        if depth.is_nan() || (n == 0 && depth >= 0.5) {
            return Fall::Unknown;
        }
        if depth >= 0.5 {
            return Fall::Wall((n as f64 - (depth - 0.5) / (depth - before)) * step);
        }
        // Noise hardly reaches this level twice in a row.
        if depth.max(before) < -TOO_BRIGHT {
            return Fall::Wall(n as f64 * step);
        }
        before = depth;
    }
    Fall::Open
}

/// The wall in front of touching bone or calcium: the lowest value before the rise. Open if there is no rise.
fn touching(depths: &[f64], step: f64) -> Fall {
    let rises = |pair: &[f64]| pair.iter().all(|depth| *depth < -TOO_BRIGHT);
    let Some(rise) = depths.windows(2).position(rises) else { return Fall::Open };
    let lowest = |best: usize, n: usize| if depths[n] >= depths[best] { n } else { best };
    // The part next to the middle is skipped, since noise would decide the minimum there.
    Fall::Wall((rise / 2..rise).fold(rise / 2, lowest) as f64 * step)
}
