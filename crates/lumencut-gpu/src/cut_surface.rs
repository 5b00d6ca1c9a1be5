//! The stages that make the cut surface: projection, distance and depth.

use std::mem::offset_of;

use lumencut_core::math::levels::{CutSurfaceParameters, LevelPlace};
use lumencut_core::pipeline::Request;
use lumencut_core::settings::{MAX_LEVELS, Settings};
use wgpu::Buffer;

use crate::device::Device;
use crate::images::Images;
use crate::levels::DeviceLevels;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

/// The quads side by side and the rows of a thread's tile.
pub(crate) const TILE: [usize; 2] = [1, 4];
/// The pixels of a quad, the tiles of a group of threads, and how many of them lie side by side.
pub(crate) const QUAD: usize = 4;
pub(crate) const TILES: usize = 64;
pub(crate) const TILES_ACROSS: usize = 4;
/// The threads of a group that projects points.
pub(crate) const POINT_THREADS: u32 = 64;
/// The most groups along one side of a dispatch.
const MOST_GROUPS: u32 = 65_535;

/// The stages, and what they read in every view.
#[derive(Debug)]
pub(crate) struct CutSurfaceStages {
    projection: Stage,
    bundle: Stage,
    enclose: Stage,
    distance: Stage,
    /// Without and with *lumen first*.
    depth: [Stage; 2],
    parameters: Buffer,
    /// Where the levels lie, as the shaders were last told.
    told: Option<[LevelPlace; MAX_LEVELS + 1]>,
    /// The pixels of a group of threads.
    group: [usize; 2],
}

impl CutSurfaceStages {
    /// Compiles the stages.
    pub fn new(device: &Device) -> Self {
        let [across, rows] = TILE;
        let tile = [("ACROSS", across as f64), ("ROWS", rows as f64)];
        let depth = |lumen_first| {
            Stage::new(device, "stages/depth", &[tile[0], tile[1], ("LUMEN_FIRST", lumen_first)])
        };
        Self {
            projection: Stage::new(device, "math/projection", &[]),
            bundle: Stage::entry(device, "math/projection", "bundle", &[]).with_first_binding(2),
            enclose: Stage::entry(device, "math/projection", "enclose", &[]).with_first_binding(1),
            distance: Stage::new(device, "stages/distance", &tile),
            depth: [depth(0.0), depth(1.0)],
            group: [across * QUAD * TILES_ACROSS, rows * TILES / TILES_ACROSS],
            told: None,
            parameters: device.uniform::<CutSurfaceParameters>("cut surface parameters"),
        }
    }

    /// Tells the shaders of a view of `levels`; where the levels lie only once.
    pub fn look(&mut self, device: &Device, levels: &DeviceLevels, request: &Request) {
        let parameters = levels.parameters(request.camera, request.settings);
        let bytes = bytemuck::bytes_of(&parameters);
        let is_told = self.told.as_ref() == Some(&parameters.levels);
        let count = if is_told { offset_of!(CutSurfaceParameters, levels) } else { bytes.len() };
        device.write(&self.parameters, &bytes[..count]);
        self.told = Some(parameters.levels);
    }

    /// Projects the levels that are needed: their points, then what stands at each, then the boxes around them.
    pub fn project(&self, recording: &mut Recording, view: &Buffer, levels: &DeviceLevels, coarsest: usize) {
        let all = [view, &self.parameters, &levels.next_points, &levels.points, &levels.projected];
        let points = levels.point_count(coarsest).div_ceil(POINT_THREADS);
        recording.run(&self.projection, &all.map(Buffer::as_entire_binding), in_rows(points));
        let all = [&levels.spans, &levels.points, &levels.projected, &levels.slots];
        let spans = levels.span_count(coarsest);
        recording.run(&self.bundle, &all.map(Buffer::as_entire_binding), in_rows(spans));
        let all = [&self.parameters, &levels.slots, &levels.boxes];
        recording.run(&self.enclose, &all.map(Buffer::as_entire_binding), [coarsest as u32 + 1, 1]);
    }

    /// The distance of every pixel to the finest level.
    pub fn distance(&self, recording: &mut Recording, view: &Buffer, levels: &DeviceLevels, images: &Images) {
        let all = [view, &self.parameters, &levels.slots, &levels.boxes, &images.distance];
        recording.run(&self.distance, &all.map(Buffer::as_entire_binding), groups(images.size, self.group));
    }

    /// Depth, into a buffer of its own choice, and vessel of every pixel.
    pub fn depth(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        levels: &DeviceLevels,
        rule: Visibility,
        images: &Images,
        depth: &Buffer,
    ) {
        let Images { size, distance, vessel, .. } = images;
        let (slots, boxes, of_slot) = (&levels.slots, &levels.boxes, &levels.vessel_of_slot);
        let all = [view, &self.parameters, slots, boxes, distance, of_slot, depth, vessel];
        let stage = &self.depth[rule as usize];
        recording.run(stage, &all.map(Buffer::as_entire_binding), groups(*size, self.group));
    }
}

/// Which pieces win: those of the smallest cost, or lumen before all else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Visibility {
    /// By the cost alone.
    Cost = 0,
    /// *Lumen first*.
    LumenFirst = 1,
}

impl Visibility {
    /// The rule that `settings` ask for.
    pub fn of(settings: &Settings) -> Self {
        if settings.lumen_first { Self::LumenFirst } else { Self::Cost }
    }
}

/// The size of a dispatch of at least `groups` groups, in rows no longer than one allows.
fn in_rows(groups: u32) -> [u32; 2] {
    let across = groups.min(MOST_GROUPS);
    [across, groups.div_ceil(across)]
}
