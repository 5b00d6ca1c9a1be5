//! Rays across a vessel, from its middle to where the lumen ends.

use std::f64::consts::TAU;

use glam::DVec3;

use lumencut_core::reformations::cpr::Straightened;
use lumencut_vessels::voxels::Voxels;

/// The distance of samples on a ray, in the sides that [`Voxels::sampling_side`] tells.
const SAMPLE: f64 = 0.4;

/// What is brighter than the lumen by this share of its contrast is no lumen, but calcium or metal.
pub(crate) const TOO_BRIGHT: f64 = 0.5;

/// Beyond its reach a ray is followed this much farther, to see whether bone or calcium begins there that touches the vessel.
const FARTHER: f64 = 0.5;

/// What a ray from the middle of the vessel meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fall {
    /// A wall, so far away (mm).
    Wall(f64),
    /// Lumen as far as it was followed.
    Open,
    /// It begins outside the lumen, or leaves the volume.
    Unknown,
}

impl Fall {
    /// How far away a wall is (mm), where one is beyond the middle.
    pub(crate) fn radius(self) -> Option<f64> {
        match self {
            Self::Wall(radius) if radius > 0.0 => Some(radius),
            _ => None,
        }
    }
}

/// Rays across a vessel through a volume.
pub(crate) struct RaysAcross<'a, 'v> {
    /// The volume.
    pub voxels: &'a Voxels<'v>,
    /// The space around the vessel.
    pub straightened: &'a Straightened,
    /// In how many directions they go.
    pub directions: usize,
}

impl RaysAcross<'_, '_> {
    /// What each ray in the section at an arc length meets within its reach (mm), where values first fall half of the way from the
    /// lumen's level to that of the surroundings. Bone that touches the vessel leaves no such fall: where values rise to it just beyond the
    /// reach, the wall lies where they are lowest before.
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
        let step = SAMPLE * self.voxels.sampling_side;
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
                Fall::Open => touching(&depths((1.0 + FARTHER) * reach(k)), step),
                met => met,
            }
        };
        (0..self.directions).map(ray).collect()
    }
}

/// Where a ray whose depths (0 in lumen, 1 in its surroundings) are sampled every so many mm falls to half, or meets calcium or
/// metal, which lie in a wall.
fn fall(depths: &[f64], step: f64) -> Fall {
    let mut before = f64::NAN;
    for (n, &depth) in depths.iter().enumerate() {
        if depth.is_nan() || (n == 0 && depth >= 0.5) {
            return Fall::Unknown;
        }
        if depth >= 0.5 {
            return Fall::Wall((n as f64 - (depth - 0.5) / (depth - before)) * step);
        }
        // Noise does not reach that far twice in a row.
        if depth.max(before) < -TOO_BRIGHT {
            return Fall::Wall(n as f64 * step);
        }
        before = depth;
    }
    Fall::Open
}

/// The wall of a vessel that touches bone or calcium: where its values are lowest before they rise to that. Open where they do not.
fn touching(depths: &[f64], step: f64) -> Fall {
    let rises = |pair: &[f64]| pair.iter().all(|depth| *depth < -TOO_BRIGHT);
    let Some(rise) = depths.windows(2).position(rises) else { return Fall::Open };
    let lowest = |best: usize, n: usize| if depths[n] >= depths[best] { n } else { best };
    // Next to the middle it is noise that decides which value is lowest.
    Fall::Wall((rise / 2..rise).fold(rise / 2, lowest) as f64 * step)
}
