//! The context on the GPU.

use bytemuck::{Pod, Zeroable};
use lumencut_core::error::Result;
use lumencut_core::math::light::Shading;
use lumencut_core::math::ray::WHOLE;
use lumencut_core::math::transfer::Colors;
use lumencut_core::math::window::Ramp;
use lumencut_core::settings::{Context as ContextSettings, ContextMode, Settings};
use lumencut_core::stages::context::step;
use lumencut_core::volume::Volume;
use wgpu::{BindingResource, Buffer};

use crate::blocks::{DeviceBlocks, MOST_LEVELS};
use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;
use crate::volume::DeviceVolume;

const ROOM: &str = "stages/context";

/// The most rises and gaps between the control points of a transfer function.
const MOST_RISES: usize = 63;
const MOST_GAPS: usize = 33;

/// `Rise` of `settings.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Rise {
    pub color: [f32; 3],
    pub opacity: f32,
    pub start: f32,
    pub per_intensity: f32,
    pub padding: [f32; 2],
}

/// `Context` of `settings.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Context {
    pub window: [f32; 2],
    pub opacity: [f32; 2],
    pub per_step: f32,
    pub behind: f32,
    pub push: f32,
    pub mix: f32,
    pub most: f32,
    pub black: f32,
    pub noise: f32,
    pub last: f32,
    pub first_color: [f32; 3],
    pub first_opacity: f32,
    pub rise_count: u32,
    pub gap_count: u32,
    pub level_count: u32,
    pub finest: u32,
    pub rises: [Rise; MOST_RISES],
    pub gaps: [[f32; 4]; MOST_GAPS],
    pub levels: [[u32; 4]; MOST_LEVELS],
}

impl Context {
    /// What `settings` say of the context of `volume`.
    fn new(
        volume: &Volume,
        settings: &Settings,
        context: &ContextSettings,
        blocks: &DeviceBlocks,
    ) -> Result<Self> {
        let colors = Colors::new(&context.transfer);
        let window = Ramp::grey(context.window);
        let gamma = match context.mode {
            ContextMode::Blend { gamma } => gamma as f32,
            _ => 0.0,
        };
        let (first_color, first_opacity) = colors.first();
        let mut uniform = Self {
            window: window.parts(),
            opacity: Ramp::opacity(settings.opacity).parts(),
            per_step: (1.0 / step(volume, context)?) as f32,
            behind: settings.slab.map_or(0.0, |slab| slab.thickness / 2.0) as f32,
            push: 1.0 + gamma.min(0.0),
            mix: gamma.max(0.0),
            most: window.at(colors.first_visible()),
            black: window.zero(),
            noise: Shading::new(context.window).noise,
            last: colors.last(),
            first_color,
            first_opacity,
            rise_count: colors.rises().len() as u32,
            gap_count: colors.gaps().len() as u32,
            level_count: blocks.levels.len() as u32,
            finest: blocks.finest,
            ..Self::zeroed()
        };
        for (to, rise) in uniform.rises.iter_mut().zip(colors.rises()) {
            *to = Rise {
                color: rise.color,
                opacity: rise.opacity,
                start: rise.start,
                per_intensity: rise.per_intensity,
                padding: [0.0; 2],
            };
        }
        for (to, gap) in uniform.gaps.iter_mut().zip(colors.gaps()) {
            *to = [gap.low, gap.high, 0.0, 0.0];
        }
        uniform.levels[..blocks.levels.len()].copy_from_slice(&blocks.levels);
        Ok(uniform)
    }
}

/// What the shader is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Permutation {
    is_float: bool,
    mode: u8,
    is_shaded: bool,
    is_preview: bool,
}

impl Permutation {
    fn of(context: &ContextSettings, is_float: bool) -> Self {
        let mode = match context.mode {
            ContextMode::Blend { gamma } if gamma < 1.0 => 0,
            ContextMode::Blend { .. } => 1,
            ContextMode::Minimum => 2,
            ContextMode::Average => 3,
        };
        let is_shaded = context.shading && mode == 0;
        Self { is_float, mode, is_shaded, is_preview: context.preview }
    }

    fn compile(self, device: &Device) -> Stage {
        let number = |is: bool| f64::from(u8::from(is));
        let constants = [
            ("FLOAT_VOXELS", number(self.is_float)),
            ("MODE", f64::from(self.mode)),
            ("SHADED", number(self.is_shaded)),
            ("PREVIEW", number(self.is_preview)),
        ];
        Stage::new(device, ROOM, &constants)
    }
}

/// The stage, for all that it was asked for so far, and its settings.
#[derive(Debug)]
pub(crate) struct ContextStage {
    starts: Stage,
    stages: Vec<(Permutation, Stage)>,
    settings: Buffer,
    /// The settings as the shader was last told.
    told: Vec<u8>,
}

/// The images of a cut surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutSurfaceImages<'a> {
    /// The volume at the cut surface.
    pub value: &'a Buffer,
    /// Its depth.
    pub depth: &'a Buffer,
}

impl ContextStage {
    /// No rays compiled yet.
    pub fn new(device: &Device) -> Self {
        let settings = device.uniform::<Context>("context settings");
        Self {
            starts: Stage::entry(device, ROOM, "starts", &[]),
            stages: Vec::new(),
            settings,
            told: Vec::new(),
        }
    }

    /// Writes where the rays of a view of `size` pixels start, and what they gather: colours times opacity, and opacity.
    /// Without a cut surface every ray crosses the whole volume. `on_device` is `volume`, placed in that view.
    ///
    /// # Errors
    /// As the stage of the CPU.
    #[allow(clippy::too_many_arguments)]
    pub fn record(
        &mut self,
        recording: &mut Recording,
        (view, size): (&Buffer, [usize; 2]),
        (on_device, blocks, volume): (&DeviceVolume, &DeviceBlocks, &Volume),
        (settings, context): (&Settings, &ContextSettings),
        cut_surface: Option<CutSurfaceImages>,
        [start, pixels]: [&Buffer; 2],
    ) -> Result<()> {
        let device = recording.device;
        let uniform = Context::new(volume, settings, context, blocks)?;
        if self.told != bytemuck::bytes_of(&uniform) {
            device.write(&self.settings, &[uniform]);
            self.told = bytemuck::bytes_of(&uniform).to_vec();
        }
        let permutation = Permutation::of(context, on_device.is_float());
        if !self.stages.iter().any(|(known, _)| *known == permutation) {
            self.stages.push((permutation, permutation.compile(device)));
        }
        let Some((_, stage)) = self.stages.iter().find(|(known, _)| *known == permutation) else {
            return Ok(());
        };
        if let Some(CutSurfaceImages { value, depth }) = cut_surface {
            let buffers = [view, &self.settings, value, depth, start].map(Buffer::as_entire_binding);
            recording.run(&self.starts, &buffers, groups(size, [8, 8]));
        } else {
            device.write(start, &vec![WHOLE; size[0] * size[1]]);
        }
        let resources = [
            view.as_entire_binding(),
            self.settings.as_entire_binding(),
            on_device.grid.as_entire_binding(),
            BindingResource::TextureView(&on_device.voxels),
            blocks.ranges.as_entire_binding(),
            start.as_entire_binding(),
            pixels.as_entire_binding(),
        ];
        let side = if context.preview { 16 } else { 8 };
        recording.run(stage, &resources, groups(size, [side, side]));
        Ok(())
    }
}
