//! The key that decides which piece a pixel shows: the paper's cost (Eq. 2), or the variant *lumen first*.

use super::lanes::larger;
use crate::settings::Settings;

/// The rule that orders the pieces covering a pixel: the smallest key wins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rule {
    /// λ of Eq. 2.
    pub weight: f32,
    /// Thickness of the wall around a lumen (mm).
    pub margin: f32,
    /// Distance between tiers of keys (mm), larger than any difference of depths. Under *lumen first*, lumens
    /// precede walls, walls precede surroundings, and lumen and wall of a chosen vessel precede all others.
    pub lift: f32,
    /// A bound on the rounding error of a projected distance (mm).
    pub distance_slack: f32,
    /// A bound on the rounding error of a depth (mm).
    pub depth_slack: f32,
}

impl Rule {
    /// The rule for a view; the reaches bound the distances (mm) of tree and pixels from the view's origin.
    pub(crate) fn new(settings: &Settings, tree_reach: f32, view_reach: f32) -> Self {
        let rounding = 4e-6 * larger(tree_reach, view_reach) + 1e-5;
        Self {
            weight: settings.cost_weight as f32,
            margin: settings.lumen_margin as f32,
            lift: 2.0 * tree_reach + 1.0,
            distance_slack: rounding,
            depth_slack: rounding,
        }
    }

    /// The key at depth `z`, lumen radius `r` and distance `d` from the centerline. Under *lumen first*,
    /// lumen and wall come `tiers` tiers before those of other vessels.
    #[inline(always)]
    pub(crate) fn key<const LUMEN_FIRST: bool>(&self, z: f32, d: f32, r: f32, tiers: f32) -> f32 {
        let beyond = d - r;
        let cost = z + self.weight * larger(beyond, 0.0);
        if !LUMEN_FIRST {
            return cost;
        }
        let lifted = z - self.lift * (tiers + if beyond <= 0.0 { 2.0 } else { 1.0 });
        if beyond <= self.margin { lifted } else { cost }
    }

    /// Distance beyond the vessel's wall (mm); under *lumen first* the key decides whether it is above 0.
    #[inline(always)]
    pub(crate) fn beyond_wall<const LUMEN_FIRST: bool>(&self, key: f32, d: f32, r: f32) -> f32 {
        let beyond = larger(d - r - self.margin, 0.0);
        // Keys of surroundings stay above −lift/2 + 0.5 mm, keys of walls below −lift/2 − 0.5 mm.
        let is_lifted = LUMEN_FIRST && key < -0.5 * self.lift;
        if is_lifted { 0.0 } else { beyond }
    }

    /// Whether a piece at distance `d`, of radius `r`, shows its lumen; under *lumen first* the key decides.
    #[inline(always)]
    pub(crate) fn is_lumen<const LUMEN_FIRST: bool>(&self, key: f32, d: f32, r: f32) -> bool {
        // Keys of a tier lie within half a lift of the tier, and at least 0.5 mm from its borders.
        let is_outside_lumen = (key >= -1.5 * self.lift) | (self.is_first(key) & (key >= -3.5 * self.lift));
        if LUMEN_FIRST { !is_outside_lumen } else { d - r <= 0.0 }
    }

    /// Whether a key under *lumen first* belongs to the lumen or wall of a chosen vessel.
    #[inline(always)]
    pub(crate) fn is_first(&self, key: f32) -> bool {
        key < -2.5 * self.lift
    }

    /// A lower bound on keys of pieces with depth ≥ `z`, radius ≤ `r`, distance ≥ `d`, and at most `tiers`.
    #[inline(always)]
    pub(crate) fn bound<const LUMEN_FIRST: bool>(&self, z: f32, d: f32, r: f32, tiers: f32) -> f32 {
        self.key::<LUMEN_FIRST>(z - self.depth_slack, d - self.distance_slack, r, tiers)
    }

    /// A piece whose bound exceeds this can neither beat nor equal `key`.
    #[inline(always)]
    pub(crate) fn limit(&self, key: f32) -> f32 {
        key + self.depth_slack + key.abs() * 4e-7
    }
}
