//! The parameters of the context, in the layout of the shaders.

use bytemuck::{Pod, Zeroable};

use super::reduce::Reduction;
use super::transfer::Colors;
use super::window::Ramp;
use crate::settings::{Context, ContextFrom, ContextMode, MAX_POINTS, Settings};

/// The largest number of rises between the control points of a transfer function.
const MAX_RISES: usize = MAX_POINTS - 1;
const MAX_GAPS: usize = MAX_POINTS / 2 + 1;
/// The largest number of block sizes; with this many, the largest block holds a volume of any size.
pub(crate) const MAX_BLOCK_LEVELS: usize = 16;

/// Change of intensity over two voxels (share of the window) that is half shaded; noise changes less.
const HALF_SHADED: f64 = 0.1;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gathering {
    /// Colours and opacities: DVR, MIDA and the blends between them and MIP.
    Blend,
    Brightest,
    Darkest,
    Average,
}

impl Gathering {
    /// How the rays of a mode gather; a blend with γ = 1 is plain MIP.
    pub fn of(mode: ContextMode) -> Self {
        match mode {
            mode if mode.is_sampled() => Self::Blend,
            ContextMode::Blend { .. } => Self::Brightest,
            ContextMode::Minimum => Self::Darkest,
            ContextMode::Average => Self::Average,
        }
    }

    pub fn reduction(self) -> Option<Reduction> {
        match self {
            Self::Blend => None,
            Self::Brightest => Some(Reduction::Largest),
            Self::Darkest => Some(Reduction::Smallest),
            Self::Average => Some(Reduction::Mean),
        }
    }

    pub const fn code(self) -> u32 {
        self as u32
    }
}

/// The part of a transfer function between two control points: what it adds to colour and opacity.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct RiseParameters {
    pub color: [f32; 3],
    pub opacity: f32,
    pub start: f32,
    /// Share of the rise that one unit of intensity completes.
    pub per_intensity: f32,
    pub padding: [f32; 2],
}

/// The places of a volume's blocks in one GPU buffer; the smallest blocks come first.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub struct BlockLayout {
    pub level_count: u32,
    /// log₂ of the side of the smallest blocks in the buffer; the unit is the side of the volume's smallest blocks.
    pub finest: u32,
    /// For each size: the number of blocks along each axis, and the index of the first block's range.
    pub levels: [[u32; 4]; MAX_BLOCK_LEVELS],
}

/// The parameters of a context's rays that depend neither on the view nor on the volume's grid.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct ContextParameters {
    pub window: Ramp,
    pub opacity: Ramp,
    /// Smallest number of parts of a ray per mm.
    pub per_step: f32,
    /// Distance between a transparent cut surface and the start of rays behind it (mm).
    pub behind: f32,
    /// 1 + min(γ, 0), with γ as in `ContextMode::Blend`: how much a brighter sample weakens those before it.
    pub push: f32,
    /// max(γ, 0): the share of the maximum intensity projection in the finished pixel.
    pub mix: f32,
    /// The intensity up to which everything is transparent, in the scale of the window (0 to 1).
    pub most: f32,
    pub black: f32,
    /// The square of the change of intensity that is half shaded.
    pub noise: f32,
    /// The intensity above which the colour no longer changes.
    pub last: f32,
    pub first_color: [f32; 3],
    pub first_opacity: f32,
    pub rise_count: u32,
    pub gap_count: u32,
    pub level_count: u32,
    pub finest: u32,
    pub rises: [RiseParameters; MAX_RISES],
    /// The ranges of intensity without opacity, each from the first to the second number of an entry.
    pub gaps: [[f32; 4]; MAX_GAPS],
    pub levels: [[u32; 4]; MAX_BLOCK_LEVELS],
}

impl ContextParameters {
    pub fn new(
        settings: &Settings,
        context: &Context,
        colors: &Colors,
        step: f64,
        blocks: &BlockLayout,
    ) -> Self {
        let window = Ramp::grey(context.window);
        let gamma = match context.mode {
            ContextMode::Blend { gamma } => gamma as f32,
            _ => 0.0,
        };
        let (first_color, first_opacity) = colors.first();
        let mut parameters = Self {
            window,
            per_step: (1.0 / step) as f32,
            push: 1.0 + gamma.min(0.0),
            mix: gamma.max(0.0),
            most: window.at(colors.first_visible()),
            black: window.zero(),
            noise: ((HALF_SHADED * context.window.width) as f32).powi(2),
            last: colors.last(),
            first_color,
            first_opacity,
            rise_count: colors.rises().len() as u32,
            gap_count: colors.gaps().len() as u32,
            level_count: blocks.level_count,
            finest: blocks.finest,
            levels: blocks.levels,
            ..Self::zeroed()
        };
        let StartParameters { opacity, behind, .. } = StartParameters::new(settings);
        (parameters.opacity, parameters.behind) = (opacity, behind);
        for (to, rise) in parameters.rises.iter_mut().zip(colors.rises()) {
            let &super::transfer::Rise { color, opacity, start, per_intensity } = rise;
            *to = RiseParameters { color, opacity, start, per_intensity, padding: [0.0; 2] };
        }
        for (to, gap) in parameters.gaps.iter_mut().zip(colors.gaps()) {
            *to = [gap.low, gap.high, 0.0, 0.0];
        }
        parameters
    }
}

/// The part of [`ContextParameters`] that decides where rays start.
#[derive(Clone, Copy, Debug)]
pub struct StartParameters {
    pub opacity: Ramp,
    pub behind: f32,
    pub from_cut: bool,
}

impl StartParameters {
    pub fn new(settings: &Settings) -> Self {
        let behind = settings.slab.map_or(0.0, |slab| slab.thickness / 2.0) as f32;
        let from_cut = settings.context.as_ref().is_none_or(|context| context.from == ContextFrom::Cut);
        Self { opacity: Ramp::opacity(settings.opacity), behind, from_cut }
    }
}
