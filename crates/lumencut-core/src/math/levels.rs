//! The parameters of the stages that make the cut surface, in the shaders' layout.

use bytemuck::{Pod, Zeroable};

use super::cost::Rule;
use super::projection::Radii;
use crate::camera::Camera;
use crate::settings::{MAX_LEVELS, Settings};

/// The largest number of heights of boxes in the shaders; 2³² slots would need eight.
pub(crate) const MAX_HEIGHTS: usize = 8;

/// The position of a level in the GPU buffers; the CPU has separate buffers per level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct LevelLayout {
    pub first_slot: u32,
    pub first_bundle: u32,
    pub bundle_count: u32,
    pub height_count: u32,
    pub heights: [u32; MAX_HEIGHTS],
}

/// The input of projection, distance and depth that depends on the view.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct CutSurfaceParameters {
    /// λ, the cost of one millimetre beyond the wall; this and the next four fields are those of `Rule`.
    pub weight: f32,
    pub margin: f32,
    pub lift: f32,
    pub distance_slack: f32,
    pub depth_slack: f32,
    /// N / σ: at the distance D (mm) from the vessels, a pixel blends the levels around √(D · N / σ).
    pub selection: f32,
    pub coarsest: u32,
    /// Factor on radii: 1 if radii count, else 0.
    pub radius_scale: f32,
    /// The radius of points without a known one (mm).
    pub unknown_radius: f32,
    pub vessel_count: u32,
    pub padding: [u32; 2],
    /// View coordinates (mm) of the origin of the points on the GPU: a part of few digits, to which products
    /// can be added without rounding.
    pub origin_coarse: [f32; 4],
    pub origin_fine: [f32; 4],
    pub levels: [LevelLayout; MAX_LEVELS + 1],
}

impl CutSurfaceParameters {
    /// The parameters of a view whose tree stays within `tree_reach` mm of the view's origin.
    pub fn new(settings: &Settings, camera: &Camera, tree_reach: f32) -> Self {
        let view_reach = camera.view_x(0).abs().max(camera.view_y(0).abs()) as f32;
        let rule = Rule::new(settings, tree_reach, view_reach);
        let radii = Radii::new(settings);
        Self {
            weight: rule.weight,
            margin: rule.margin,
            lift: rule.lift,
            distance_slack: rule.distance_slack,
            depth_slack: rule.depth_slack,
            selection: (settings.levels as f64 / settings.level_distance) as f32,
            coarsest: settings.levels as u32,
            radius_scale: radii.scale,
            unknown_radius: radii.unknown,
            ..Self::zeroed()
        }
    }

    pub(crate) fn rule(&self) -> Rule {
        let &Self { weight, margin, lift, distance_slack, depth_slack, .. } = self;
        Rule { weight, margin, lift, distance_slack, depth_slack }
    }
}
