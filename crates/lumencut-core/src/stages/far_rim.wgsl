// The far rim: darkens the farther side of a depth jump where its line has faded out; see far_rim.rs.
// import math/view
// import math/leaps

struct FarRimParameters {
    width: f32,
    strength: f32,
}

@group(0) @binding(1) var<uniform> parameters: FarRimParameters;
@group(0) @binding(2) var<storage, read> leap: array<u32>;
@group(0) @binding(3) var<storage, read> depth: array<f32>;
@group(0) @binding(4) var<storage, read_write> shares: array<vec4f>;

// The jump from a pixel to the next one, if that is nearer and not deeper than a limit.
fn is_before(here: vec2i, step: vec2i, limit: f32) -> bool {
    let other = here + step;
    if any(other < vec2i(0)) || any(other >= vec2i(view.size)) {
        return false;
    }
    let owner = select(other, here, step.x + step.y > 0);
    let bit = select(DOWNWARDS, TO_THE_RIGHT, step.y == 0);
    let z = depth[place_of(vec2u(here))];
    let nearer = depth[place_of(vec2u(other))];
    return (leap[place_of(vec2u(owner))] & bit) != 0u && z > nearer && limit > 0.5 * (z + nearer);
}

// Whether a pixel is the farther side of a jump, outside lumens and walls, whose middle is nearer than a limit.
fn is_farther_side(here: vec2i, limit: f32) -> bool {
    if any(here < vec2i(0)) || any(here >= vec2i(view.size)) {
        return false;
    }
    return (leap[place_of(vec2u(here))] & (LUMEN | WALL)) == 0u
        && (is_before(here, vec2i(1, 0), limit) || is_before(here, vec2i(-1, 0), limit)
            || is_before(here, vec2i(0, 1), limit) || is_before(here, vec2i(0, -1), limit));
}

@compute @workgroup_size(16, 4)
fn far_rim(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let p = place_of(thread.xy);
    if (leap[p] & (LUMEN | WALL)) != 0u || shares[p].y == 1.0 {
        return;
    }
    let reach = i32(ceil(parameters.width));
    var rim = 0.0;
    for (var down = -reach; down <= reach; down++) {
        for (var right = -reach; right <= reach; right++) {
            let apart = vec2f(f32(right), f32(down));
            let here = max(1.0 - sqrt(apart.x * apart.x + apart.y * apart.y) / parameters.width, 0.0);
            if here > rim && is_farther_side(vec2i(thread.xy) + vec2i(right, down), depth[p]) {
                rim = here;
            }
        }
    }
    let dark = parameters.strength * rim * (1.0 - shares[p].y);
    shares[p].w = 1.0 - (1.0 - shares[p].w) * (1.0 - dark);
}
