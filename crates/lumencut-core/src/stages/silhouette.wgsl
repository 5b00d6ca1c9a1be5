// Silhouettes: lines where the cut surface leaps; or, as in the paper (section 3.3.5), where it is steep, strongest between
// influence zones. The first in two passes: what lies beside a leap, and the depth filter over it. The second in three: the
// raised slope, the depth filter over it, and its strength.
// import math/view
// import math/leaps

// How much a leap between the influence zones of two vessels counts beside one within a zone.
const ZONE_BORDER: f32 = 4.0;
// Far beyond any slope squared.
const STEEPEST: f32 = 1e12;

struct SilhouetteParameters {
    // From the sum of the Sobel weights to mm per mm.
    per_slope: f32,
    // The square of the slope that has half the strength.
    half: f32,
}

@group(0) @binding(1) var<uniform> parameters: SilhouetteParameters;
// Raised slopes in the first pass, slopes that become strengths in the last.
@group(0) @binding(2) var<storage, read_write> slopes: array<f32>;
@group(0) @binding(3) var<storage, read> depth: array<f32>;
@group(0) @binding(4) var<storage, read> vessel: array<i32>;

// The Sobel magnitude of a 3 × 3 neighbourhood (row by row), raised at a border.
fn raise(above: vec3f, here: vec3f, below: vec3f, border: bool) -> f32 {
    let dx = (above.z - above.x) + 2.0 * (here.z - here.x) + (below.z - below.x);
    let dy = (below.x - above.x) + 2.0 * (below.y - above.y) + (below.z - above.z);
    return sqrt(dx * dx + dy * dy) * select(1.0, ZONE_BORDER, border);
}

@compute @workgroup_size(16, 4)
fn silhouette(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    // The image repeats its border beyond it.
    let columns = vec3u(max(thread.x, 1u) - 1u, thread.x, min(thread.x + 1u, view.size.x - 1u));
    let rows = vec3u(max(thread.y, 1u) - 1u, thread.y, min(thread.y + 1u, view.size.y - 1u));
    var z: array<vec3f, 3>;
    for (var r = 0u; r < 3u; r++) {
        let row = rows[r] * view.size.x;
        z[r] = vec3f(depth[row + columns.x], depth[row + columns.y], depth[row + columns.z]);
    }
    let own = vessel[place_of(thread.xy)];
    let neighbours = vec4i(
        vessel[place_of(vec2u(columns.x, thread.y))],
        vessel[place_of(vec2u(columns.z, thread.y))],
        vessel[place_of(vec2u(thread.x, rows.x))],
        vessel[place_of(vec2u(thread.x, rows.z))],
    );
    let border = any(neighbours != vec4i(own));
    slopes[place_of(thread.xy)] = raise(z[0], z[1], z[2], border) * parameters.per_slope;
}

@compute @workgroup_size(16, 4)
fn strength(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let place = place_of(thread.xy);
    let square = min(slopes[place] * slopes[place], STEEPEST);
    slopes[place] = square / (square + parameters.half);
}

@group(0) @binding(1) var<storage, read> leap: array<u32>;

@compute @workgroup_size(16, 4)
fn beside_leaps(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let place = place_of(thread.xy);
    var is_beside = leap[place] != 0u;
    if thread.x > 0u {
        is_beside |= (leap[place - 1u] & TO_THE_RIGHT) != 0u;
    }
    if thread.y > 0u {
        is_beside |= (leap[place - view.size.x] & DOWNWARDS) != 0u;
    }
    slopes[place] = select(0.0, 1.0, is_beside);
}
