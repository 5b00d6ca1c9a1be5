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

// The points of one vessel at one level. Those of all vessels of a level follow one another, and the levels too.
struct Span {
    first: u32,
    end: u32,
    // The first point of its level.
    level: u32,
    // The first point whose lumen and wall come before those of all other vessels, and the point after the last.
    first_chosen: u32,
    end_chosen: u32,
}

// A point in projection (mm), written once in a view: whoever needs an edge reads it here, so that both neighbours of a
// border read the same number.
struct Projected {
    // View coordinates.
    point: vec3f,
    // The radius that counts.
    radius: f32,
    // The edge to the next point; zero where it is collinear with the view or not there.
    edge: vec2f,
    // The edge before what stands at the point; zero where it is not there.
    before: vec2f,
    // 1 / |edge|, zero with it.
    inverse_length: f32,
    // Where along its vessel the point is.
    arc_length: f32,
    // 1 where a wedge, a half-plane or a plane stands.
    stands: u32,
    padding: u32,
}

struct CutSurfaceParameters {
    // The rule, as `Rule` in Rust says.
    weight: f32,
    margin: f32,
    lift: f32,
    distance_slack: f32,
    depth_slack: f32,
    // N / σ (levels² per mm): f² = this · the distance that selects.
    selection: f32,
    // N.
    coarsest: u32,
    // 1 where radii count, else 0.
    radius_scale: f32,
    // What takes the place of a radius of 0.
    unknown_radius: f32,
    vessel_count: u32,
    padding: vec2u,
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
