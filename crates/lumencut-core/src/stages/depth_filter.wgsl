// The depth filter: a 7×7 Gaussian (paper section 3.3.3), over the entire image in one pass, or within zones
// in one pass per axis.
// import math/view

// Within zones: true if this pass filters along columns, false along rows.
override DOWN: bool = true;

struct DepthFilterParameters {
    weights: vec4f,
    leap: f32,
    padding: f32,
    more_padding: vec2f,
}

@group(0) @binding(1) var<uniform> parameters: DepthFilterParameters;
@group(0) @binding(2) var<storage, read> image: array<f32>;
@group(0) @binding(3) var<storage, read_write> smoothed: array<f32>;
// Read only by the filter within zones.
@group(0) @binding(4) var<storage, read> vessel: array<i32>;

fn continued(column: i32, row: i32) -> f32 {
    let last = vec2i(view.size) - 1;
    return image[place_of(vec2u(clamp(vec2i(column, row), vec2i(0), last)))];
}

// Filters columns first, then rows, as on the CPU.
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

// The rule of `filter_within_zones` in depth_filter.rs.
@compute @workgroup_size(16, 4)
fn within_zones(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let along = select(thread.x, thread.y, DOWN);
    let last = select(view.size.x, view.size.y, DOWN) - 1u;
    let stride = select(1u, view.size.x, DOWN);
    let pairs = min(3u, min(along, last - along));
    let place = place_of(thread.xy);
    let middle = image[place];
    let own = vessel[place];
    var sum = 0.0;
    var weight = parameters.weights[0];
    for (var n = 1u; n <= pairs; n++) {
        let one = place - n * stride;
        let other = place + n * stride;
        if vessel[one] != own || vessel[other] != own {
            break;
        }
        let bend = (image[one] - middle) + (image[other] - middle);
        if abs(bend) < parameters.leap {
            sum += parameters.weights[n] * bend;
            weight += 2.0 * parameters.weights[n];
        }
    }
    smoothed[place] = middle + sum / weight;
}
