// Holds the depth of the surroundings near that of the view before; see steady.rs.
// import math/view

struct SteadyParameters {
    limit: f32,
    slope: f32,
}

@group(0) @binding(1) var<uniform> parameters: SteadyParameters;
@group(0) @binding(2) var<storage, read> foot: array<vec4f>;
@group(0) @binding(3) var<storage, read> before: array<f32>;
@group(0) @binding(4) var<storage, read_write> depth: array<f32>;

@compute @workgroup_size(16, 4)
fn steady(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let p = place_of(thread.xy);
    let most = foot[p].y * parameters.slope;
    let change = clamp(depth[p] - before[p], -parameters.limit, parameters.limit);
    let off = before[p] + change - depth[p];
    depth[p] = select(depth[p], depth[p] + clamp(off, -most, most), most > 0.0);
}
