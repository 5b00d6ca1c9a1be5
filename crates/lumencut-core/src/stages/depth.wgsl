// The depth of the cut surface: the piece with the smallest key at each pixel, and the blend of two levels of
// detail (paper sections 3.1.3, 3.1.4, 3.2.1 and 3.3.2; Eq. 2).
// import math/walk
// import math/own_pieces
// import math/whole_curve

const CHOSEN_GAP: f32 = -1.0;
const WALL_GAP: f32 = -2.0;

override HAS_SHEET: bool = false;
override HAS_BLEND: bool = false;
override HAS_FOOT: bool = false;

@group(0) @binding(4) var<storage, read_write> foot_image: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> depth_image: array<f32>;
@group(0) @binding(6) var<storage, read_write> vessel_image: array<i32>;
// The sheet or the blend.
@group(0) @binding(7) var<storage, read_write> details_image: array<vec4f>;
@group(0) @binding(9) var<storage, read> distance_image: array<f32>;

// The finer of the two levels that a pixel blends, and the weight of the coarser one (0 if it is not used).
var<private> fine_level: array<vec4f, MAX_QUADS>;
var<private> coarse_weight: array<vec4f, MAX_QUADS>;
// Running results: the blended depth, the largest weight, and the slot with that weight, over all levels.
var<private> blended: array<vec4f, MAX_QUADS>;
var<private> ruling_weight: array<vec4f, MAX_QUADS>;
var<private> ruling_slot: array<vec4u, MAX_QUADS>;
// The sheet or blend so far, and the finer level's vessel (counted from 1; 0: none yet) and arc length.
var<private> details: array<array<vec4f, QUAD>, MAX_QUADS>;
var<private> finer_vessel: array<vec4u, MAX_QUADS>;
var<private> finer_arc_length: array<vec4f, MAX_QUADS>;

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

fn weights(q: u32, k: f32) -> vec4f {
    let coarse = select(vec4f(0.0), coarse_weight[q], fine_level[q] + 1.0 == vec4f(k));
    return select(coarse, 1.0 - coarse_weight[q], fine_level[q] == vec4f(k));
}

fn find_winners(tile: Tile, level: u32) {
    if WHOLE_CURVE {
        lowest_keys_of_curves(level);
    } else {
        lowest_keys(tile, level);
    }
}

fn begin(k: f32) {
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        winner_key[q] = select(vec4f(EXCLUDED), vec4f(UNSET), weights(q, k) > vec4f(0.0));
        winner_z[q] = vec4f(0.0);
        winner_piece[q] = vec4u(NO_SLOT);
    }
}

// Adds the depths of the pieces found at a level, by its weights. The finest level comes first and wins ties.
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

fn add_to_sheets(tile: Tile, level: u32) {
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            let n = quad_of(a, r);
            let weight = weights(n, f32(level));
            for (var c = 0u; c < QUAD; c++) {
                if weight[c] > 0.0 {
                    let piece = winner_piece[n][c];
                    let vessel = projected[parameters.levels[level].first_slot + piece / 2u].vessel;
                    let q = vec2f(quad_x[a][c], row_y[r]);
                    let found = decide(level, winner_key[n][c], piece, vessel, q);
                    // A pixel shows lumen if every level that it blends shows lumen.
                    let radius = abs(details[n][c].z) + weight[c] * abs(found.sheet_radius);
                    let is_outside_lumen = details[n][c].z < 0.0 || found.sheet_radius < 0.0;
                    let slope = details[n][c].xy + weight[c] * found.slope;
                    details[n][c] = vec4f(slope, select(radius, -radius, is_outside_lumen), details[n][c].w);
                    let counted = u32(vessel) + 1u;
                    if found.is_first && (finer_vessel[n][c] == 0u || details[n][c].w == CHOSEN_GAP) {
                        details[n][c].w = CHOSEN_GAP;
                    } else if found.beyond_wall <= 0.0 && (finer_vessel[n][c] == 0u || details[n][c].w < 0.0) {
                        details[n][c].w = WALL_GAP - found.arc_length;
                    } else if finer_vessel[n][c] != 0u {
                        let apart = abs(found.arc_length - finer_arc_length[n][c]);
                        details[n][c].w = select(FAR, apart, counted == finer_vessel[n][c]);
                    }
                    finer_vessel[n][c] = counted;
                    finer_arc_length[n][c] = found.arc_length;
                }
            }
        }
    }
}

// Writes the foot of the level with the larger weight so far.
fn put_feet(tile: Tile, level: u32) {
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            let n = quad_of(a, r);
            let weight = weights(n, f32(level));
            for (var c = 0u; c < QUAD; c++) {
                let piece = winner_piece[n][c];
                let slot = parameters.levels[level].first_slot + piece / 2u;
                let pixel = pixel_of(tile, a, r, c);
                if weight[c] > 0.0 && ruling_slot[n][c] == slot && in_view(pixel) {
                    let q = vec2f(quad_x[a][c], row_y[r]);
                    foot_image[place_of(pixel)] = foot_of(decide(level, winner_key[n][c], piece, projected[slot].vessel, q));
                }
            }
        }
    }
}

