//! Holds the depth of the surroundings near that of the view before, so that they change slowly while a view turns.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth::Foot;
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{larger, smaller};
use crate::settings::Settings;

/// The view before in a turn.
#[derive(Clone, Copy, Debug)]
pub struct Before<'a> {
    pub camera: &'a Camera,
    /// Depth of its cut surface (mm).
    pub depth: &'a [f32],
}

impl Before<'_> {
    /// The angle (degrees) by which `camera` has turned since.
    fn turned(&self, camera: &Camera) -> f64 {
        let axes = |camera: &Camera| [camera.right(), camera.up(), camera.direction()];
        let trace: f64 = axes(self.camera).iter().zip(axes(camera)).map(|(old, new)| old.dot(new)).sum();
        ((trace - 1.0) / 2.0).clamp(-1.0, 1.0).acos().to_degrees()
    }

    /// The depth at the pixels of `camera`, which may have moved and may have other pixels.
    pub fn seen_by(&self, camera: &Camera) -> Vec<f32> {
        let (old, [width, height]) = (self.camera, self.camera.size());
        let shift = camera.center() - old.center();
        let [right, up, away] = [old.right(), old.up(), old.direction()].map(|axis| shift.dot(axis));
        let nearest = |at: f64, count: usize| (at.max(0.0).round_ties_even() as usize).min(count - 1);
        let column = |i| nearest((camera.view_x(i) + right - old.view_x(0)) / old.pixel_spacing(), width);
        let columns: Vec<usize> = (0..camera.size()[0]).map(column).collect();
        let row = |j| nearest((old.view_y(0) - camera.view_y(j) - up) / old.pixel_spacing(), height);
        let rows = (0..camera.size()[1]).map(row);
        rows.flat_map(|j| columns.iter().map(move |i| self.depth[j * width + i] - away as f32)).collect()
    }
}

/// Largest difference from a still view, as a share of what the distance beyond the wall costs. A larger one would part
/// the surface from its lines, which are those of the still view.
const MOST: f64 = 0.5;

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct SteadyParameters {
    /// Largest change of depth since the view before (mm).
    pub limit: f32,
    /// Largest difference from the depth of a still view, per distance beyond the wall (mm per mm).
    pub slope: f32,
}

impl SteadyParameters {
    /// `None` if nothing limits the change.
    pub fn new(settings: &Settings, camera: &Camera, before: &Before) -> Option<Self> {
        let limit = settings.turning_limit? * before.turned(camera);
        Some(Self { limit: limit as f32, slope: (MOST * settings.cost_weight) as f32 })
    }

    /// The depth (mm) of a pixel `beyond` the wall (mm): as near to that of a still view as the depth `before` allows.
    #[inline(always)]
    pub(crate) fn depth(&self, still: f32, beyond: f32, before: f32) -> f32 {
        let most = beyond * self.slope;
        let change = smaller(larger(still - before, -self.limit), self.limit);
        let off = before + change - still;
        // Adding a small number would not restore every bit of the depth in lumen and wall.
        if most > 0.0 { still + smaller(larger(off, -most), most) } else { still }
    }
}

/// Changes the depth of each pixel outside lumen and wall. `foot` are the feet of the pixels, `before` the depth of the
/// view before there.
pub fn steady(
    work: &Work,
    parameters: &SteadyParameters,
    foot: &[Foot],
    before: &[f32],
    depth: &mut [f32],
) -> Result<()> {
    work.expect_whole(Image::Foot, foot);
    work.expect_whole(Image::Before, before);
    work.expect_whole(Image::Depth, depth);
    let chunk = work.tile_row();
    let rows = depth.par_chunks_mut(chunk).zip(foot.par_chunks(chunk)).zip(before.par_chunks(chunk));
    rows.try_for_each(|((depth, foot), before)| {
        work.begin(depth.len())?;
        for ((depth, [_, beyond, ..]), before) in depth.iter_mut().zip(foot).zip(before) {
            *depth = parameters.depth(*depth, *beyond, *before);
        }
        Ok(())
    })
}
