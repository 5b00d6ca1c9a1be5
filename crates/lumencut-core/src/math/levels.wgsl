// The levels of detail of the tree, one after the other in every buffer, and the rule that orders their pieces.
// import math/lanes

// The most levels beyond the finest.
const MAX_LEVELS = 15u;

// Where a level lies in the buffers.
struct LevelPlace {
    first_slot: u32,
    first_bundle: u32,
    bundle_count: u32,
    // The heights of boxes above the bundles.
    height_count: u32,
    // The first box of each height, bottom up.
    heights: array<vec4u, 2>,
}

struct CutSurfaceParameters {
    // The rule, as `Rule` in Rust says.
    weight: f32,
    margin: f32,
    lift: f32,
    distance_slack: f32,
    depth_slack: f32,
    // N / σ (levels² per mm): f² = this · D.
    selection: f32,
    // N.
    coarsest: u32,
    // 1 where radii count, else 0.
    radius_scale: f32,
    // View coordinates (mm) of the point that the tree's points are counted from, and the rest of them.
    origin_coarse: vec4f,
    origin_fine: vec4f,
    levels: array<LevelPlace, MAX_LEVELS + 1u>,
}

@group(0) @binding(1) var<uniform> parameters: CutSurfaceParameters;

// The first box of a height of a level.
fn first_box(level: u32, height: u32) -> u32 {
    return parameters.levels[level].heights[height / 4u][height % 4u];
}
