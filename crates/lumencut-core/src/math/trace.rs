//! The ray loop of the context: all rays of a tile advance together and skip segments that change nothing.

use super::accumulate::{Blend, Rgba, Samples};
use super::blocks::{Blocks, Range};
use super::lanes::FAN;
use super::light::{Headlight, Shading};
use super::ray::{Packet, Rays, STEPS, Segment};
use super::sampler::Sampler;
use super::sampling::SampledRun;

#[derive(Clone, Copy)]
pub(crate) struct Passage<'a> {
    pub rays: &'a Rays,
    pub sampler: &'a dyn Sampler,
    /// Blocks for skipping; `None` samples everything, with the same result.
    pub blocks: Option<&'a Blocks>,
    pub shading: Option<Shading>,
}

#[derive(Clone, Debug)]
pub(crate) struct RayPacket<'a> {
    rays: Packet,
    gathered: Blend<'a>,
}

impl<'a> RayPacket<'a> {
    #[inline(always)]
    pub(crate) fn new(rays: Packet, gathered: Blend<'a>) -> Self {
        Self { rays, gathered }
    }

    #[inline(always)]
    pub(crate) fn finish(&self) -> Rgba {
        self.gathered.finish()
    }
}

/// Adjacent rays advance together, because memory fetched for one ray serves its neighbours.
#[inline(always)]
pub(crate) fn trace(passage: &Passage, packets: &mut [RayPacket]) {
    let mut longest = 0;
    for packet in &*packets {
        longest = longest.max(packet.rays.longest);
    }
    let mut first = 0;
    while first < longest {
        for packet in &mut *packets {
            if first >= packet.rays.longest {
                continue;
            }
            let segment = packet.rays.segment(&passage.rays.grid, passage.blocks, first);
            if packet.gathered.ignores(segment.range) {
                continue;
            }
            visit(passage, &packet.rays, &segment, &mut packet.gathered);
            if packet.gathered.ignores(Range::ALL) {
                packet.rays.longest = 0;
            }
        }
        first += STEPS as i32;
    }
}

#[inline(always)]
fn visit(passage: &Passage, packet: &Packet, segment: &Segment, gathered: &mut Blend) {
    let line = packet.line(segment);
    let values = passage.sampler.along(segment.base, &line);
    for n in 0..STEPS {
        let value = &values[n];
        let mut present = [0.0; FAN];
        for l in 0..FAN {
            let there = if segment.first + (n as i32) < packet.count[l] { 1.0 } else { 0.0 };
            present[l] = if value[l].is_nan() { 0.0 } else { there };
        }
        let light = Headlight {
            shading: passage.shading,
            sampler: passage.sampler,
            index_from_view: &passage.rays.index_from_view,
            base: segment.base,
            places: line.places(n),
        };
        gathered.add(&Samples { value, present: &present, thickness: &packet.thickness }, &light);
    }
}
