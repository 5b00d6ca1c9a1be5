// Occlusion: how much deeper the cut surface lies than the depth around it; see occlusion.rs. The first pass reduces the
// depth, two passes blur it, and the last one compares.
// import math/view

const FIRST_MM: f32 = 0.5;
const FULL_MM: f32 = 10.0;
const GAIN: f32 = 1.6;

// Which of the two blurs a pass makes, and along which axis.
override SCALE: u32 = 0u;
override DOWN: bool = true;

struct Blur {
    weights: array<vec4f, 4>,
    side: u32,
    reach: u32,
    padding: vec2u,
}

struct OcclusionParameters {
    blurs: array<Blur, 2>,
}

@group(0) @binding(1) var<uniform> parameters: OcclusionParameters;
@group(0) @binding(2) var<storage, read> depth: array<f32>;
@group(0) @binding(3) var<storage, read_write> reduced_image: array<f32>;
@group(0) @binding(3) var<storage, read_write> blurred_image: array<f32>;
@group(0) @binding(3) var<storage, read> near: array<f32>;
@group(0) @binding(4) var<storage, read> far: array<f32>;
@group(0) @binding(5) var<storage, read_write> shares: array<vec4f>;

fn reduced_size(scale: u32) -> vec2u {
    let side = parameters.blurs[scale].side;
    return (view.size + side - 1u) / side;
}

@compute @workgroup_size(16, 4)
fn reduce(@builtin(global_invocation_id) thread: vec3u) {
    let size = reduced_size(SCALE);
    if any(thread.xy >= size) {
        return;
    }
    let side = parameters.blurs[SCALE].side;
    let first = thread.xy * side;
    let end = min(first + side, view.size);
    var sum = 0.0;
    for (var j = first.y; j < end.y; j++) {
        var row = 0.0;
        for (var i = first.x; i < end.x; i++) {
            row += depth[place_of(vec2u(i, j))];
        }
        sum += row;
    }
    let count = (end - first).x * (end - first).y;
    reduced_image[thread.y * size.x + thread.x] = sum / f32(count);
}

@compute @workgroup_size(16, 4)
fn blur(@builtin(global_invocation_id) thread: vec3u) {
    let size = reduced_size(SCALE);
    if any(thread.xy >= size) {
        return;
    }
    let place = thread.y * size.x + thread.x;
    let along = i32(select(thread.x, thread.y, DOWN));
    let last = i32(select(size.x, size.y, DOWN)) - 1;
    let stride = i32(select(1u, size.x, DOWN));
    var sum = parameters.blurs[SCALE].weights[0].x * depth[place];
    for (var n = 1; n <= i32(parameters.blurs[SCALE].reach); n++) {
        let before = i32(place) + (max(along - n, 0) - along) * stride;
        let after = i32(place) + (min(along + n, last) - along) * stride;
        sum += parameters.blurs[SCALE].weights[n / 4][n % 4] * (depth[before] + depth[after]);
    }
    blurred_image[place] = sum;
}

// The four pixels around a pixel of the view, row by row, and the parts to the right and downwards.
struct Around {
    places: vec4u,
    parts: vec2f,
}

fn around(pixel: vec2u, scale: u32) -> Around {
    let size = reduced_size(scale);
    let place = (vec2f(pixel) + 0.5) / f32(parameters.blurs[scale].side) - 0.5;
    let within = clamp(place, vec2f(0.0), vec2f(size) - 1.0);
    let low = vec2u(within);
    let high = min(low + 1u, size - 1u);
    let corners = vec4u(low.xy, high.xy);
    return Around(corners.yyww * size.x + corners.xzxz, within - vec2f(low));
}

fn interpolated(corners: vec4f, parts: vec2f) -> f32 {
    let rows = corners.xz + parts.x * (corners.yw - corners.xz);
    return rows.x + parts.y * (rows.y - rows.x);
}

fn behind(here: f32, around: f32) -> f32 {
    return clamp((here - around - FIRST_MM) / FULL_MM, 0.0, 1.0);
}

@compute @workgroup_size(16, 4)
fn occlusion(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let p = place_of(thread.xy);
    let n = around(thread.xy, 0u);
    let f = around(thread.xy, 1u);
    let nearby = vec4f(near[n.places.x], near[n.places.y], near[n.places.z], near[n.places.w]);
    let wide = vec4f(far[f.places.x], far[f.places.y], far[f.places.z], far[f.places.w]);
    let both = behind(depth[p], interpolated(nearby, n.parts)) + behind(depth[p], interpolated(wide, f.parts));
    shares[p].w *= min(GAIN * 0.5 * both, 1.0);
}
