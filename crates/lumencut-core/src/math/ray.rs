//! Rays through the volume: sixteen at a time, cut into equal parts, skipped where nothing can be seen.

use glam::DVec3;

use super::blocks::{Blocks, Range};
use super::lanes::FAN;
use super::sampling::{Grid, PLACE_ROUNDING, Path, Places};
use crate::camera::Camera;
use crate::volume::Volume;

/// The columns and rows of a packet (pixels).
pub const PACKET: [usize; 2] = [4, 4];
/// The parts of a ray that are sampled, or skipped, together.
pub const STEPS: usize = 8;

/// Where a ray starts that crosses the whole volume (depth in mm).
pub const WHOLE: f32 = -1e9;
/// Where a ray starts that is not needed.
pub const NONE: f32 = 1e9;
/// Beyond both.
pub const NEVER: f64 = 2e9;

/// The most samples along a ray, and of a slab.
pub const MOST_SAMPLES: f64 = 65_536.0;

/// A direction that moves less than this along an axis (voxels per mm) runs along the volume's sides.
pub const PARALLEL: f64 = 1e-9;
/// How much of a step a chord may be longer than whole steps without a part more: n voxels have n parts, however n · side
/// is rounded, on a GPU with the digits of `f32`.
pub const SPARE: f64 = 1e-3;

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
    /// Continuous index of each ray at depth 0, and what 1 mm of depth adds to it.
    foot: [[f64; FAN]; 3],
    toward: [f64; 3],
    /// Depth where the first part of each ray begins, and the length of a part (mm).
    near: [f64; FAN],
    part: [f64; FAN],
    /// The number of parts of each ray; 0 where it misses the volume or is not needed.
    pub count: [i32; FAN],
    /// The length of a part (mm).
    pub thickness: [f32; FAN],
    /// The largest number of parts.
    pub longest: i32,
    bounds: Bounds,
}

/// The smallest and the largest of a packet's numbers.
#[derive(Clone, Copy, Debug, Default)]
struct Bounds {
    foot: [[f64; 2]; 3],
    near: [f64; 2],
    part: [f64; 2],
    /// The largest depth where a ray ends.
    far: f64,
}

impl Packet {
    /// The rays at view coordinates `x` and `y` (mm) that start at depth `start`.
    #[inline(always)]
    pub fn new(rays: &Rays, x: &[f64; FAN], y: &[f64; FAN], start: &[f32; FAN]) -> Self {
        let to = &rays.index_from_view;
        let (toward, last) = (to.z.to_array(), rays.grid.last());
        let mut foot = [[0.0; FAN]; 3];
        let (mut near, mut far) = ([0.0; FAN], [f64::from(NONE); FAN]);
        for l in 0..FAN {
            near[l] = f64::from(start[l]);
        }
        for a in 0..3 {
            let parallel = toward[a].abs() < PARALLEL;
            let per_voxel = if parallel { 0.0 } else { 1.0 / toward[a] };
            for l in 0..FAN {
                let o = to.origin[a] + to.x[a] * x[l] + to.y[a] * y[l];
                let (one, other) = ((-0.5 - o) * per_voxel, (last[a] + 0.5 - o) * per_voxel);
                let (enter, leave) = if one < other { (one, other) } else { (other, one) };
                let outside = (o < -0.5) | (o > last[a] + 0.5);
                let enter = if parallel { if outside { NEVER } else { -NEVER } } else { enter };
                let leave = if parallel { NEVER } else { leave };
                near[l] = if enter > near[l] { enter } else { near[l] };
                far[l] = if leave < far[l] { leave } else { far[l] };
                foot[a][l] = o;
            }
        }
        let (mut count, mut part) = ([0; FAN], [0.0; FAN]);
        for l in 0..FAN {
            let chord = far[l] - near[l];
            // The whole number above the quotient, without the system's function.
            let steps = chord / rays.step - SPARE;
            let parts = steps as i32 + i32::from(f64::from(steps as i32) < steps);
            count[l] = if chord > 0.0 { parts.max(1) } else { 0 };
            part[l] = if chord > 0.0 { chord / f64::from(count[l]) } else { 0.0 };
        }
        let mut packet = Self {
            foot,
            toward,
            near,
            part,
            count,
            thickness: [0.0; FAN],
            longest: 0,
            bounds: Bounds::default(),
        };
        for l in 0..FAN {
            packet.thickness[l] = part[l] as f32;
            packet.longest = packet.longest.max(count[l]);
        }
        packet.settle_idle();
        packet.bound();
        packet
    }

