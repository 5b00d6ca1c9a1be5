//! Random trees: reproducible smooth random walks in a box.

use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::vessel_tree::{Vessel, VesselTree};

use crate::random::Random;

/// A tree of `vessels` vessels, each with `segments` segments of `step` mm. About half of the vessels start on an earlier one.
/// Points stay within ±`extent` mm; radii are 1 to 6 mm.
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

/// A random walk from `start` that turns back at the faces of the cube.
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
