// The focus: the shares of the cut surface and its silhouettes that each pixel shows. focus.rs explains the
// fields.
// import math/walls

struct FocusParameters {
    margin: vec2f,
    per_fade: vec2f,
    near: f32,
    far: f32,
    others: f32,
    padding: f32,
}

@group(0) @binding(4) var<storage, read_write> focus_image: array<vec2f>;
@group(0) @binding(5) var<storage, read> focus_parameters: FocusParameters;

var<private> shown: array<array<vec2f, QUAD>, MAX_QUADS>;

fn shares(beyond_wall: f32) -> vec2f {
    let past = (max(beyond_wall, 0.0) - focus_parameters.margin) * focus_parameters.per_fade;
    let away = clamp(past, vec2f(0.0), vec2f(1.0));
    return 1.0 - away * away * (3.0 - 2.0 * away);
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
            shown[q][c] = shares(beyond[q][c]);
        }
    }
    if focus_parameters.others < 1.0 {
        nearest_walls(tile, near, far, true);
        for (var q = 0u; q < ACROSS * ROWS; q++) {
            for (var c = 0u; c < QUAD; c++) {
                shown[q][c].x = max(shares(beyond[q][c]).x, shown[q][c].x * focus_parameters.others);
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
