//! The parameters of the stages that make the cut surface (projection, distance, depth), as the shaders read them.

use bytemuck::{Pod, Zeroable};

use super::cost::Rule;
use super::projection::Radii;
use crate::camera::Camera;
use crate::settings::{MAX_LEVELS, Settings};

/// The most heights of boxes that the shaders know: 2³² slots have eight.
pub const MAX_HEIGHTS: usize = 8;

/// Where a level lies in the buffers of a GPU; the CPU has buffers of its own for every level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct LevelPlace {
    /// The first slot among those of all levels.
    pub first_slot: u32,
    /// The first bundle among those of all levels.
    pub first_bundle: u32,
    /// The number of bundles.
    pub bundle_count: u32,
    /// The number of heights of boxes above them.
    pub height_count: u32,
    /// The first box of each height, bottom up.
    pub heights: [u32; MAX_HEIGHTS],
}

/// What projection, distance and depth need to know of a view.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct CutSurfaceParameters {
    /// λ, what a millimetre beyond the wall costs; this and the four that follow are those of [`Rule`].
    pub weight: f32,
    /// How thick the wall around a lumen is (mm).
    pub margin: f32,
    /// What lifts every wall before all surroundings and, twice, every lumen before every wall (mm).
    pub lift: f32,
    /// More than the rounding error of a projected distance (mm).
    pub distance_slack: f32,
    /// More than the rounding error of a depth (mm).
    pub depth_slack: f32,
    /// N / σ (levels² per mm): f² = this · the distance that selects.
    pub selection: f32,
    /// N.
    pub coarsest: u32,
    /// What radii are multiplied by: 1 where they count, else 0.
    pub radius_scale: f32,
    /// What takes the place of a radius of 0 (mm).
    pub unknown_radius: f32,
    /// The number of vessels, on a GPU.
    pub vessel_count: u32,
    /// The next field lies at a multiple of 16 bytes.
    pub padding: [u32; 2],
    /// View coordinates (mm) of the point that a GPU counts the tree's points from: the part that adds to products
    /// without rounding.
    pub origin_coarse: [f32; 4],
    /// The rest of them.
    pub origin_fine: [f32; 4],
    /// Where each level lies in the buffers of a GPU.
    pub levels: [LevelPlace; MAX_LEVELS + 1],
}

impl CutSurfaceParameters {
    /// The parameters of a view of a tree whose view coordinates stay within `tree_reach` mm of the view's origin.
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

    /// The rule that orders the pieces.
    pub fn rule(&self) -> Rule {
        let &Self { weight, margin, lift, distance_slack, depth_slack, .. } = self;
        Rule { weight, margin, lift, distance_slack, depth_slack }
    }
}
