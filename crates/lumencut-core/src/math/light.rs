//! Shading by the gradient of the volume, with light from the viewer.

use super::accumulate::Light;
use super::lanes::FAN;
use super::ray::IndexFromView;
use super::sampling::{Path, Places, Sampler};
use crate::settings::Window;

/// The share of its colour that a surface keeps edge on, and what it gains towards the viewer.
const AMBIENT: f32 = 0.4;
const DIFFUSE: f32 = 0.6;
/// White mirrored straight towards the viewer; it falls off with the sixteenth power of the cosine.
const SPECULAR: f32 = 0.2;

/// Changes over two voxels that are half shaded, as a share of the context window: noise within a vessel stays below,
/// the borders of vessels and bones are far above.
const HALF_SHADED: f64 = 0.1;

/// How strongly changes are shaded.
#[derive(Clone, Copy, Debug)]
pub struct Shading {
    /// The square of a change that is half shaded.
    pub noise: f32,
}

impl Shading {
    /// The shading of a context with this window.
    pub fn new(window: Window) -> Self {
        Self { noise: ((HALF_SHADED * window.width) as f32).powi(2) }
    }
}

/// A change within what can be squared; NaN stays.
#[inline(always)]
fn bounded(change: f32) -> f32 {
    const STEEPEST: f32 = 1e12;
    let change = if change > STEEPEST { STEEPEST } else { change };
    if change < -STEEPEST { -STEEPEST } else { change }
}

/// Light on sixteen places of a volume.
pub struct Headlight<'a> {
    /// Without it everything keeps its colour.
    pub shading: Option<Shading>,
    /// The volume.
    pub sampler: &'a dyn Sampler,
    /// From view to index.
    pub index_from_view: &'a IndexFromView,
    /// The voxel from which the places are counted.
    pub base: [i32; 3],
    /// The places.
    pub places: Places,
}

impl Light for Headlight<'_> {
    #[inline(always)]
    fn shade(&self) -> [[f32; FAN]; 2] {
        let (mut lit, mut shine) = ([1.0; FAN], [0.0; FAN]);
        let Some(shading) = self.shading else {
            return [lit, shine];
        };
        // One voxel more room towards the first voxels, where there is one.
        let base = self.base.map(|b| (b - 1).max(0));
        let shift = [0, 1, 2].map(|a| (self.base[a] - base[a]) as f32);
        let value = self.sampler.around(base, &Around { places: self.places, shift });
        let to = self.index_from_view;
        let [x, y, z] = [to.x, to.y, to.z].map(|axis| axis.as_vec3().to_array());
        for l in 0..FAN {
            let change = [0, 1, 2].map(|a| bounded(value[2 * a][l] - value[2 * a + 1][l]));
            let along = |axis: [f32; 3]| change[0] * axis[0] + change[1] * axis[1] + change[2] * axis[2];
            let (gx, gy, gz) = (along(x), along(y), along(z));
            let square = gx * gx + gy * gy + gz * gz;
            // Where nothing changes, or a neighbour has no value, there is no surface to shade.
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

/// One voxel to both sides along each axis.
#[derive(Clone, Copy, Debug)]
pub struct Around {
    places: Places,
    shift: [f32; 3],
}

impl Path for Around {
    #[inline(always)]
    fn places(&self, n: usize) -> Places {
        let mut places = self.places;
        for a in 0..3 {
            let shift = self.shift[a] + if n / 2 == a { [1.0, -1.0][n % 2] } else { 0.0 };
            for l in 0..FAN {
                places[a][l] += shift;
            }
        }
        places
    }
}
