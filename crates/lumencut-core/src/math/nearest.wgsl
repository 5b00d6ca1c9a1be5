// The distance of pixels to segments.
// import math/tile
// import math/pieces
// import math/hierarchy

var<private> least_square: array<vec4f, MAX_QUADS>;

fn foot(slot: Slot, u: vec2f) -> f32 {
    return clamp(dot(u, slot.edge) * slot.inverse_length * slot.inverse_length, 0.0, 1.0);
}

fn square_to_segment(tile: Tile, slot: Slot) -> f32 {
    let u = tile.center - slot.start;
    let d = u - foot(slot, u) * slot.edge;
    return dot(d, d);
}

fn lower_distance(slot: Slot) {
    let per_square = slot.inverse_length * slot.inverse_length;
    for (var a = 0u; a < ACROSS; a++) {
        let ux = quad_x[a] - slot.start.x;
        for (var r = 0u; r < ROWS; r++) {
            let uy = row_y[r] - slot.start.y;
            let t = clamp((ux * slot.edge.x + uy * slot.edge.y) * per_square, vec4f(0.0), vec4f(1.0));
            let dx = ux - t * slot.edge.x;
            let dy = uy - t * slot.edge.y;
            let q = quad_of(a, r);
            least_square[q] = min(dx * dx + dy * dy, least_square[q]);
        }
    }
}

fn slack(tile: Tile) -> f32 {
    return 4e-6 * (abs(tile.center.x) + abs(tile.center.y) + tile.half.x + tile.half.y) + 4e-6;
}
