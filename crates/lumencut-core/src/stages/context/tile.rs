//! Tiles of rays: sixteen packets traced together.

use rayon::prelude::*;

use super::plan::Plan;
use crate::error::Result;
use crate::math::accumulate::Blend;
use crate::math::lanes::{FAN, Kernel, ROWS, dispatch};
use crate::math::ray::{NONE, PACKET, Packet, Rays};
use crate::math::ray_lines::{Lines, RayGrid};
use crate::math::sampler::{Sampler, TypedSampler};
use crate::math::trace::{Passage, RayPacket, trace};
use crate::stages::Work;
use crate::with_voxels;

const TILE: [usize; 2] = [32, ROWS];
const ACROSS: usize = TILE[0] / PACKET[0];

pub(super) fn trace_raster(
    work: &Work,
    plan: &Plan,
    raster: &RayGrid,
    start: &[f32],
    pixels: &mut [[f32; 4]],
) -> Result<()> {
    let (grid, isa) = (plan.rays.grid, work.isa);
    with_voxels!(plan.volume.voxels(), voxels => {
        trace_tiles(work, plan, &TypedSampler { grid, voxels, isa }, raster, start, pixels)
    })
}

fn trace_tiles(
    work: &Work,
    plan: &Plan,
    sampler: &dyn Sampler,
    raster: &RayGrid,
    start: &[f32],
    pixels: &mut [[f32; 4]],
) -> Result<()> {
    let width = raster.size[0];
    let rows = pixels.par_chunks_mut(ROWS * width).zip(start.par_chunks(ROWS * width));
    rows.enumerate().try_for_each(|(row, (pixels, start))| {
        for column in (0..width).step_by(TILE[0]) {
            work.begin(ROWS * TILE[0])?;
            let place = [column, row * ROWS];
            let tile = Tile { plan, sampler, raster, place, start, pixels: &mut *pixels };
            dispatch(work.isa, tile);
        }
        Ok(())
    })
}

struct Tile<'a> {
    plan: &'a Plan<'a>,
    sampler: &'a dyn Sampler,
    raster: &'a RayGrid,
    place: [usize; 2],
    start: &'a [f32],
    pixels: &'a mut [[f32; 4]],
}

impl Kernel for Tile<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let plan = self.plan;
        let mut packets: Vec<RayPacket> = Vec::with_capacity(TILE[0] * TILE[1] / FAN);
        for n in 0..TILE[0] * TILE[1] / FAN {
            let packet = self.packet(n);
            let active = packet.count.map(|count| count > 0);
            packets.push(RayPacket::new(packet, Blend::new(&plan.palette, &active)));
        }
        let Plan { rays, blocks, shading, .. } = plan;
        trace(&Passage { rays, sampler: self.sampler, blocks: *blocks, shading: *shading }, &mut packets);
        for (n, packet) in packets.iter().enumerate() {
            let gathered = packet.finish();
            for l in 0..FAN {
                if let Some(pixel) = self.pixel(n, l) {
                    self.pixels[pixel] = gathered.map(|channel| channel[l]);
                }
            }
        }
    }
}

impl Tile<'_> {
    /// The column and row of a ray in the image part; rows are counted from its first row.
    #[inline(always)]
    fn ray(&self, packet: usize, lane: usize) -> [usize; 2] {
        let column = self.place[0] + packet % ACROSS * PACKET[0] + lane % PACKET[0];
        [column, packet / ACROSS * PACKET[1] + lane / PACKET[0]]
    }

    #[inline(always)]
    fn pixel(&self, packet: usize, lane: usize) -> Option<usize> {
        let ([i, j], width) = (self.ray(packet, lane), self.raster.size[0]);
        (i < width && j * width < self.pixels.len()).then_some(j * width + i)
    }

    #[inline(always)]
    fn packet(&self, n: usize) -> Packet {
        let Rays { grid, index_from_view, step } = &self.plan.rays;
        let (first, width) = (self.place[1], self.raster.size[0]);
        let mut pixels = [None; FAN];
        for (l, pixel) in pixels.iter_mut().enumerate() {
            *pixel = self.pixel(n, l).map(|pixel| [pixel % width, first + pixel / width]);
        }
        let chord = |[i, j]: [usize; 2]| [f64::from(self.start[(j - first) * width + i]), f64::from(NONE)];
        Packet::new(grid, Lines::of_pixels(index_from_view, self.raster, &pixels, chord), *step)
    }
}
