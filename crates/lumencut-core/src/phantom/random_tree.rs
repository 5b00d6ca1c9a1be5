//! Random trees for tests and benches: smooth random walks through a box, the same for the same seed.

use glam::DVec3;

use crate::error::Result;
use crate::vessel_tree::{Vessel, VesselTree};

/// A small counter-based generator (SplitMix64).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The generator of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number in [0, 1).
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The next point in the cube [−1, 1)³.
    pub fn next_point(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }
}

/// A tree of `vessels` vessels with `segments` segments of `step` mm each; about half start on an earlier
/// vessel. All points stay in a cube of half side `extent` mm around the origin; radii are 1 to 6 mm.
///
/// # Errors
/// [`crate::error::ErrorKind::VesselTree`] where a count is zero.
pub fn random_tree(seed: u64, vessels: usize, segments: usize, step: f64, extent: f64) -> Result<VesselTree> {
    let mut random = Random::new(seed);
    let mut made: Vec<Vessel> = Vec::with_capacity(vessels);
    for id in 0..vessels {
        let mut point = random.next_point() * extent;
        if id > 0 && random.next() < 0.5 {
            let parent = made[(random.next() * id as f64) as usize].points();
            point = parent[(random.next() * parent.len() as f64) as usize];
        }
        let width = 1.0 + 4.0 * random.next();
        made.push(walk(&mut random, point, segments, step, extent, width)?);
    }
    VesselTree::new(made)
}

/// One vessel that wanders from `start` and turns back where it would leave the cube.
fn walk(
    random: &mut Random,
    start: DVec3,
    segments: usize,
    step: f64,
    extent: f64,
    width: f64,
) -> Result<Vessel> {
    let mut heading = random.next_point().normalize_or(DVec3::X);
    let (mut points, mut radii) = (vec![start], vec![width]);
    for i in 0..segments {
        let bend = random.next_point() * 0.35;
        heading = (heading + bend).normalize_or(DVec3::X);
        let mut next = points[i] + heading * step;
        for axis in 0..3 {
            if next[axis].abs() > extent {
                heading[axis] = -heading[axis];
                next[axis] = points[i][axis] + heading[axis] * step;
            }
        }
        points.push(next);
        radii.push(width + (i as f64 * 0.1).sin());
    }
    Vessel::new(points, Some(radii))
}