fn foot_of(decision: Decision) -> vec4f {
    return vec4f(decision.arc_length, decision.beyond_wall, 0.0, 0.0);
}

// `so_far` with one more level in it; `piece` counts the slots of all levels. depth.rs explains the fields.
fn with_level(so_far: vec4f, level: f32, weight: f32, piece: u32, q: vec2f) -> vec4f {
    var shown = piece_at(piece, q);
    if WHOLE_CURVE {
        shown.y = distance_to_curve(u32(level), piece / 2u, q);
    }
    let sum = so_far.xy + weight * vec2f(cost_of(shown.x, shown.y, shown.z), level);
    let ruling = select(so_far.zw, vec2f(kind_of(piece), weight), weight > so_far.w);
    return vec4f(sum, ruling);
}

fn add_to_blends(level: u32) {
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            let n = quad_of(a, r);
            let weight = weights(n, f32(level));
            for (var c = 0u; c < QUAD; c++) {
                if weight[c] > 0.0 {
                    let piece = winner_piece[n][c] + 2u * parameters.levels[level].first_slot;
                    let q = vec2f(quad_x[a][c], row_y[r]);
                    details[n][c] = with_level(details[n][c], f32(level), weight[c], piece, q);
                }
            }
        }
    }
}

@compute @workgroup_size(TILES)
fn nearest(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) thread: u32) {
    let tile = tile_at(group.xy, thread);
    if !in_view(tile.pixel) {
        return;
    }
    var needed = select_levels(tile);
    while needed != 0u {
        let level = countTrailingZeros(needed);
        needed &= needed - 1u;
        begin(f32(level));
        find_winners(tile, level);
        blend(level);
        if HAS_SHEET {
            add_to_sheets(tile, level);
        }
        if HAS_BLEND {
            add_to_blends(level);
        }
        if HAS_FOOT {
            put_feet(tile, level);
        }
    }
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            for (var c = 0u; c < QUAD; c++) {
                let pixel = pixel_of(tile, a, r, c);
                if in_view(pixel) {
                    depth_image[place_of(pixel)] = blended[quad_of(a, r)][c];
                    vessel_image[place_of(pixel)] = projected[ruling_slot[quad_of(a, r)][c]].vessel;
                    if HAS_SHEET || HAS_BLEND {
                        details_image[place_of(pixel)] = details[quad_of(a, r)][c];
                    }
                }
            }
        }
    }
}

// `winner` is the piece shown at the finest level.
fn blend_own(place: u32, decision: Decision, z: f32, winner: u32, q: vec2f) {
    let f = min(sqrt(parameters.selection * decision.beyond_wall), f32(parameters.coarsest));
    let fine = floor(f);
    var fine_piece = NearestPiece(0.0, 0.0, 0.0, winner, z, decision.slope);
    if fine > 0.0 {
        fine_piece = nearest_piece(u32(fine), decision, q);
    }
    let weight = f - fine;
    var coarse_piece = fine_piece;
    if weight > 0.0 {
        coarse_piece = nearest_piece(u32(fine) + 1u, decision, q);
    }
    depth_image[place] = (1.0 - weight) * fine_piece.z + weight * coarse_piece.z;
    vessel_image[place] = decision.vessel;
    if HAS_SHEET {
        let slope = (1.0 - weight) * fine_piece.slope + weight * coarse_piece.slope;
        let outside = select(WALL_GAP - decision.arc_length, abs(coarse_piece.along - fine_piece.along), decision.beyond_wall > 0.0);
        let gap = select(outside, CHOSEN_GAP, decision.is_first);
        details_image[place] = vec4f(slope, decision.sheet_radius, gap);
    }
    if HAS_BLEND {
        var blend = with_level(vec4f(0.0), fine, 1.0 - weight, fine_piece.piece, q);
        if weight > 0.0 {
            blend = with_level(blend, fine + 1.0, weight, coarse_piece.piece, q);
        }
        details_image[place] = blend;
    }
    if HAS_FOOT {
        foot_image[place] = foot_of(decision);
    }
}

@compute @workgroup_size(TILES)
fn depth(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) thread: u32) {
    let tile = tile_at(group.xy, thread);
    if !in_view(tile.pixel) {
        return;
    }
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        winner_key[q] = vec4f(UNSET);
        winner_z[q] = vec4f(0.0);
        winner_piece[q] = vec4u(NO_SLOT);
    }
    find_winners(tile, 0u);
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            for (var c = 0u; c < QUAD; c++) {
                let pixel = pixel_of(tile, a, r, c);
                if in_view(pixel) {
                    let n = quad_of(a, r);
                    let q = vec2f(quad_x[a][c], row_y[r]);
                    let vessel = projected[parameters.levels[0].first_slot + winner_piece[n][c] / 2u].vessel;
                    let decision = decide(0u, winner_key[n][c], winner_piece[n][c], vessel, q);
                    let winner = winner_piece[n][c] + 2u * parameters.levels[0].first_slot;
                    blend_own(place_of(pixel), decision, winner_z[n][c], winner, q);
                }
            }
        }
    }
}
