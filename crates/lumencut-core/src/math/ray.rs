//! Rays through the volume: sixteen at a time, cut into equal parts; parts that show nothing are skipped.

use super::blocks::{Blocks, Range};
use super::lanes::FAN;
use super::ray_lines::{IndexFromView, Lines};
pub use super::ray_lines::{NEVER, NONE, WHOLE};
use super::sampling::{Grid, POSITION_ROUNDING, Places, SampledRun};
use crate::camera::Camera;
use crate::volume::Volume;

pub(crate) const PACKET: [usize; 2] = [4, 4];
/// Number of parts of a ray that are sampled or skipped together.
pub(crate) const STEPS: usize = 8;

/// The largest number of samples along a ray and across a slab.
pub(crate) const MAX_SAMPLES: f64 = 65_536.0;

/// A chord that exceeds n steps by less than this share of a step still has n parts, so that rounding adds none.
pub const SPARE: f64 = 1e-3;

/// The data that all rays of a view share.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    pub grid: Grid,
    pub(crate) index_from_view: IndexFromView,
    pub step: f64,
}

impl Rays {
    /// The rays of one view of `volume`, in parts of at most `step` mm.
    pub fn new(volume: &Volume, camera: &Camera, step: f64) -> Self {
        Self { grid: Grid::new(volume), index_from_view: IndexFromView::new(volume, camera), step }
    }
}

/// Sixteen rays of a square of pixels, each cut into equal parts no longer than a step.
#[derive(Clone, Debug)]
pub(crate) struct Packet {
    lines: Lines,
    part: [f64; FAN],
    /// The number of parts of each ray; 0 if the ray misses the volume or is not needed.
    pub count: [i32; FAN],
    pub thickness: [f32; FAN],
    pub longest: i32,
    bounds: Bounds,
}

#[derive(Clone, Copy, Debug, Default)]
struct Bounds {
    foot: [[f64; 2]; 3],
    toward: [[f64; 2]; 3],
    near: [f64; 2],
    part: [f64; 2],
    far: f64,
}

impl Packet {
    #[inline(always)]
    pub(crate) fn new(grid: &Grid, mut lines: Lines, step: f64) -> Self {
        lines.clip(grid);
        let (mut count, mut part) = ([0; FAN], [0.0; FAN]);
        for l in 0..FAN {
            let chord = lines.far[l] - lines.near[l];
            // Rounds up without calling `ceil`.
            let steps = chord / step - SPARE;
            let parts = steps as i32 + i32::from(f64::from(steps as i32) < steps);
            count[l] = if chord > 0.0 { parts.max(1) } else { 0 };
            part[l] = if chord > 0.0 { chord / f64::from(count[l]) } else { 0.0 };
        }
        let bounds = Bounds::default();
        let mut packet = Self { lines, part, count, thickness: [0.0; FAN], longest: 0, bounds };
        for l in 0..FAN {
            packet.thickness[l] = part[l] as f32;
            packet.longest = packet.longest.max(count[l]);
        }
        packet.fill_idle_lanes();
        packet.bound();
        packet
    }

    /// Replaces rays that need no samples by a copy of one that does, so that they do not widen bounds.
    #[inline(always)]
    fn fill_idle_lanes(&mut self) {
        let mut busy = 0;
        for l in 0..FAN {
            busy = if self.count[l] > 0 { l } else { busy };
        }
        for l in 0..FAN {
            let model = if self.count[l] > 0 { l } else { busy };
            (self.lines.near[l], self.part[l]) = (self.lines.near[model], self.part[model]);
            for a in 0..3 {
                self.lines.foot[a][l] = self.lines.foot[a][model];
                self.lines.toward[a][l] = self.lines.toward[a][model];
            }
        }
    }

    #[inline(always)]
    fn bound(&mut self) {
        let Lines { foot, toward, near, .. } = &self.lines;
        self.bounds = Bounds {
            foot: [ends(&foot[0]), ends(&foot[1]), ends(&foot[2])],
            toward: [ends(&toward[0]), ends(&toward[1]), ends(&toward[2])],
            near: ends(near),
            part: ends(&self.part),
            far: f64::MIN,
        };
        for l in 0..FAN {
            let far = near[l] + self.part[l] * f64::from(self.count[l]);
            self.bounds.far = if far > self.bounds.far { far } else { self.bounds.far };
        }
    }

