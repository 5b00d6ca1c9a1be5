// The hierarchy over the slots of each level. A walk needs no stack: nodes are numbered so that the next node
// follows from the current one.
// import math/lanes
// import math/levels
// import math/tile
// import math/pieces

struct NodeBox {
    low: vec2f,
    high: vec2f,
    z: f32,
    radius: f32,
    tiers: f32,
    padding: f32,
}

@group(0) @binding(2) var<storage, read> slots: array<Slot>;
@group(0) @binding(3) var<storage, read> boxes: array<NodeBox>;

// A node: a bundle at height 0, boxes above.
struct Node {
    height: u32,
    index: u32,
}

fn box_of(level: u32, node: Node) -> u32 {
    return first_box(level, node.height) + node.index;
}

fn squared_distance(tile: Tile, low: vec2f, high: vec2f) -> f32 {
    let gap = max(max(low - tile.center, tile.center - high) - tile.half, vec2f(0.0));
    return dot(gap, gap);
}

fn first_node(level: u32) -> Node {
    return Node(parameters.levels[level].height_count - 1u, 0u);
}

fn is_beyond(level: u32, node: Node) -> bool {
    return node.height >= parameters.levels[level].height_count;
}

fn within(node: Node) -> Node {
    return Node(node.height - 1u, node.index * FAN);
}

// The node after all descendants of a node: its next sibling, or its parent's next sibling, and so on.
fn after(node: Node) -> Node {
    let next = node.index + 1u;
    // The last of FAN = 2⁴ siblings is followed by its parent's successor.
    let up = countTrailingZeros(next) / 4u;
    return Node(node.height + up, next >> (4u * up));
}
