//! Rays through the volume: sixteen at a time, cut into equal parts, skipped where nothing can be seen.

use glam::DVec3;

use super::blocks::{Blocks, Range};
use super::lanes::FAN;
use super::sampling::{Grid, Path, Places};
use crate::camera::Camera;
use crate::volume::Volume;

/// The side of a packet (pixels).
pub const PACKET: usize = 4;
/// The parts of a ray that are sampled, or skipped, together.
pub const STEPS: usize = 8;

/// Where a ray starts that crosses the whole volume (depth in mm).
pub const WHOLE: f32 = -1e9;
/// Where a ray starts that is not needed.
pub const NONE: f32 = 1e9;

/// A direction that moves less than this along an axis (voxels per mm) runs along the volume's sides.
const PARALLEL: f64 = 1e-9;
/// How much of a step a chord may be longer than whole steps without a part more: n voxels have n parts, however n · side
/// is rounded.
const SPARE: f64 = 1e-6;
/// Wider than what rounding moves a place (voxels).
const ROUNDING: f64 = 1e-3;

/// Continuous index as an affine map of view coordinates.
#[derive(Clone, Copy, Debug)]
pub struct IndexFromView {
    /// The index of the origin of view space.
    pub origin: DVec3,
    /// Index per mm to the right.
    pub x: DVec3,
    /// Index per mm upwards.
    pub y: DVec3,
    /// Index per mm away from the viewer.
    pub z: DVec3,
}

impl IndexFromView {
    /// The map of one view of `volume`.
    pub fn new(volume: &Volume, camera: &Camera) -> Self {
        let index_from_world = volume.index_from_world();
        Self {
            origin: index_from_world.transform_point3(camera.center()),
            x: index_from_world.transform_vector3(camera.right()),
            y: index_from_world.transform_vector3(camera.up()),
            z: index_from_world.transform_vector3(camera.direction()),
        }
    }
}

/// What all rays of a view share.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// The grid of the volume.
    pub grid: Grid,
    /// From view to index.
    pub index_from_view: IndexFromView,
    /// The longest part of a ray that one sample stands for (mm).
    pub step: f64,
}

impl Rays {
    /// The rays of one view of `volume`, sampled at least every `step` mm.
    pub fn new(volume: &Volume, camera: &Camera, step: f64) -> Self {
        Self { grid: Grid::new(volume), index_from_view: IndexFromView::new(volume, camera), step }
    }
}

/// Sixteen rays of a square of pixels. The chord of each within the volume, from where it starts, is cut into equal
/// parts no longer than a step; each is sampled in its middle. So the parts of a ray fill it, whatever the step.
#[derive(Clone, Debug)]
pub struct Packet {
    /// Continuous index where each ray's first part begins.
    origin: [[f64; FAN]; 3],
    /// Index per part of each ray.
    part: [[f64; FAN]; 3],
    /// The number of parts of each ray; 0 where it misses the volume or is not needed.
    pub count: [i32; FAN],
    /// The length of a part (mm).
    pub thickness: [f32; FAN],
    /// The largest number of parts.
    pub longest: i32,
}