    /// The segment from part `first` on, with samples in the middle of its parts, and with bounds of all rays.
    #[inline(always)]
    pub(crate) fn segment(&self, grid: &Grid, blocks: Option<&Blocks>, first: i32) -> Segment {
        let [first_part, end_part] = [f64::from(first) + 0.5, f64::from(first + STEPS as i32) - 0.5];
        self.between(grid, blocks, first, [first_part, end_part])
    }

    #[inline(always)]
    pub(crate) fn whole_segment(
        &self,
        grid: &Grid,
        blocks: Option<&Blocks>,
        first: i32,
        count: i32,
    ) -> Segment {
        self.between(grid, blocks, first, [f64::from(first), f64::from(first + count)])
    }

    /// The segment from part `first` on; its bounds hold the samples in an interval, counted in parts.
    #[inline(always)]
    fn between(&self, grid: &Grid, blocks: Option<&Blocks>, first: i32, parts: [f64; 2]) -> Segment {
        let Bounds { foot, toward, near, part, far } = &self.bounds;
        let begin = near[0] + part[0] * parts[0];
        let end = near[1] + part[1] * parts[1];
        let end = if end < *far { end } else { *far };
        let (mut low, mut high) = ([0; 3], [0; 3]);
        let last_cell = grid.last_cell();
        for a in 0..3 {
            let ways = [toward[a][0] * begin, toward[a][0] * end, toward[a][1] * begin, toward[a][1] * end];
            let (mut less, mut more) = (ways[0], ways[0]);
            for way in ways {
                less = if way < less { way } else { less };
                more = if way > more { way } else { more };
            }
            low[a] = ((foot[a][0] + less - POSITION_ROUNDING) as i32).clamp(0, last_cell[a]);
            high[a] = ((foot[a][1] + more + POSITION_ROUNDING) as i32).clamp(0, last_cell[a]);
        }
        let range = match blocks {
            Some(blocks) => blocks.range(low, high),
            None => Range::ALL,
        };
        Segment { first, base: low, range }
    }

    #[inline(always)]
    pub(crate) fn line(&self, segment: &Segment) -> Line {
        Line { start: self.places(segment, 0.5), part: self.way(1.0) }
    }

    #[inline(always)]
    pub(crate) fn stretch(&self, segment: &Segment, count: i32) -> RaySpan {
        let count = count as f32;
        let mut stretch = RaySpan {
            start: self.places(segment, 0.0),
            way: self.way(f64::from(count)),
            end: [0.0; FAN],
            length: [0.0; FAN],
        };
        for l in 0..FAN {
            let left = (self.count[l] - segment.first) as f32;
            stretch.end[l] = if left < count { left / count } else { 1.0 };
            stretch.length[l] = self.thickness[l] * count;
        }
        stretch
    }

    #[inline(always)]
    fn places(&self, segment: &Segment, parts: f64) -> Places {
        let mut places = [[0.0; FAN]; 3];
        for a in 0..3 {
            for l in 0..FAN {
                let depth = self.lines.near[l] + self.part[l] * (f64::from(segment.first) + parts);
                let begin = self.lines.foot[a][l] + self.lines.toward[a][l] * depth;
                places[a][l] = (begin - f64::from(segment.base[a])) as f32;
            }
        }
        places
    }

    #[inline(always)]
    fn way(&self, parts: f64) -> Places {
        let mut way = [[0.0; FAN]; 3];
        for a in 0..3 {
            for l in 0..FAN {
                way[a][l] = (self.part[l] * parts * self.lines.toward[a][l]) as f32;
            }
        }
        way
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct RaySpan {
    /// The positions at which the rays begin (voxels).
    pub start: Places,
    pub way: Places,
    /// The end of each ray, as a share of the segment; at most 0 if the ray has ended before.
    pub end: [f32; FAN],
    pub length: [f32; FAN],
}

#[inline(always)]
fn ends(numbers: &[f64; FAN]) -> [f64; 2] {
    let (mut low, mut high) = (numbers[0], numbers[0]);
    for number in numbers {
        low = if *number < low { *number } else { low };
        high = if *number > high { *number } else { high };
    }
    [low, high]
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub first: i32,
    /// A voxel at or before all samples of the segment along each axis.
    pub base: [i32; 3],
    pub range: Range,
}

/// The positions of a segment's samples, counted from its base.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    start: Places,
    part: Places,
}

impl SampledRun for Line {
    #[inline(always)]
    fn places(&self, n: usize) -> Places {
        let mut places = self.start;
        for a in 0..3 {
            for l in 0..FAN {
                places[a][l] += self.part[a][l] * n as f32;
            }
        }
        places
    }
}
