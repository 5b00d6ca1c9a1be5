//! The one ray loop of the context: segment by segment, skipping what would change nothing.

use super::accumulate::{Accumulator, Rgba, Samples};
use super::blocks::Blocks;
use super::lanes::FAN;
use super::light::Headlight;
use super::ray::{Packet, Rays, STEPS, Segment};
use super::sampling::Path;
use crate::volume::Voxel;

/// What rays run through.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, T> {
    /// The rays' geometry.
    pub rays: &'a Rays,
    /// The voxels.
    pub voxels: &'a [T],
    /// What can be skipped; `None` samples everything, with the same result.
    pub blocks: Option<&'a Blocks>,
    /// Whether colours are shaded.
    pub shading: bool,
}

/// Segments that wait for more promising ones.
pub type Waiting = Vec<(f32, Segment)>;

/// Lets sixteen rays gather their samples, near to far, or the most promising first where the order does not matter.
#[inline(always)]
pub fn trace<T: Voxel, A: Accumulator>(
    scene: &Scene<T>,
    packet: &Packet,
    waiting: &mut Waiting,
    mut gathered: A,
) -> Rgba {
    waiting.clear();
    let mut first = 0;
    while first < packet.longest {
        let segment = packet.segment(&scene.rays.grid, scene.blocks, first);
        match A::promise(segment.range) {
            Some(promise) => waiting.push((promise, segment)),
            None if gathered.ignores(segment.range) => {}
            None => visit(scene, packet, &segment, &mut gathered),
        }
        first += STEPS as i32;
    }
    waiting.sort_unstable_by(|one, other| other.0.total_cmp(&one.0));
    for (_, segment) in &*waiting {
        if !gathered.ignores(segment.range) {
            visit(scene, packet, segment, &mut gathered);
        }
    }
    gathered.finish()
}

/// Takes the samples of one segment.
#[inline(always)]
fn visit<T: Voxel, A: Accumulator>(scene: &Scene<T>, packet: &Packet, segment: &Segment, gathered: &mut A) {
    let line = packet.line(segment);
    let grid = &scene.rays.grid;
    let values: [_; STEPS] = grid.sample(scene.voxels, segment.base, &line);
    for n in 0..STEPS {
        let value = &values[n];
        let mut present = [false; FAN];
        for l in 0..FAN {
            present[l] = (segment.first + (n as i32) < packet.count[l]) & !value[l].is_nan();
        }
        let light = Headlight {
            shading: scene.shading,
            grid,
            voxels: scene.voxels,
            index_from_view: &scene.rays.index_from_view,
            base: segment.base,
            places: line.places(n),
        };
        gathered.add(&Samples { value, present: &present, thickness: &packet.thickness }, &light);
    }
}
