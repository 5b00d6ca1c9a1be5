//! The stages that make the cut surface: projection, distance and depth.

use std::mem::offset_of;
use std::sync::OnceLock;

use lumencut_core::math::levels::{CutSurfaceParameters, LevelLayout};
use lumencut_core::pipeline::Request;
use lumencut_core::settings::{DistanceRule, LevelChoice, MAX_LEVELS};
use lumencut_core::stages::Stage as Table;
use lumencut_core::stages::focus::FocusParameters;
use wgpu::Buffer;

use crate::device::Device;
use crate::images::Images;
use crate::levels::DeviceLevels;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

/// Columns of quads and rows in a thread's tile on software adapters: large, so that each read serves many pixels.
pub(crate) const TILE_ON_SOFTWARE: [usize; 2] = [1, 4];
/// Columns of quads and rows in a thread's tile on hardware: small, so that there are many threads.
pub(crate) const TILE_ON_HARDWARE: [usize; 2] = [1, 1];
/// The number of pixels in a quad; the number of tiles in a workgroup, and of tiles in its rows.
pub(crate) const QUAD: usize = 4;
pub(crate) const TILES: usize = 64;
pub(crate) const TILES_ACROSS: usize = 4;
pub(crate) const POINT_THREADS: u32 = 64;
/// The largest number of workgroups along one side of a dispatch.
const MAX_GROUPS: u32 = 65_535;

#[derive(Debug)]
pub(crate) struct CutSurfaceStages {
    projection: Stage,
    bundle: Stage,
    enclose: Stage,
    distance: Stage,
    /// Compiled when needed.
    focus: OnceLock<Stage>,
    focus_parameters: Buffer,
    /// A stage for each combination of rules that was needed.
    depth: Vec<(DepthRules, Stage)>,
    parameters: Buffer,
    /// The layout of the levels that was written last.
    written_layout: Option<[LevelLayout; MAX_LEVELS + 1]>,
    /// Width and height of a workgroup (pixels).
    group: [usize; 2],
}

impl CutSurfaceStages {
    pub(crate) fn new(device: &Device) -> Self {
        let [across, rows] = tile_of(device);
        let tile = [("ACROSS", across as f64), ("ROWS", rows as f64)];
        Self {
            projection: Stage::new(device, "math/projection", &[]),
            bundle: Stage::entry(device, "math/projection", "bundle", &[]).with_first_binding(2),
            enclose: Stage::entry(device, "math/projection", "enclose", &[]).with_first_binding(1),
            distance: Stage::new(device, "stages/distance", &tile),
            focus: OnceLock::new(),
            focus_parameters: device.image("focus parameters", 1, size_of::<FocusParameters>()),
            depth: Vec::new(),
            group: [across * QUAD * TILES_ACROSS, rows * TILES / TILES_ACROSS],
            written_layout: None,
            parameters: device.uniform::<CutSurfaceParameters>("cut surface parameters"),
        }
    }

    /// Writes the parameters of a view; writes the layout of levels only once.
    pub(crate) fn look(&mut self, device: &Device, levels: &DeviceLevels, request: &Request) {
        let parameters = levels.parameters(request.camera, request.settings);
        let bytes = bytemuck::bytes_of(&parameters);
        let is_told = self.written_layout.as_ref() == Some(&parameters.levels);
        let count = if is_told { offset_of!(CutSurfaceParameters, levels) } else { bytes.len() };
        device.write(&self.parameters, &bytes[..count]);
        self.written_layout = Some(parameters.levels);
    }

    /// Projects the needed levels: their points, then wedges, then boxes.
    pub(crate) fn project(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        levels: &DeviceLevels,
        coarsest: usize,
    ) {
        let all = [view, &self.parameters, &levels.alongs, &levels.points, &levels.projected];
        let points = levels.point_count(coarsest).div_ceil(POINT_THREADS);
        recording.run(&self.projection, &all.map(Buffer::as_entire_binding), in_rows(points));
        let all = [&levels.spans, &levels.points, &levels.projected, &levels.slots];
        let spans = levels.span_count(coarsest);
        recording.run(&self.bundle, &all.map(Buffer::as_entire_binding), in_rows(spans));
        let all = [&self.parameters, &levels.slots, &levels.boxes];
        recording.run(&self.enclose, &all.map(Buffer::as_entire_binding), [coarsest as u32 + 1, 1]);
    }

    pub(crate) fn distance(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        levels: &DeviceLevels,
        images: &Images,
    ) {
        let all = [view, &self.parameters, &levels.slots, &levels.boxes, &images.distance];
        recording.run(&self.distance, &all.map(Buffer::as_entire_binding), groups(images.size, self.group));
    }

