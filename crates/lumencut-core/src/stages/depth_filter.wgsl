// The depth filter: a 7×7 Gaussian (paper section 3.3.3).
// import math/view

struct DepthFilterParameters {
    // From the middle outwards.
    weights: vec4f,
}

@group(0) @binding(1) var<uniform> parameters: DepthFilterParameters;
@group(0) @binding(2) var<storage, read> image: array<f32>;
@group(0) @binding(3) var<storage, read_write> smoothed: array<f32>;

// The image, continued beyond its border by the border's own pixels.
fn continued(column: i32, row: i32) -> f32 {
    let last = vec2i(view.size) - 1;
    return image[place_of(vec2u(clamp(vec2i(column, row), vec2i(0), last)))];
}

// Columns first, as on the CPU.
fn down(column: i32, row: i32) -> f32 {
    var sum = parameters.weights[0] * continued(column, row);
    for (var n = 1; n <= 3; n++) {
        sum += parameters.weights[n] * (continued(column, row - n) + continued(column, row + n));
    }
    return sum;
}

@compute @workgroup_size(16, 4)
fn depth_filter(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let pixel = vec2i(thread.xy);
    var sum = parameters.weights[0] * down(pixel.x, pixel.y);
    for (var n = 1; n <= 3; n++) {
        sum += parameters.weights[n] * (down(pixel.x - n, pixel.y) + down(pixel.x + n, pixel.y));
    }
    smoothed[place_of(thread.xy)] = sum;
}
