//! The exact largest, smallest or mean value of the volume along rays: over the whole chord, not sampled.

use rayon::prelude::*;

use super::Work;
use crate::error::Result;
use crate::math::blocks::{Blocks, HUGE, Range};
use crate::math::lanes::{FAN, Kernel, ROWS, dispatch, smaller, smallest};
use crate::math::ray::{PACKET, Packet, Segment};
use crate::math::ray_lines::{IndexFromView, Lines, RayGrid};
use crate::math::reduce::Reduction;
use crate::math::sampler::{Sampler, TypedSampler};
use crate::math::sampling::Grid;
use crate::volume::Volume;
use crate::with_voxels;

/// A reduction of the values along the rays of an image.
#[derive(Clone, Copy)]
pub struct AlongRays<'a> {
    pub size: [usize; 2],
    pub volume: &'a Volume<'a>,
    /// Blocks to skip; `None` reads everything, with the same result.
    pub blocks: Option<&'a Blocks>,
    pub reduction: Reduction,
    /// Values above this make no difference; if the smallest value is wanted, values below this.
    pub limit: f32,
    /// The longest part of a ray (mm): about a voxel.
    pub step: f64,
}

pub trait RaySource: Sync {
    fn lines(&self, pixels: &[Option<[usize; 2]>; FAN]) -> Lines;
}

/// The parallel rays of a view; `chord` returns the two depths (mm) between which a pixel's ray runs.
pub struct ViewRays<F> {
    pub to: IndexFromView,
    pub rays: RayGrid,
    pub chord: F,
}

impl<F: Fn(usize) -> [f64; 2] + Sync> RaySource for ViewRays<F> {
    fn lines(&self, pixels: &[Option<[usize; 2]>; FAN]) -> Lines {
        Lines::of_pixels(&self.to, &self.rays, pixels, |[i, j]| (self.chord)(j * self.rays.size[0] + i))
    }
}

/// Writes the value of each ray; NaN if it meets no value.
pub fn along_rays(work: &Work, along: &AlongRays, source: &dyn RaySource, values: &mut [f32]) -> Result<()> {
    let (grid, isa, width) = (Grid::new(along.volume), work.isa, along.size[0]);
    with_voxels!(along.volume.voxels(), voxels => {
        let sampler: &dyn Sampler = &TypedSampler { grid, voxels, isa };
        values.par_chunks_mut(ROWS * width).enumerate().try_for_each(|(row, values)| {
            for column in (0..width).step_by(PACKET[0]) {
                if column % COLUMNS_PER_CHECK == 0 {
                    work.begin(ROWS * COLUMNS_PER_CHECK)?;
                }
                for first in (0..ROWS).step_by(PACKET[1]) {
                    let place = [column, first];
                    dispatch(isa, Square { along, grid, sampler, source, row: row * ROWS, place, values: &mut *values });
                }
            }
            Ok(())
        })
    })
}

/// Number of parts of a ray that are followed or skipped together.
const PARTS_TOGETHER: i32 = 8;

const COLUMNS_PER_CHECK: usize = 32;

struct Square<'a> {
    along: &'a AlongRays<'a>,
    grid: Grid,
    sampler: &'a dyn Sampler,
    source: &'a dyn RaySource,
    row: usize,
    place: [usize; 2],
    values: &'a mut [f32],
}

impl Kernel for Square<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut pixels = [None; FAN];
        for (l, pixel) in pixels.iter_mut().enumerate() {
            let [i, j] = [self.place[0] + l % PACKET[0], self.place[1] + l / PACKET[0]];
            if i < self.along.size[0] && j * self.along.size[0] < self.values.len() {
                *pixel = Some([i, self.row + j]);
            }
        }
        let packet = Packet::new(&self.grid, self.source.lines(&pixels), self.along.step);
        let found = match self.along.reduction {
            Reduction::Largest => self.largest(&packet, 1.0),
            Reduction::Smallest => self.largest(&packet, -1.0),
            Reduction::Mean => self.mean(&packet),
        };
        for (pixel, found) in pixels.iter().zip(found) {
            if let Some([i, j]) = pixel {
                self.values[(j - self.row) * self.along.size[0] + i] = found;
            }
        }
    }
}

impl Square<'_> {
    /// Finds the largest values of `sign` · volume, beginning with the segments that may hold the largest.
    #[inline(always)]
    fn largest(&self, packet: &Packet, sign: f32) -> [f32; FAN] {
        let limit = self.along.limit * sign;
        let top = |range: Range| smaller(if sign > 0.0 { range.high } else { -range.low }, limit);
        let mut segments: Vec<Segment> = self.segments(packet).collect();
        segments.sort_by(|one, other| top(other.range).total_cmp(&top(one.range)));
        let mut best = packet.count.map(|count| if count > 0 { -HUGE } else { HUGE });
        for segment in &segments {
            if top(segment.range) <= smallest(&best) {
                break;
            }
            self.sampler.widen(
                segment.base,
                &packet.stretch(segment, PARTS_TOGETHER),
                [sign, limit],
                &mut best,
            );
        }
        best.map(|best| if best > -HUGE && best < HUGE { best * sign } else { f32::NAN })
    }

    #[inline(always)]
    fn mean(&self, packet: &Packet) -> [f32; FAN] {
        let mut sums = [[0.0; FAN]; 2];
        for segment in self.segments(packet) {
            self.sampler.sum_up(segment.base, &packet.stretch(&segment, PARTS_TOGETHER), &mut sums);
        }
        let mut mean = [f32::NAN; FAN];
        for l in 0..FAN {
            mean[l] = if sums[1][l] > 0.0 { (sums[0][l] / sums[1][l]) as f32 } else { f32::NAN };
        }
        mean
    }

    #[inline(always)]
    fn segments<'b>(&'b self, packet: &'b Packet) -> impl Iterator<Item = Segment> + 'b {
        let blocks = if self.along.reduction == Reduction::Mean { None } else { self.along.blocks };
        (0..packet.longest)
            .step_by(PARTS_TOGETHER as usize)
            .map(move |first| packet.whole_segment(&self.grid, blocks, first, PARTS_TOGETHER))
    }
}
