//! Random trees for tests and benches: smooth random walks through a box, the same for the same seed.

use glam::DVec3;

use super::random::{hash, uniform};
use crate::error::Result;
use crate::vessel_tree::{Vessel, VesselTree};

/// The random numbers of a seed, one after the other.
#[derive(Clone, Debug)]
pub struct Random {
    seed: u64,
    place: u64,
}

impl Random {
    /// The numbers of a seed.
    pub fn new(seed: u64) -> Self {
        Self { seed: hash(seed, 1), place: 0 }
    }

    /// The next number in [0, 1).
    pub fn number(&mut self) -> f64 {
        self.place += 1;
        uniform(self.seed, self.place)
    }

    /// The next point in the cube [−1, 1)³.
    pub fn next_point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number()) * 2.0 - 1.0
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
        if id > 0 && random.number() < 0.5 {
            let parent = made[(random.number() * id as f64) as usize].points();
            point = parent[(random.number() * parent.len() as f64) as usize];
        }
        let width = 1.0 + 4.0 * random.number();
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
