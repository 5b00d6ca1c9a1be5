//! Shading by the gradient of the volume, with light from the viewer.

use super::accumulate::Light;
use super::lanes::FAN;
use super::ray_lines::IndexFromView;
use super::sampler::Sampler;
use super::sampling::{Around, Places};

/// The share of its colour that a surface keeps if it is seen edge on.
pub const AMBIENT: f32 = 0.4;
/// The share of its colour that a surface gains when it faces the viewer.
pub const DIFFUSE: f32 = 0.6;
/// White reflection of a surface that faces the viewer; it falls off with the sixteenth power of the cosine.
pub const SPECULAR: f32 = 0.2;
/// Changes of intensity are clamped to this, so that their squares stay finite.
pub const STEEPEST: f32 = 1e12;
pub const UNSHADED: [f32; 2] = [1.0, 0.0];

#[derive(Clone, Copy, Debug)]
pub(crate) struct Shading {
    pub noise: f32,
}

/// Clamps a change to ±[`STEEPEST`]; NaN stays.
#[inline(always)]
fn bounded(change: f32) -> f32 {
    let change = if change > STEEPEST { STEEPEST } else { change };
    if change < -STEEPEST { -STEEPEST } else { change }
}

pub(crate) struct Headlight<'a> {
    pub shading: Option<Shading>,
    pub sampler: &'a dyn Sampler,
    pub index_from_view: &'a IndexFromView,
    /// The voxel from which the positions are counted.
    pub base: [i32; 3],
    pub places: Places,
}

impl Light for Headlight<'_> {
    #[inline(always)]
    fn shade(&self) -> [[f32; FAN]; 2] {
        let [mut lit, mut shine] = UNSHADED.map(|number| [number; FAN]);
        let Some(shading) = self.shading else {
            return [lit, shine];
        };
        // The base moves one voxel towards index 0, if possible, so that neighbours keep positive offsets.
        let base = self.base.map(|b| (b - 1).max(0));
        let shift = [0, 1, 2].map(|a| (self.base[a] - base[a]) as f32);
        let value = self.sampler.around(base, &Around::new(self.places, shift));
        let to = self.index_from_view;
        let [x, y, z] = [to.x, to.y, to.z].map(|axis| axis.as_vec3().to_array());
        for l in 0..FAN {
            let change = [0, 1, 2].map(|a| bounded(value[2 * a][l] - value[2 * a + 1][l]));
            let along = |axis: [f32; 3]| change[0] * axis[0] + change[1] * axis[1] + change[2] * axis[2];
            let (gx, gy, gz) = (along(x), along(y), along(z));
            let square = gx * gx + gy * gy + gz * gz;
            // If intensity does not change, or a neighbour has no value, there is no surface to shade.
            let cosine = if square > 0.0 { gz.abs() / square.sqrt() } else { 0.0 };
            let contrast = change[0] * change[0] + change[1] * change[1] + change[2] * change[2];
            let surface = if square > 0.0 { contrast / (contrast + shading.noise) } else { 0.0 };
            let fourth = cosine * cosine * cosine * cosine;
            let sixteenth = fourth * fourth * fourth * fourth;
            lit[l] = 1.0 + surface * (AMBIENT + DIFFUSE * cosine - 1.0);
            shine[l] = surface * SPECULAR * sixteenth;
        }
        [lit, shine]
    }
}
