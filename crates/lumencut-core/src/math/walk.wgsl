// The walk through the hierarchy for one tile of pixels, up to the tile's worst key so far.
// import math/hierarchy
// import math/pieces
// import math/candidates

fn node_bound(tile: Tile, level: u32, node: Node) -> f32 {
    let around = boxes[box_of(level, node)];
    let away = sqrt(squared_distance(tile, around.low, around.high));
    return key_bound(around.z, away, around.radius, around.tiers);
}

fn most_promising(tile: Tile, level: u32, first: Node) -> Node {
    var best = first;
    var least = ABSENT;
    for (var n = 0u; n < FAN; n++) {
        let brother = Node(first.height, first.index + n);
        let bound = node_bound(tile, level, brother);
        best.index = select(best.index, brother.index, bound < least);
        least = min(least, bound);
    }
    return best;
}

// A bundle likely to hold low keys: from the root down, at each height the box with the lowest bound.
fn promising_bundle(tile: Tile, level: u32) -> u32 {
    var node = most_promising(tile, level, first_node(level));
    while node.height > 0u {
        node = most_promising(tile, level, within(node));
    }
    return node.index;
}

fn next_bundle(tile: Tile, level: u32, first: Node, limit: f32) -> Node {
    var node = first;
    while !is_beyond(level, node) {
        let can_win = node_bound(tile, level, node) <= limit;
        if can_win && node.height == 0u {
            break;
        }
        if can_win {
            node = within(node);
        } else {
            node = after(node);
        }
    }
    return node;
}

// Offers the pieces of a bundle and returns the new limit: no larger key can win. Candidates are found first,
// so that threads in lockstep evaluate them together.
fn offer_bundle(tile: Tile, bundle: u32, limit: f32) -> f32 {
    var candidates = 0u;
    for (var s = 0u; s < FAN; s++) {
        let smallest = smallest_keys(tile, slots[bundle * FAN + s]);
        candidates |= select(0u, 1u, smallest.x <= limit) << (2u * s + 1u);
        candidates |= select(0u, 1u, smallest.y <= limit) << (2u * s);
    }
    while candidates != 0u {
        let slot = slots[bundle * FAN + countTrailingZeros(candidates) / 2u];
        // Takes a stripe and its wedge together.
        let pair = 3u << (countTrailingZeros(candidates) & ~1u);
        offer_stripe(slot);
        offer_wedge(slot);
        candidates &= ~pair;
    }
    return key_limit(largest(winner_key));
}

fn lowest_keys(tile: Tile, level: u32) {
    let first_bundle = parameters.levels[level].first_bundle;
    let seed = promising_bundle(tile, level);
    var limit = offer_bundle(tile, first_bundle + seed, key_limit(UNSET));
    var node = next_bundle(tile, level, first_node(level), limit);
    while !is_beyond(level, node) {
        limit = offer_bundle(tile, first_bundle + node.index, limit);
        node = next_bundle(tile, level, after(node), limit);
    }
}
