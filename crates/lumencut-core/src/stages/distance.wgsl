// The distance of every pixel to the nearest vessel of the finest level, in the view plane (paper section 3.3.1).
// import math/hierarchy
// import math/nearest

@group(0) @binding(4) var<storage, read_write> distance_image: array<f32>;

// The squared distance between the tile and a node of the finest level.
fn square_to_node(tile: Tile, node: Node) -> f32 {
    let around = boxes[box_of(0u, node)];
    return squared_distance(tile, around.low, around.high);
}

// The nearest to the tile of a node and its brothers after it.
fn nearest_node(tile: Tile, first: Node) -> Node {
    var nearest = first;
    var least = HUGE;
    for (var n = 0u; n < FAN; n++) {
        let brother = Node(first.height, first.index + n);
        let square = square_to_node(tile, brother);
        nearest.index = select(nearest.index, brother.index, square < least);
        least = min(least, square);
    }
    return nearest;
}

// A bundle near the tile: from the root to the nearest box of each height.
fn near_bundle(tile: Tile) -> u32 {
    var node = nearest_node(tile, first_node(0u));
    while node.height > 0u {
        node = nearest_node(tile, within(node));
    }
    return node.index;
}

// The next bundle, from a node on, within reach of the middle of the tile; beyond the last node if there is none.
fn next_bundle(tile: Tile, first: Node, reach: f32) -> Node {
    var node = first;
    while !is_beyond(0u, node) {
        let is_near = square_to_node(tile, node) <= reach * reach;
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

// Meets the segments of a bundle that may be nearest to some pixel, given the distance from the middle of the tile that
// some segment is known to have; gives that distance anew.
fn meet(tile: Tile, bundle: u32, known: f32) -> f32 {
    var nearest = known;
    var candidates = 0u;
    for (var s = 0u; s < FAN; s++) {
        let away = sqrt(square_to_segment(tile, slots[bundle * FAN + s]));
        nearest = min(nearest, away);
        // No pixel is farther than the radius from the middle: what is farther than twice that is nearest to none.
        candidates |= select(0u, 1u, away <= nearest + 2.0 * tile.radius + slack(tile)) << s;
    }
    while candidates != 0u {
        lower_distance(slots[bundle * FAN + countTrailingZeros(candidates)]);
        candidates &= candidates - 1u;
    }
    return nearest;
}

@compute @workgroup_size(4, 16)
fn distance(@builtin(global_invocation_id) thread: vec3u) {
    let tile = tile_at(thread.xy);
    if !in_view(tile.pixel) {
        return;
    }
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        least_square[q] = vec4f(UNSET);
    }
    let margin = tile.radius + slack(tile);
    // A bundle that is near, and then all within reach.
    var nearest = FAR;
    var node = Node(0u, near_bundle(tile));
    var next = first_node(0u);
    while !is_beyond(0u, node) {
        nearest = meet(tile, node.index, nearest);
        node = next_bundle(tile, next, nearest + margin);
        next = after(node);
    }
    for (var r = 0u; r < ROWS; r++) {
        for (var a = 0u; a < ACROSS; a++) {
            for (var c = 0u; c < QUAD; c++) {
                let pixel = pixel_of(tile, a, r, c);
                if in_view(pixel) {
                    distance_image[place_of(pixel)] = sqrt(least_square[quad_of(a, r)][c]);
                }
            }
        }
    }
}
