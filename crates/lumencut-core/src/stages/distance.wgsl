// The distance of every pixel to the nearest vessel of the finest level, in the view plane (paper section
// 3.3.1).
// import math/hierarchy
// import math/nearest

@group(0) @binding(4) var<storage, read_write> distance_image: array<f32>;

fn square_to_node(tile: Tile, node: Node) -> f32 {
    let around = boxes[box_of(0u, node)];
    return squared_distance(tile, around.low, around.high);
}

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

fn near_bundle(tile: Tile) -> u32 {
    var node = nearest_node(tile, first_node(0u));
    while node.height > 0u {
        node = nearest_node(tile, within(node));
    }
    return node.index;
}

// The next bundle, from node `first` on, that can lower a distance; beyond the last node if there is none.
fn next_bundle(tile: Tile, first: Node, limit: f32) -> Node {
    var node = first;
    while !is_beyond(0u, node) {
        let is_near = square_to_node(tile, node) <= limit;
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

fn meet(tile: Tile, bundle: u32, limit: f32) -> f32 {
    // The tile's radius covers all its pixels, seen from the middle.
    let reach = sqrt(limit) + tile.radius + slack(tile);
    var candidates = 0u;
    for (var s = 0u; s < FAN; s++) {
        let square = square_to_segment(tile, slots[bundle * FAN + s]);
        candidates |= select(0u, 1u, square <= reach * reach) << s;
    }
    while candidates != 0u {
        lower_distance(slots[bundle * FAN + countTrailingZeros(candidates)]);
        candidates &= candidates - 1u;
    }
    return largest(least_square);
}

@compute @workgroup_size(TILES)
fn distance(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) thread: u32) {
    let tile = tile_at(group.xy, thread);
    if !in_view(tile.pixel) {
        return;
    }
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        least_square[q] = vec4f(UNSET);
    }
    var limit = meet(tile, near_bundle(tile), FAR * FAR);
    var node = next_bundle(tile, first_node(0u), limit);
    while !is_beyond(0u, node) {
        limit = meet(tile, node.index, limit);
        node = next_bundle(tile, after(node), limit);
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
