//! The cost that decides which piece of the cut surface a pixel sees (paper Eq. 2), and its *lumen first* variant.

use super::lanes::larger;
use crate::settings::Settings;

/// The rule that orders the pieces covering a pixel: the smallest key wins.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// λ.
    pub weight: f32,
    /// How far beyond the wall lumen reaches under *lumen first* (mm).
    pub margin: f32,
    /// More than the depth range of the tree (mm): lifts every lumen before every surrounding.
    pub lift: f32,
    /// More than the rounding error of a projected distance (mm).
    pub distance_slack: f32,
    /// More than the rounding error of a depth (mm).
    pub depth_slack: f32,
}

impl Rule {
    /// The rule of `settings` for a tree whose view coordinates, and a view whose pixels, stay within these
    /// distances (mm) of the view's origin.
    pub fn new(settings: &Settings, tree_reach: f32, view_reach: f32) -> Self {
        let rounding = 4e-6 * larger(tree_reach, view_reach) + 1e-5;
        Self {
            weight: settings.cost_weight as f32,
            margin: settings.lumen_margin as f32,
            lift: 2.0 * tree_reach + 1.0,
            distance_slack: rounding,
            depth_slack: rounding,
        }
    }

    /// The key of a piece at depth `z` with lumen radius `r`, at distance `d` from its own centerline.
    #[inline(always)]
    pub fn key<const LUMEN_FIRST: bool>(&self, z: f32, d: f32, r: f32) -> f32 {
        let beyond = d - r;
        let cost = z + self.weight * larger(beyond, 0.0);
        if LUMEN_FIRST && beyond <= self.margin { z - self.lift } else { cost }
    }

    /// A key that nothing at depth ≥ `z` with radius ≤ `r` falls below from a distance ≥ `d`.
    #[inline(always)]
    pub fn bound<const LUMEN_FIRST: bool>(&self, z: f32, d: f32, r: f32) -> f32 {
        self.key::<LUMEN_FIRST>(z - self.depth_slack, d - self.distance_slack, r)
    }

    /// The bound beyond which nothing can beat or tie with `key`.
    #[inline(always)]
    pub fn limit(&self, key: f32) -> f32 {
        key + self.depth_slack + key.abs() * 4e-7
    }
}
