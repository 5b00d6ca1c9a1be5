//! The one ray loop of the context: segment by segment, all rays of a tile abreast, skipping what changes nothing.

use super::accumulate::{Accumulator, Rgba, Samples};
use super::blocks::Blocks;
use super::lanes::FAN;
use super::light::{Headlight, Shading};
use super::ray::{Packet, Rays, STEPS, Segment};
use super::sampling::{Path, Sampler};

/// What rays run through.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The rays' geometry.
    pub rays: &'a Rays,
    /// The volume.
    pub sampler: &'a dyn Sampler,
    /// What can be skipped; `None` samples everything, with the same result.
    pub blocks: Option<&'a Blocks>,
    /// How colours are shaded, where they are.
    pub shading: Option<Shading>,
}

/// Sixteen rays and what they have gathered.
#[derive(Clone, Debug)]
pub struct Walker<A> {
    packet: Packet,
    gathered: A,
    /// The segments, sorted once, the most promising first; for accumulators of any order only.
    segments: Vec<Segment>,
}

impl<'a, A: Accumulator<'a>> Walker<A> {
    /// Rays at their start.
    #[inline(always)]
    pub fn new(packet: Packet, gathered: A) -> Self {
        Self { packet, gathered, segments: Vec::new() }
    }

    /// The pixels.
    #[inline(always)]
    pub fn finish(&self) -> Rgba {
        self.gathered.finish()
    }
}

/// Lets rays side by side gather their samples. They walk abreast: what one of them fetches from memory its neighbours
/// need next.
#[inline(always)]
pub fn trace<'a, A: Accumulator<'a>>(scene: &Scene, walkers: &mut [Walker<A>]) {
    let mut longest = 0;
    for walker in &mut *walkers {
        longest = longest.max(walker.packet.longest);
        if A::ANY_ORDER {
            let mut first = 0;
            while first < walker.packet.longest {
                walker.segments.push(walker.packet.segment(&scene.rays.grid, scene.blocks, first));
                first += STEPS as i32;
            }
            walker
                .segments
                .sort_unstable_by(|one, other| A::promise(other.range).total_cmp(&A::promise(one.range)));
        }
    }
    let mut first = 0;
    while first < longest {
        for walker in &mut *walkers {
            if first >= walker.packet.longest {
                continue;
            }
            let segment = if A::ANY_ORDER {
                walker.segments[first as usize / STEPS]
            } else {
                walker.packet.segment(&scene.rays.grid, scene.blocks, first)
            };
            if walker.gathered.ignores(segment.range) {
                continue;
            }
            visit(scene, &walker.packet, &segment, &mut walker.gathered);
            if walker.gathered.is_done() {
                walker.packet.longest = 0;
            }
        }
        first += STEPS as i32;
    }
}

/// Takes the samples of one segment.
#[inline(always)]
fn visit<'a, A: Accumulator<'a>>(scene: &Scene, packet: &Packet, segment: &Segment, gathered: &mut A) {
    let line = packet.line(segment);
    let values = scene.sampler.along(segment.base, &line);
    for n in 0..STEPS {
        let value = &values[n];
        let mut present = [0.0; FAN];
        for l in 0..FAN {
            let there = if segment.first + (n as i32) < packet.count[l] { 1.0 } else { 0.0 };
            present[l] = if value[l].is_nan() { 0.0 } else { there };
        }
        let light = Headlight {
            shading: scene.shading,
            sampler: scene.sampler,
            index_from_view: &scene.rays.index_from_view,
            base: segment.base,
            places: line.places(n),
        };
        gathered.add(&Samples { value, present: &present, thickness: &packet.thickness }, &light);
    }
}
