//! The context on the GPU.

use std::sync::OnceLock;

use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::math::context_parameters::{ContextParameters, Gathering};
use lumencut_core::math::ray::WHOLE;
use lumencut_core::math::ray_lines::{IndexFromView, PREVIEW_SIDE, RayGrid};
use lumencut_core::math::transfer::Colors;
use lumencut_core::settings::{Context, ContextFrom, Settings};
use lumencut_core::stages::context::step;
use lumencut_core::volume::Volume;
use wgpu::{BindingResource, Buffer};

use crate::blocks::DeviceBlocks;
use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;
use crate::volume::DeviceVolume;

const ROOM: &str = "stages/context";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Permutation {
    is_float: bool,
    gathering: Gathering,
    is_shaded: bool,
    is_preview: bool,
}

impl Permutation {
    fn of(context: &Context, is_float: bool) -> Self {
        let gathering = Gathering::of(context.mode);
        let is_shaded = context.shading && gathering == Gathering::Blend;
        Self { is_float, gathering, is_shaded, is_preview: context.preview }
    }

    fn compile(self, device: &Device) -> Stage {
        let number = |is: bool| f64::from(u8::from(is));
        let constants = [
            ("FLOAT_VOXELS", number(self.is_float)),
            ("MODE", f64::from(self.gathering.code())),
            ("SHADED", number(self.is_shaded)),
            side(self.is_preview),
        ];
        Stage::new(device, ROOM, &constants)
    }
}

/// The side of the square of pixels that one ray serves.
fn side(is_preview: bool) -> (&'static str, f64) {
    ("SIDE", if is_preview { PREVIEW_SIDE as f64 } else { 1.0 })
}

#[derive(Debug)]
pub(crate) struct ContextStage {
    /// Stages that write starts of rays: without a focus; with rays from the front; with rays from the surface.
    starts: [OnceLock<Stage>; 3],
    stages: Vec<(Permutation, Stage)>,
    /// Blends the squares of a preview.
    spread: OnceLock<Stage>,
    parameters: Buffer,
    /// The parameters that were written last.
    written: Vec<u8>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct ContextImages<'a> {
    pub size: [usize; 2],
    /// Whether there is a cut surface; without one every ray crosses the entire volume.
    pub has_surface: bool,
    pub focus: Option<&'a Buffer>,
    pub depth: &'a Buffer,
    pub value: &'a Buffer,
    pub start: &'a Buffer,
    /// The resulting premultiplied colours and opacity.
    pub gathered: &'a Buffer,
    pub squares: &'a Buffer,
}

impl ContextStage {
    pub(crate) fn new(device: &Device) -> Self {
        Self {
            starts: Default::default(),
            stages: Vec::new(),
            spread: OnceLock::new(),
            parameters: device.uniform::<ContextParameters>("context parameters"),
            written: Vec::new(),
        }
    }

    pub(crate) fn write(
        &mut self,
        device: &Device,
        settings: &Settings,
        context: &Context,
        (volume, camera): (&Volume, &Camera),
        blocks: &DeviceBlocks,
    ) -> Result<()> {
        let colors = Colors::new(&context.transfer);
        let step = match Gathering::of(context.mode) {
            Gathering::Blend => step(volume, context)?,
            _ => IndexFromView::new(volume, camera).voxel(),
        };
        let parameters = ContextParameters::new(settings, context, &colors, step, &blocks.places);
        if self.written != bytemuck::bytes_of(&parameters) {
            device.write(&self.parameters, &[parameters]);
            self.written = bytemuck::bytes_of(&parameters).to_vec();
        }
        Ok(())
    }

    fn starts_stage(&self, device: &Device, has_focus: bool, from: ContextFrom) -> &Stage {
        let from_cut = from == ContextFrom::Cut;
        let place = if has_focus { 1 + usize::from(from_cut) } else { 0 };
        self.starts[place].get_or_init(|| {
            let number = |is: bool| f64::from(u8::from(is));
            let constants = [("HAS_FOCUS", number(has_focus)), ("FROM_CUT", number(from_cut))];
            Stage::entry(device, ROOM, "starts", &constants)
        })
    }

    /// Records the stages for the starts of rays and for the context; `grid` places `on_device` in the view.
    pub(crate) fn record(
        &mut self,
        recording: &mut Recording,
        [view, grid]: [&Buffer; 2],
        (on_device, blocks): (&DeviceVolume, &DeviceBlocks),
        context: &Context,
        images: ContextImages,
    ) {
        let ContextImages { size, has_surface, depth, value, start, gathered, squares, .. } = images;
        let device = recording.device;
        if has_surface {
            // The shader does not read this binding if there is no focus.
            let focus = images.focus.unwrap_or(value);
            let buffers = [view, &self.parameters, value, depth, start, focus].map(Buffer::as_entire_binding);
            let stage = self.starts_stage(device, images.focus.is_some(), context.from);
            recording.run(stage, &buffers, groups(size, [8, 8]));
        } else {
            device.write(start, &vec![WHOLE; size[0] * size[1]]);
        }
        let permutation = Permutation::of(context, on_device.is_float());
        let known = self.stages.iter().position(|(known, _)| *known == permutation).unwrap_or_else(|| {
            self.stages.push((permutation, permutation.compile(device)));
            self.stages.len() - 1
        });
        let resources = [
            view.as_entire_binding(),
            self.parameters.as_entire_binding(),
            grid.as_entire_binding(),
            BindingResource::TextureView(&on_device.voxels),
            blocks.ranges.as_entire_binding(),
            start.as_entire_binding(),
            gathered.as_entire_binding(),
            squares.as_entire_binding(),
        ];
        let stage = &self.stages[known].1;
        if !context.preview {
            return recording.run(stage, &resources, groups(size, [8, 8]));
        }
        recording.run(stage, &resources, groups(RayGrid::squares(size), [8, 8]));
        let spread = self.spread.get_or_init(|| Stage::entry(device, ROOM, "spread", &[side(true)]));
        let buffers = [view, start, squares, gathered].map(Buffer::as_entire_binding);
        recording.run(spread, &buffers, groups(size, [8, 8]));
    }
}
