// The distance of pixels to the nearest wall of any vessel, in the view plane; see walls.rs.
// import math/hierarchy
// import math/nearest

const MAX_LEAN: f32 = 1e6;

// The distance (mm) of each pixel of the tile from the wall so far, negative within.
var<private> beyond: array<vec4f, MAX_QUADS>;

fn lean(taper: f32) -> f32 {
    let rest = max(1.0 - taper * taper, 1.0 / (MAX_LEAN * MAX_LEAN));
    return clamp(taper / sqrt(rest), -MAX_LEAN, MAX_LEAN);
}

fn lower_beyond(slot: Slot) {
    let per_square = slot.inverse_length * slot.inverse_length;
    let leaning = lean(slot.radius_change * slot.inverse_length) * per_square;
    for (var a = 0u; a < ACROSS; a++) {
        let ux = quad_x[a] - slot.start.x;
        for (var r = 0u; r < ROWS; r++) {
            let uy = row_y[r] - slot.start.y;
            let aside = abs(ux * slot.edge.y - uy * slot.edge.x);
            let foot = (ux * slot.edge.x + uy * slot.edge.y) * per_square;
            let t = clamp(foot + aside * leaning, vec4f(0.0), vec4f(1.0));
            let dx = ux - t * slot.edge.x;
            let dy = uy - t * slot.edge.y;
            let q = quad_of(a, r);
            beyond[q] = min(sqrt(dx * dx + dy * dy) - (slot.radius + t * slot.radius_change), beyond[q]);
        }
    }
}

fn wall_bound(tile: Tile, node: Node, of_first: bool) -> f32 {
    let around = boxes[box_of(0u, node)];
    if of_first && around.tiers <= 0.0 {
        return ABSENT;
    }
    return sqrt(squared_distance(tile, around.low, around.high)) - around.radius - parameters.distance_slack;
}

fn next_walls(tile: Tile, first: Node, limit: f32, of_first: bool) -> Node {
    var node = first;
    while !is_beyond(0u, node) {
        let is_near = wall_bound(tile, node, of_first) <= limit;
        if is_near && node.height == 0u {
            break;
        }
        if is_near {
            node = within(node);
        } else {
            node = after(node);
        }
    }
    return node;
}

fn meet_walls(tile: Tile, bundle: u32, limit: f32, of_first: bool) {
    for (var s = 0u; s < FAN; s++) {
        let slot = slots[bundle * FAN + s];
        let counts = !of_first || slot.tiers > 0.0;
        let widest = slot.radius + max(slot.radius_change, 0.0);
        let nearest = sqrt(square_to_segment(tile, slot)) - tile.radius - widest - parameters.distance_slack;
        if counts && nearest <= limit {
            lower_beyond(slot);
        }
    }
}

fn nearest_walls(tile: Tile, near: f32, far: f32, of_first: bool) {
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        beyond[q] = vec4f(FAR);
    }
    var limit = far;
    var node = next_walls(tile, first_node(0u), limit, of_first);
    while !is_beyond(0u, node) {
        meet_walls(tile, node.index, limit, of_first);
        let farthest = largest(beyond);
        if farthest <= near {
            break;
        }
        limit = min(farthest, far);
        node = next_walls(tile, after(node), limit, of_first);
    }
}
