// The levels of detail of the tree, one after the other in every buffer, and the rule that orders their
// pieces.
// import math/lanes

const MAX_LEVELS = 15u;

struct LevelLayout {
    first_slot: u32,
    first_bundle: u32,
    bundle_count: u32,
    height_count: u32,
    heights: array<vec4u, 2>,
}

// The range of points of one vessel at one level; buffers hold vessel after vessel, and level after level.
struct Span {
    first: u32,
    end: u32,
    // The index of the first point of the vessel's level.
    level: u32,
    // The points whose lumen and wall take precedence: index of the first, and of the one after the last.
    first_chosen: u32,
    end_chosen: u32,
}

// A point in the projection (mm). Each view writes it once, so pieces that share it read identical numbers.
struct Projected {
    point: vec3f,
    radius: f32,
    edge: vec2f,
    before: vec2f,
    inverse_length: f32,
    arc_length: f32,
    stands: u32,
    vessel: i32,
}

struct CutSurfaceParameters {
    weight: f32,
    margin: f32,
    lift: f32,
    distance_slack: f32,
    depth_slack: f32,
    selection: f32,
    coarsest: u32,
    radius_scale: f32,
    unknown_radius: f32,
    vessel_count: u32,
    padding: vec2u,
    origin_coarse: vec4f,
    origin_fine: vec4f,
    levels: array<LevelLayout, MAX_LEVELS + 1u>,
}

@group(0) @binding(1) var<uniform> parameters: CutSurfaceParameters;

fn first_box(level: u32, height: u32) -> u32 {
    return parameters.levels[level].heights[height / 4u][height % 4u];
}