    /// Lets the rays that see nothing run along with one that does, so that they widen no range.
    #[inline(always)]
    fn settle_idle(&mut self) {
        let mut busy = 0;
        for l in 0..FAN {
            busy = if self.count[l] > 0 { l } else { busy };
        }
        for l in 0..FAN {
            let model = if self.count[l] > 0 { l } else { busy };
            (self.near[l], self.part[l]) = (self.near[model], self.part[model]);
            for foot in &mut self.foot {
                foot[l] = foot[model];
            }
        }
    }

    #[inline(always)]
    fn bound(&mut self) {
        self.bounds = Bounds {
            foot: [ends(&self.foot[0]), ends(&self.foot[1]), ends(&self.foot[2])],
            near: ends(&self.near),
            part: ends(&self.part),
            far: f64::MIN,
        };
        for l in 0..FAN {
            let far = self.near[l] + self.part[l] * f64::from(self.count[l]);
            self.bounds.far = if far > self.bounds.far { far } else { self.bounds.far };
        }
    }

    /// The parts from `first` on that are sampled together, within bounds of the whole packet.
    #[inline(always)]
    pub fn segment(&self, grid: &Grid, blocks: Option<&Blocks>, first: i32) -> Segment {
        let Bounds { foot, near, part, far } = &self.bounds;
        let begin = near[0] + part[0] * (f64::from(first) + 0.5);
        let end = near[1] + part[1] * (f64::from(first + STEPS as i32) - 0.5);
        let end = if end < *far { end } else { *far };
        let (mut low, mut high) = ([0; 3], [0; 3]);
        let last_cell = grid.last_cell();
        for a in 0..3 {
            let (one, other) = (self.toward[a] * begin, self.toward[a] * end);
            let (less, more) = if one < other { (one, other) } else { (other, one) };
            low[a] = ((foot[a][0] + less - PLACE_ROUNDING) as i32).clamp(0, last_cell[a]);
            high[a] = ((foot[a][1] + more + PLACE_ROUNDING) as i32).clamp(0, last_cell[a]);
        }
        let range = match blocks {
            Some(blocks) => blocks.range(low, high),
            None => Range::ALL,
        };
        Segment { first, base: low, range }
    }

    /// The places of a segment's samples.
    #[inline(always)]
    pub fn line(&self, segment: &Segment) -> Line {
        let mut line = Line { start: [[0.0; FAN]; 3], part: [[0.0; FAN]; 3] };
        for a in 0..3 {
            for l in 0..FAN {
                let depth = self.near[l] + self.part[l] * (f64::from(segment.first) + 0.5);
                let begin = self.foot[a][l] + self.toward[a] * depth;
                line.start[a][l] = (begin - f64::from(segment.base[a])) as f32;
                line.part[a][l] = (self.part[l] * self.toward[a]) as f32;
            }
        }
        line
    }
}

/// The smallest and the largest of sixteen numbers.
#[inline(always)]
fn ends(numbers: &[f64; FAN]) -> [f64; 2] {
    let (mut low, mut high) = (numbers[0], numbers[0]);
    for number in numbers {
        low = if *number < low { *number } else { low };
        high = if *number > high { *number } else { high };
    }
    [low, high]
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
