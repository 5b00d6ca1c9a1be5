//! Linear maps of intensities to grey and to opacity.

use bytemuck::{Pod, Zeroable};

use super::lanes::{larger, smaller};
use crate::settings::{Opacity, Window};

/// Linear map of intensity to [0, 1] by one multiplication and one addition.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Ramp {
    pub scale: f32,
    pub offset: f32,
}

impl Ramp {
    fn between(zero: f64, one: f64) -> Self {
        let span = if one == zero { f64::EPSILON.max(zero.abs() * 1e-12) } else { one - zero };
        Self { scale: (1.0 / span) as f32, offset: (-zero / span) as f32 }
    }

    pub(crate) fn grey(window: Window) -> Self {
        Self::between(window.level - window.width / 2.0, window.level + window.width / 2.0)
    }

    /// The ramp of an opacity; without one, everything is opaque.
    pub(crate) fn opacity(opacity: Option<Opacity>) -> Self {
        opacity.map_or(Self { scale: 0.0, offset: 1.0 }, |o| Self::between(o.transparent, o.opaque))
    }

    pub(crate) fn zero(&self) -> f32 {
        -self.offset / self.scale
    }

    #[inline(always)]
    pub(crate) fn at(&self, intensity: f32) -> f32 {
        smaller(larger(intensity * self.scale + self.offset, 0.0), 1.0)
    }
}
