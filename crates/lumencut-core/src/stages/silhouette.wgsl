// Silhouettes: lines where the depth jumps (one pass, `lines`), or where it is steep (paper section 3.3.5;
// three passes: raised slope, depth filter over it, strength). silhouette.rs explains the constants.
// import math/view
// import math/lanes
// import math/leaps

const ZONE_BORDER: f32 = 4.0;
const STEEPEST: f32 = 1e12;

struct SilhouetteParameters {
    per_slope: f32,
    half: f32,
    line_width: f32,
}

@group(0) @binding(1) var<uniform> parameters: SilhouetteParameters;
// Holds the raised slopes, and after the last pass the strengths; the pass `lines` writes strengths at once.
@group(0) @binding(2) var<storage, read_write> slopes: array<f32>;
@group(0) @binding(3) var<storage, read> depth: array<f32>;
@group(0) @binding(4) var<storage, read> vessel: array<i32>;

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
    // Beyond its border, the image repeats its outermost pixels.
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
@group(0) @binding(3) var<uniform> line_parameters: SilhouetteParameters;
// The value is HUGE if the surface shows nothing.
@group(0) @binding(4) var<storage, read> value: array<f32>;

fn bits_at(pixel: vec2i) -> u32 {
    let is_inside = all(pixel >= vec2i(0)) && all(pixel < vec2i(view.size));
    return select(0u, leap[place_of(vec2u(select(vec2i(0), pixel, is_inside)))], is_inside);
}

// The border between a pixel and the neighbour at a step to the right, to the left, down or up.
struct Border {
    is_leap: bool,
    has_line: bool,
}

fn border(here: vec2i, step: vec2i) -> Border {
    let is_owner = step.x + step.y > 0;
    let bits = bits_at(select(here + step, here, is_owner));
    let is_leap = (bits & select(DOWNWARDS, TO_THE_RIGHT, step.y == 0)) != 0u;
    let is_here = (bits & select(LINE_DOWNWARDS, LINE_TO_THE_RIGHT, step.y == 0)) == 0u;
    return Border(is_leap, is_leap && is_here == is_owner);
}

// Whether the line of a depth jump from one lumen to another lies in a pixel.
fn ends(here: vec2i, step: vec2i) -> bool {
    return border(here, step).has_line && (bits_at(here) & bits_at(here + step) & LUMEN) != 0u;
}

fn cover_at(apart: vec2f) -> f32 {
    let within = max(line_parameters.line_width, 1.0) + 0.5;
    let distance = sqrt(apart.x * apart.x + apart.y * apart.y);
    return min(line_parameters.line_width, 1.0) * clamp(within - distance, 0.0, 1.0);
}

fn cover_of_lumen(here: vec2i, step: vec2i) -> f32 {
    if ends(here, step) {
        return min(line_parameters.line_width, 1.0);
    }
    let goes_on = !border(here, step).is_leap;
    return select(0.0, cover_at(vec2f(1.5, 0.0)), goes_on && ends(here + step, step));
}

fn is_shown(pixel: vec2i) -> bool {
    return value[place_of(vec2u(pixel))] < HUGE;
}

fn shows_line(here: vec2i, step: vec2i) -> bool {
    let may_lie_here = (bits_at(here) & LUMEN) == 0u && !is_shown(here + step);
    return is_shown(here) && (border(here, step).has_line || may_lie_here);
}

fn shows_line_of(owner: vec2i, step: vec2i, beyond: bool) -> bool {
    return shows_line(select(owner, owner + step, beyond), select(step, -step, beyond));
}

// Whether a pixel outside all lumens has depth jumps at its borders but shows none of their lines.
fn is_other_side(here: vec2i) -> bool {
    var is_beside = false;
    for (var n = 0; n < 4; n++) {
        let step = select(vec2i(0, 1), vec2i(1, 0), n < 2) * select(1, -1, (n & 1) == 1);
        if border(here, step).is_leap {
            if shows_line(here, step) {
                return false;
            }
            is_beside = true;
        }
    }
    return is_beside;
}

// The share of the pixel at offset `seen`, outside all lumens, that lines of leaps of `owner` cover, by the
// distance to the nearest leap whose line lies on this side.
fn cover_beside_lumen(owner: vec2i, seen: vec2i) -> f32 {
    let bits = bits_at(owner);
    var cover = 0.0;
    if (bits & TO_THE_RIGHT) != 0u && shows_line_of(owner, vec2i(1, 0), seen.x > 0) {
        cover = cover_at(vec2f(seen) - vec2f(0.5, 0.0));
    }
    if (bits & DOWNWARDS) != 0u && shows_line_of(owner, vec2i(0, 1), seen.y > 0) {
        cover = max(cover, cover_at(vec2f(seen) - vec2f(0.0, 0.5)));
    }
    return cover;
}

@compute @workgroup_size(16, 4)
fn lines(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let here = vec2i(thread.xy);
    var cover = 0.0;
    if (bits_at(here) & LUMEN) != 0u {
        cover = max(cover_of_lumen(here, vec2i(1, 0)), cover_of_lumen(here, vec2i(-1, 0)));
        cover = max(cover, max(cover_of_lumen(here, vec2i(0, 1)), cover_of_lumen(here, vec2i(0, -1))));
    } else if !is_other_side(here) {
        let reach = i32(ceil(max(line_parameters.line_width, 1.0)));
        for (var down = -reach; down <= reach; down++) {
            for (var right = -reach; right <= reach; right++) {
                let seen = vec2i(right, down);
                cover = max(cover, cover_beside_lumen(here - seen, seen));
            }
        }
    }
    slopes[place_of(thread.xy)] = cover;
}