impl Packet {
    /// The rays at view coordinates `x` and `y` (mm) that start at depth `start`.
    #[inline(always)]
    pub fn new(rays: &Rays, x: &[f64; FAN], y: &[f64; FAN], start: &[f32; FAN]) -> Self {
        let to = &rays.index_from_view;
        let (toward, last) = (to.z.to_array(), rays.grid.last());
        let mut origin = [[0.0; FAN]; 3];
        let (mut near, mut far) = ([0.0; FAN], [1e9; FAN]);
        for l in 0..FAN {
            near[l] = f64::from(start[l]);
        }
        for a in 0..3 {
            let (ox, oy) = (to.x[a], to.y[a]);
            let parallel = toward[a].abs() < PARALLEL;
            let per_voxel = if parallel { 0.0 } else { 1.0 / toward[a] };
            for l in 0..FAN {
                let o = to.origin[a] + ox * x[l] + oy * y[l];
                let (one, other) = ((-0.5 - o) * per_voxel, (last[a] + 0.5 - o) * per_voxel);
                let (enter, leave) = if one < other { (one, other) } else { (other, one) };
                let outside = (o < -0.5) | (o > last[a] + 0.5);
                let enter = if parallel { if outside { 2e9 } else { -2e9 } } else { enter };
                let leave = if parallel { 2e9 } else { leave };
                near[l] = if enter > near[l] { enter } else { near[l] };
                far[l] = if leave < far[l] { leave } else { far[l] };
                origin[a][l] = o;
            }
        }
        let mut packet =
            Self { origin, part: [[0.0; FAN]; 3], count: [0; FAN], thickness: [0.0; FAN], longest: 0 };
        for l in 0..FAN {
            let chord = far[l] - near[l];
            let parts = if chord > 0.0 { (chord / rays.step - SPARE).ceil().max(1.0) } else { 0.0 };
            let length = if chord > 0.0 { chord / parts } else { 0.0 };
            let near = if chord > 0.0 { near[l] } else { 0.0 };
            packet.count[l] = parts as i32;
            packet.thickness[l] = length as f32;
            packet.longest = packet.longest.max(parts as i32);
            for a in 0..3 {
                packet.origin[a][l] += near * toward[a];
                packet.part[a][l] = length * toward[a];
            }
        }
        packet.settle_idle();
        packet
    }

    /// Lets the rays that see nothing run along with one that does, so that they widen no range.
    #[inline(always)]
    fn settle_idle(&mut self) {
        let Some(busy) = (0..FAN).find(|l| self.count[*l] > 0) else { return };
        for l in 0..FAN {
            for a in 0..3 {
                let idle = self.count[l] == 0;
                self.origin[a][l] = if idle { self.origin[a][busy] } else { self.origin[a][l] };
                self.part[a][l] = if idle { self.part[a][busy] } else { self.part[a][l] };
            }
        }
    }

    /// The parts from `first` on that are sampled together.
    #[inline(always)]
    pub fn segment(&self, grid: &Grid, blocks: Option<&Blocks>, first: i32) -> Segment {
        let mut low = [0; 3];
        let mut high = [0; 3];
        let last_cell = grid.last_cell();
        for a in 0..3 {
            let (mut least, mut most) = (i32::MAX, 0);
            for l in 0..FAN {
                let last = self.count[l].max(1) - 1;
                let (from, to) = (first.min(last), (first + STEPS as i32 - 1).min(last));
                let begin = self.origin[a][l] + self.part[a][l] * (f64::from(from) + 0.5);
                let end = self.origin[a][l] + self.part[a][l] * (f64::from(to) + 0.5);
                let (one, other) = if begin < end { (begin, end) } else { (end, begin) };
                least = least.min((one - ROUNDING) as i32);
                most = most.max((other + ROUNDING) as i32);
            }
            low[a] = least.clamp(0, last_cell[a]);
            high[a] = most.clamp(0, last_cell[a]);
        }
        Segment { first, base: low, range: blocks.map_or(Range::ALL, |blocks| blocks.range(low, high)) }
    }

    /// The places of a segment's samples.
    #[inline(always)]
    pub fn line(&self, segment: &Segment) -> Line {
        let mut line = Line { start: [[0.0; FAN]; 3], part: [[0.0; FAN]; 3] };
        for a in 0..3 {
            for l in 0..FAN {
                let begin = self.origin[a][l] + self.part[a][l] * (f64::from(segment.first) + 0.5);
                line.start[a][l] = (begin - f64::from(segment.base[a])) as f32;
                line.part[a][l] = self.part[a][l] as f32;
            }
        }
        line
    }
}

/// Some parts of a packet's rays in a row.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// The first part.
    pub first: i32,
    /// A voxel before all its samples.
    pub base: [i32; 3],
    /// The values that its samples can have.
    pub range: Range,
}

/// The places of a segment's samples, counted from its base.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    start: Places,
    part: Places,
}

impl Path for Line {
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
