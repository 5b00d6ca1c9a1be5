// The body: its outline behind the context; see body.rs.
// import math/view

const COLOR = vec3f(150.0, 160.0, 175.0) / 255.0;
const EVERYWHERE: f32 = 0.05;
const GLOW: f32 = 0.13;
const LINE: f32 = 0.16;
const GLOW_MM: f32 = 8.0;
const LOG2_E: f32 = 1.4426950408889634;
// The start of a ray that is not needed.
const NONE: f32 = 1e9;

struct BodyParameters {
    size: vec2u,
    first: f32,
    per_pixel: f32,
    per_line: f32,
    padding: f32,
}

@group(0) @binding(1) var<storage, read> parameters: BodyParameters;
@group(0) @binding(2) var<storage, read> nodes: array<vec2f>;
@group(0) @binding(3) var<storage, read> start: array<f32>;
@group(0) @binding(4) var<storage, read_write> context_image: array<vec4f>;

@compute @workgroup_size(16, 4)
fn body(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) || start[place_of(thread.xy)] >= NONE {
        return;
    }
    let place = parameters.first + vec2f(thread.xy) * parameters.per_pixel;
    let low = vec2u(place);
    let part = place - floor(place);
    let node = low.y * parameters.size.x + low.x;
    let below = node + parameters.size.x;
    let upper = nodes[node] + part.x * (nodes[node + 1u] - nodes[node]);
    let lower = nodes[below] + part.x * (nodes[below + 1u] - nodes[below]);
    let both = upper + part.y * (lower - upper);
    let inside = clamp(0.5 + both.x * parameters.per_line, 0.0, 1.0);
    let glow = exp2(-max(both.x, 0.0) / GLOW_MM * LOG2_E);
    let opacity = both.y * (inside * (EVERYWHERE + GLOW * glow) + LINE * 4.0 * inside * (1.0 - inside));
    let before = context_image[place_of(thread.xy)];
    context_image[place_of(thread.xy)] = before + (1.0 - before.w) * opacity * vec4f(COLOR, 1.0);
}
