// The focus: the shares of the cut surface and its silhouettes that each pixel shows. focus.rs explains the
// fields.
// import math/walls

struct FocusParameters {
    margin: vec2f,
    per_fade: vec2f,
    near: f32,
    far: f32,
    others: f32,
    halo: f32,
    wall: f32,
    shade: f32,
    halo_end: f32,
    halo_rest: f32,
}

// focus.rs explains these distances (mm).
const HALO_MM: f32 = 6.0;
const SHADE_FADE_MM: f32 = 1.0;
const LOG2_E: f32 = 1.4426950408889634;

@group(0) @binding(4) var<storage, read_write> focus_image: array<vec4f>;
@group(0) @binding(5) var<storage, read> focus_parameters: FocusParameters;

var<private> shown: array<array<vec4f, QUAD>, MAX_QUADS>;

fn shares(beyond_wall: f32) -> vec2f {
    let past = (max(beyond_wall, 0.0) - focus_parameters.margin) * focus_parameters.per_fade;
    return 1.0 - vec2f(smooth_step(past.x), smooth_step(past.y));
}

fn smooth_step(x: f32) -> f32 {
    let within = clamp(x, 0.0, 1.0);
    return within * within * (3.0 - 2.0 * within);
}

fn around(beyond_wall: f32, share: f32) -> f32 {
    let away = max(beyond_wall - HALO_MM, 0.0) / HALO_MM;
    let weight = (exp2(-away * LOG2_E) - focus_parameters.halo_rest) / (1.0 - focus_parameters.halo_rest);
    let halo = 1.0 - focus_parameters.halo * (1.0 - share) * weight;
    return select(1.0, halo, beyond_wall < focus_parameters.halo_end);
}

fn shade(beyond_wall: f32) -> f32 {
    return focus_parameters.shade * smooth_step((beyond_wall - focus_parameters.wall) / SHADE_FADE_MM);
}

@compute @workgroup_size(TILES)
fn focus(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) thread: u32) {
    let tile = tile_at(group.xy, thread);
    if !in_view(tile.pixel) {
        return;
    }
    let near = focus_parameters.near;
    let far = focus_parameters.far + parameters.distance_slack;
    nearest_walls(tile, near, far, false);
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        for (var c = 0u; c < QUAD; c++) {
            let factors = vec2f(around(beyond[q][c], shares(beyond[q][c]).x), shade(beyond[q][c]));
            shown[q][c] = vec4f(shares(beyond[q][c]), factors);
        }
    }
    if focus_parameters.others < 1.0 {
        let of_any = beyond;
        nearest_walls(tile, near, far, true);
        for (var q = 0u; q < ACROSS * ROWS; q++) {
            for (var c = 0u; c < QUAD; c++) {
                let share = max(shares(beyond[q][c]).x, shown[q][c].x * focus_parameters.others);
                shown[q][c] = vec4f(share, shown[q][c].y, around(of_any[q][c], share), shown[q][c].w);
            }
        }
    }
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            for (var c = 0u; c < QUAD; c++) {
                let pixel = pixel_of(tile, a, r, c);
                if in_view(pixel) {
                    focus_image[place_of(pixel)] = shown[quad_of(a, r)][c];
                }
            }
        }
    }
}
