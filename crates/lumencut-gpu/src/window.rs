//! Ramps as shaders read them.

use bytemuck::{Pod, Zeroable};
use lumencut_core::math::window;

/// `Ramp` of `math/window.wgsl`. Within a uniform buffer WGSL wants structures at multiples of 16 bytes: two ramps in a
/// row are for storage buffers.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Ramp {
    /// What an intensity is multiplied by.
    pub scale: f32,
    /// What is added then.
    pub offset: f32,
}

impl From<window::Ramp> for Ramp {
    fn from(ramp: window::Ramp) -> Self {
        let [scale, offset] = ramp.parts();
        Self { scale, offset }
    }
}
