// The pieces of a local surface (stripe, wedge, end half-plane, full plane) over the pixels of a tile;
// pieces.rs explains the fields.
// import math/lanes
// import math/tile
// import math/cost

struct Slot {
    start: vec2f,
    next: vec2f,
    edge: vec2f,
    before: vec2f,
    inverse_length: f32,
    stripe_z: f32,
    stripe_dz: f32,
    wedge_z: f32,
    radius: f32,
    radius_change: f32,
    // NO_SLOT in an unused entry of a bundle.
    slot: u32,
    tiers: f32,
}

// The piece with the smallest key at each pixel so far (its winner): key, depth (mm), and twice its slot, plus 1 for
// the stripe.
var<private> winner_key: array<vec4f, MAX_QUADS>;
var<private> winner_z: array<vec4f, MAX_QUADS>;
var<private> winner_piece: array<vec4u, MAX_QUADS>;

fn offer(q: u32, covered: vec4<bool>, key: vec4f, z: vec4f, piece: u32) {
    let old_key = winner_key[q];
    let pieces = vec4u(piece);
    let wins = covered & ((key < old_key) | ((key == old_key) & (pieces < winner_piece[q])));
    winner_key[q] = select(old_key, key, wins);
    winner_z[q] = select(winner_z[q], z, wins);
    winner_piece[q] = select(winner_piece[q], pieces, wins);
}

fn offer_stripe(slot: Slot) {
    let unit = slot.edge * slot.inverse_length;
    let per_square = slot.inverse_length * slot.inverse_length;
    for (var a = 0u; a < ACROSS; a++) {
        let ux = quad_x[a] - slot.start.x;
        let wx = quad_x[a] - slot.next.x;
        for (var r = 0u; r < ROWS; r++) {
            let uy = row_y[r] - slot.start.y;
            let after_start = ux * slot.edge.x + uy * slot.edge.y;
            let beyond_end = wx * slot.edge.x + (row_y[r] - slot.next.y) * slot.edge.y;
            let t = min(after_start * per_square, vec4f(1.0));
            let d = abs(ux * unit.y - uy * unit.x);
            let z = slot.stripe_z + t * slot.stripe_dz;
            let covered = (after_start >= vec4f(0.0)) & (beyond_end <= vec4f(0.0));
            let key = keys(z, d, slot.radius + t * slot.radius_change, slot.tiers);
            offer(quad_of(a, r), covered, key, z, slot.slot * 2u + 1u);
        }
    }
}

fn offer_wedge(slot: Slot) {
    let z = vec4f(slot.wedge_z);
    for (var a = 0u; a < ACROSS; a++) {
        let ux = quad_x[a] - slot.start.x;
        for (var r = 0u; r < ROWS; r++) {
            let uy = row_y[r] - slot.start.y;
            let beyond_before = ux * slot.before.x + uy * slot.before.y;
            let after_start = ux * slot.edge.x + uy * slot.edge.y;
            let d = sqrt(ux * ux + uy * uy);
            let covered = (beyond_before >= vec4f(0.0)) & (after_start <= vec4f(0.0));
            let key = keys(z, d, vec4f(slot.radius), slot.tiers);
            offer(quad_of(a, r), covered, key, z, slot.slot * 2u);
        }
    }
}
