// The rim: a band around the vessels, outside their walls, coloured by values along them; see rim.rs.
// import math/view

struct RimParameters {
    near: f32,
    far: f32,
    per_side: f32,
    most: f32,
}

struct RimStrip {
    first: u32,
    last: u32,
    per_mm: f32,
}

@group(0) @binding(1) var<uniform> parameters: RimParameters;
@group(0) @binding(2) var<storage, read> foot: array<vec4f>;
@group(0) @binding(3) var<storage, read> vessel: array<i32>;
@group(0) @binding(4) var<storage, read> strips: array<RimStrip>;
// RGBA, a byte each, red lowest.
@group(0) @binding(5) var<storage, read> colors: array<u32>;
@group(0) @binding(6) var<storage, read_write> rim_image: array<u32>;

fn within(inside: f32) -> f32 {
    return clamp(inside * parameters.per_side + 0.5, 0.0, 1.0);
}

@compute @workgroup_size(16, 4)
fn rim(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let place = place_of(thread.xy);
    let at = foot[place];
    let share = within(at.y - parameters.near) * within(parameters.far - at.y) * parameters.most;
    let strip = strips[vessel[place]];
    let color = colors[min(strip.first + u32(at.x * strip.per_mm + 0.5), strip.last)];
    let alpha = u32(round(share * f32(color >> 24u)));
    rim_image[place] = select(0u, (color & 0xffffffu) | (alpha << 24u), share > 0.0);
}
