//! The cost that decides which piece of the cut surface a pixel sees (paper Eq. 2), and its *lumen first* variant.

use super::lanes::larger;
use crate::settings::Settings;

/// The rule that orders the pieces covering a pixel: the smallest key wins.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// λ.
    pub weight: f32,
    /// How thick the wall around a lumen is (mm).
    pub margin: f32,
    /// More than the depth range of the tree (mm), the height of a tier: under *lumen first* it lifts every wall before all
    /// surroundings, every lumen before every wall, and both of a chosen vessel before those of all others.
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

    /// The key of a piece at depth `z` with lumen radius `r`, at distance `d` from its own centerline. Under *lumen first* its
    /// lumen and its wall come `tiers` before those of other vessels.
    #[inline(always)]
    pub fn key<const LUMEN_FIRST: bool>(&self, z: f32, d: f32, r: f32, tiers: f32) -> f32 {
        let beyond = d - r;
        let cost = z + self.weight * larger(beyond, 0.0);
        if !LUMEN_FIRST {
            return cost;
        }
        let lifted = z - self.lift * (tiers + if beyond <= 0.0 { 2.0 } else { 1.0 });
        if beyond <= self.margin { lifted } else { cost }
    }

    /// How far a piece at distance `d` from its centerline, of radius `r`, lies beyond its vessel's wall (mm); under
    /// *lumen first* the key tells whether it does at all.
    #[inline(always)]
    pub fn beyond_wall<const LUMEN_FIRST: bool>(&self, key: f32, d: f32, r: f32) -> f32 {
        let beyond = larger(d - r - self.margin, 0.0);
        // Surroundings have keys of half a mm above −lift/2 and more, walls of half a mm below it and less.
        let is_lifted = LUMEN_FIRST && key < -0.5 * self.lift;
        if is_lifted { 0.0 } else { beyond }
    }

    /// Whether a piece at distance `d` from its centerline, of radius `r`, shows its lumen; under *lumen first* the key tells.
    #[inline(always)]
    pub fn is_lumen<const LUMEN_FIRST: bool>(&self, key: f32, d: f32, r: f32) -> bool {
        // The keys of a tier lie within half a lift around it, and half a mm away from its borders.
        let is_beside = (key >= -1.5 * self.lift) | (self.is_first(key) & (key >= -3.5 * self.lift));
        if LUMEN_FIRST { !is_beside } else { d - r <= 0.0 }
    }

    /// Whether a key under *lumen first* is that of the lumen or the wall of a chosen vessel.
    #[inline(always)]
    pub fn is_first(&self, key: f32) -> bool {
        key < -2.5 * self.lift
    }

    /// A key that nothing at depth ≥ `z` with radius ≤ `r` and no more `tiers` falls below from a distance ≥ `d`.
    #[inline(always)]
    pub fn bound<const LUMEN_FIRST: bool>(&self, z: f32, d: f32, r: f32, tiers: f32) -> f32 {
        self.key::<LUMEN_FIRST>(z - self.depth_slack, d - self.distance_slack, r, tiers)
    }

    /// The bound beyond which nothing can beat or tie with `key`.
    #[inline(always)]
    pub fn limit(&self, key: f32) -> f32 {
        key + self.depth_slack + key.abs() * 4e-7
    }
}
