// Leaps: neighbours whose depths do not belong to one surface.
// import math/view
// import math/leaps

// The smallest leap (mm), for vessels whose diameter is smaller.
const SMALLEST_LEAP: f32 = 2.0;

struct LeapParameters {
    // The side of a pixel (mm).
    pixel_spacing: f32,
}

@group(0) @binding(1) var<uniform> parameters: LeapParameters;
@group(0) @binding(2) var<storage, read> depth: array<f32>;
@group(0) @binding(3) var<storage, read> sheet: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> leap_image: array<u32>;

// Whether a change of depth over a step (view x and y, mm) is another than the slope of a sheet makes it.
fn is_off(change: f32, sheet: vec4f, step: vec2f) -> bool {
    let expected = sheet.x * step.x + sheet.y * step.y;
    return abs(change - expected) > max(2.0 * sheet.z, SMALLEST_LEAP);
}

// Whether the depth leaps from one pixel to another.
fn leaps(here: u32, there: u32, step: vec2f) -> bool {
    let change = depth[there] - depth[here];
    return is_off(change, sheet[here], step) && is_off(change, sheet[there], step);
}

@compute @workgroup_size(16, 4)
fn leap(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let here = place_of(thread.xy);
    let side = parameters.pixel_spacing;
    // Beyond the last column and the last row there is nothing to leap to.
    var bits = 0u;
    if thread.y + 1u < view.size.y && leaps(here, here + view.size.x, vec2f(0.0, -side)) {
        bits |= DOWNWARDS;
    }
    if thread.x + 1u < view.size.x && leaps(here, here + 1u, vec2f(side, 0.0)) {
        bits |= TO_THE_RIGHT;
    }
    leap_image[here] = bits;
}
