//! The context: what rays gather where no cut surface is shown, and the names of its modes.

use super::transfer::{Preset, TransferFunction};
use super::window::Window;
use crate::named::Named;

/// The modes of the context, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContextName {
    /// Maximum intensity difference accumulation, with adjustable γ.
    Mida,
    /// Direct volume rendering.
    Dvr,
    /// The largest value.
    Mip,
    /// The smallest value.
    Minip,
    /// The mean value.
    Average,
}

impl Named for ContextName {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("mida", Self::Mida),
        ("dvr", Self::Dvr),
        ("mip", Self::Mip),
        ("minip", Self::Minip),
        ("average", Self::Average),
    ];
}

impl ContextName {
    /// The mode with this name; `gamma` is the γ of MIDA.
    pub fn mode(self, gamma: f64) -> ContextMode {
        match self {
            Self::Mida => ContextMode::Blend { gamma },
            Self::Dvr => ContextMode::Blend { gamma: -1.0 },
            Self::Mip => ContextMode::Blend { gamma: 1.0 },
            Self::Minip => ContextMode::Minimum,
            Self::Average => ContextMode::Average,
        }
    }

    /// The default transfer function: grey for a maximum, since each ray then has a single intensity.
    pub(crate) fn default_transfer(self) -> Preset {
        match self {
            Self::Mip => Preset::Grey,
            _ => Preset::Angio,
        }
    }
}

/// The place at which rays of the context start around the focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContextFrom {
    /// At the cut surface.
    Cut,
    /// In front of the volume.
    Whole,
}

impl Named for ContextFrom {
    const NAMES: &'static [(&'static str, Self)] = &[("cut", Self::Cut), ("whole", Self::Whole)];
}

/// The quantity that the rays of the context gather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContextMode {
    /// Colour and opacity: γ = −1 is direct volume rendering (DVR), 0 maximum intensity difference
    /// accumulation (MIDA), 1 maximum intensity projection (MIP).
    Blend {
        /// γ, from −1 to 1.
        gamma: f64,
    },
    /// The smallest value, shown in grey.
    Minimum,
    /// The mean value, shown in grey.
    Average,
}

impl ContextMode {
    /// Blends start at the cut surface, since opacities hide what lies behind it. A largest, smallest or mean
    /// value would jump where the cut surface does.
    pub fn default_from(self) -> ContextFrom {
        if self.is_sampled() { ContextFrom::Cut } else { ContextFrom::Whole }
    }

    /// Whether samples along rays are blended, at a step; the other modes have exact values and no step.
    pub(crate) fn is_sampled(self) -> bool {
        matches!(self, Self::Blend { gamma } if gamma < 1.0)
    }
}

/// The parameters of the context, which is shown where the cut surface shows nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Context {
    /// The quantity that the rays gather.
    pub mode: ContextMode,
    /// Maps intensities to 0 to 1: for the differences of MIDA, and the grey of minimum and average.
    pub window: Window,
    /// Colour and opacity of the intensities.
    pub transfer: TransferFunction,
    /// The longest distance between samples (mm). `None` is the smallest side of a voxel, and half of it for
    /// DVR and MIDA at full resolution, whose opaque borders would otherwise show rings.
    pub step: Option<f64>,
    /// Whether DVR and MIDA are shaded by the gradient, with light from the viewer.
    pub shading: bool,
    /// The place at which rays start around the focus.
    pub from: ContextFrom,
    /// Factor on the colours of the context in the picture, 0 to 1.
    pub strength: f64,
    /// How much a halo around the focus darkens the context, 0 to 1.
    pub halo: f64,
    /// Whether the outline of the body is shown behind the context.
    pub body: bool,
    /// Whether only one ray is traced for each square of four pixels.
    pub preview: bool,
}