    pub(crate) fn focus(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        levels: &DeviceLevels,
        parameters: FocusParameters,
        images: &Images,
    ) {
        let device = recording.device;
        device.write(&self.focus_parameters, &[parameters]);
        let stage = self.focus.get_or_init(|| {
            let [across, rows] = tile_of(device).map(|n| n as f64);
            Stage::new(device, "stages/focus", &[("ACROSS", across), ("ROWS", rows)])
        });
        let (slots, boxes) = (&levels.slots, &levels.boxes);
        let all = [view, &self.parameters, slots, boxes, &images.focus, &self.focus_parameters];
        recording.run(stage, &all.map(Buffer::as_entire_binding), groups(images.size, self.group));
    }

    /// Writes depth, vessel and details of every pixel.
    pub(crate) fn depth(
        &mut self,
        recording: &mut Recording,
        view: &Buffer,
        levels: &DeviceLevels,
        rules: DepthRules,
        images: &Images,
        depth: &Buffer,
    ) {
        let Images { size, distance, vessel, .. } = images;
        // No buffer may be bound twice; a foot is not written together with a blend.
        let (details, foot) = match rules.details {
            Details::None | Details::Sheet => (&images.sheet, &images.gathered),
            Details::Blend => (&images.gathered, &images.sheet),
        };
        let (slots, boxes) = (&levels.slots, &levels.boxes);
        let last = if rules.is_own { &levels.spans } else { distance };
        let parameters = self.parameters.clone();
        let all = [view, &parameters, slots, boxes, foot, depth, vessel, details, &levels.projected, last];
        let groups = groups(*size, self.group);
        let stage = self.depth_stage(recording.device, rules);
        recording.run(stage, &all.map(Buffer::as_entire_binding), groups);
    }

    fn depth_stage(&mut self, device: &Device, rules: DepthRules) -> &Stage {
        let known = self.depth.iter().position(|(known, _)| *known == rules);
        let at = known.unwrap_or_else(|| {
            self.depth.push((rules, rules.stage(device)));
            self.depth.len() - 1
        });
        &self.depth[at].1
    }
}

/// The image of four numbers per pixel that one run of the stage `depth` writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Details {
    None,
    Sheet,
    Blend,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DepthRules {
    pub whole_curve: bool,
    pub is_own: bool,
    pub lumen_first: bool,
    pub details: Details,
    pub has_foot: bool,
}

impl DepthRules {
    /// The runs of the stage: one for each of sheet and blend that is needed.
    pub(crate) fn of(request: &Request) -> Vec<Self> {
        let &Request { settings, images, .. } = request;
        let needed = [
            (Details::Sheet, Table::has_sheet(settings, images)),
            (Details::Blend, Table::has_blend(images)),
        ];
        let mut wanted: Vec<_> =
            needed.iter().filter(|(_, is_needed)| *is_needed).map(|(details, _)| *details).collect();
        let has_foot = Table::has_foot(settings, images);
        if wanted.is_empty() || (has_foot && wanted == [Details::Blend]) {
            wanted.push(Details::None);
        }
        let run = |details: &Details| Self {
            whole_curve: settings.distance_rule == DistanceRule::WholeCurve,
            is_own: settings.level_choice == LevelChoice::Own,
            lumen_first: settings.lumen_first,
            details: *details,
            has_foot: has_foot && *details != Details::Blend,
        };
        wanted.iter().map(run).collect()
    }

    fn stage(self, device: &Device) -> Stage {
        let [across, rows] = tile_of(device).map(|n| n as f64);
        let switch = |is| f64::from(u8::from(is));
        let constants = [
            ("ACROSS", across),
            ("ROWS", rows),
            ("WHOLE_CURVE", switch(self.whole_curve)),
            ("LUMEN_FIRST", switch(self.lumen_first)),
            ("HAS_SHEET", switch(self.details == Details::Sheet)),
            ("HAS_BLEND", switch(self.details == Details::Blend)),
            ("HAS_FOOT", switch(self.has_foot)),
        ];
        let entry = if self.is_own { "depth" } else { "nearest" };
        Stage::entry(device, "stages/depth", entry, &constants)
    }
}

fn tile_of(device: &Device) -> [usize; 2] {
    if device.description().is_software { TILE_ON_SOFTWARE } else { TILE_ON_HARDWARE }
}

/// The size of a dispatch of at least `groups` workgroups, split into rows of allowed length.
fn in_rows(groups: u32) -> [u32; 2] {
    let across = groups.min(MAX_GROUPS);
    [across, groups.div_ceil(across)]
}
