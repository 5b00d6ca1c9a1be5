// The depth of the cut surface: per level the piece with the smallest cost, blended between the two levels that the
// distance selects (paper sections 3.1.3, 3.1.4, 3.2.1 and 3.3.2; Eq. 2).
// import math/walk

@group(0) @binding(4) var<storage, read> distance_image: array<f32>;
@group(0) @binding(5) var<storage, read> vessel_of_slot: array<i32>;
@group(0) @binding(6) var<storage, read_write> depth_image: array<f32>;
@group(0) @binding(7) var<storage, read_write> vessel_image: array<i32>;

// The finer of the two levels that each pixel blends, and the weight of the coarser; 0 where there is none.
var<private> fine_level: array<vec4f, MAX_QUADS>;
var<private> coarse_weight: array<vec4f, MAX_QUADS>;
// The blended depth so far, the largest weight so far, and the slot that has it, counted over all levels.
var<private> blended: array<vec4f, MAX_QUADS>;
var<private> ruling_weight: array<vec4f, MAX_QUADS>;
var<private> ruling_slot: array<vec4u, MAX_QUADS>;

// Level selection at the distances of the tile: f = √(N·D/σ) between ⌊f⌋ and ⌊f⌋ + 1, N beyond. Bit k tells whether
// some pixel needs level k.
fn select_levels(tile: Tile) -> u32 {
    var needed = vec4u(0u);
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            let q = quad_of(a, r);
            let f = min(sqrt(parameters.selection * distances_at(tile, a, r)), vec4f(f32(parameters.coarsest)));
            fine_level[q] = floor(f);
            coarse_weight[q] = f - fine_level[q];
            needed |= select(vec4u(1u), vec4u(3u), coarse_weight[q] > vec4f(0.0)) << vec4u(fine_level[q]);
        }
    }
    return needed.x | needed.y | needed.z | needed.w;
}

// The distances of a quad; beyond the image the last column and row repeat.
fn distances_at(tile: Tile, a: u32, r: u32) -> vec4f {
    var distances: vec4f;
    for (var c = 0u; c < QUAD; c++) {
        distances[c] = distance_image[place_of(min(pixel_of(tile, a, r, c), view.size - 1u))];
    }
    return distances;
}

// The weights of level `k` in a quad; 0 where it is not needed.
fn weights(q: u32, k: f32) -> vec4f {
    let coarse = select(vec4f(0.0), coarse_weight[q], fine_level[q] + 1.0 == vec4f(k));
    return select(coarse, 1.0 - coarse_weight[q], fine_level[q] == vec4f(k));
}

// No winner yet where a level has weight, settled elsewhere.
fn begin(k: f32) {
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        winner_key[q] = select(vec4f(SETTLED), vec4f(UNSET), weights(q, k) > vec4f(0.0));
        winner_z[q] = vec4f(0.0);
        winner_piece[q] = vec4u(NO_SLOT);
    }
}

// Adds a level's winners by their weights. Finest first: a tie stays with the finer level.
fn blend(level: u32) {
    let first_slot = parameters.levels[level].first_slot;
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        let weight = weights(q, f32(level));
        let rules = weight > ruling_weight[q];
        blended[q] += weight * winner_z[q];
        ruling_weight[q] = select(ruling_weight[q], weight, rules);
        ruling_slot[q] = select(ruling_slot[q], winner_piece[q] / 2u + first_slot, rules);
    }
}

@compute @workgroup_size(TILES)
fn depth(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) thread: u32) {
    let tile = tile_at(group.xy, thread);
    if !in_view(tile.pixel) {
        return;
    }
    var needed = select_levels(tile);
    while needed != 0u {
        let level = countTrailingZeros(needed);
        needed &= needed - 1u;
        begin(f32(level));
        lowest_keys(tile, level);
        blend(level);
    }
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            for (var c = 0u; c < QUAD; c++) {
                let pixel = pixel_of(tile, a, r, c);
                if in_view(pixel) {
                    depth_image[place_of(pixel)] = blended[quad_of(a, r)][c];
                    vessel_image[place_of(pixel)] = vessel_of_slot[ruling_slot[quad_of(a, r)][c]];
                }
            }
        }
    }
}
