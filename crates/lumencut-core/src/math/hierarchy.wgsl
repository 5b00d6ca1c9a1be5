// The hierarchy over the slots of each level: boxes around bundles, around sixteen boxes, and so on to one root. A walk
// needs no stack: the places of its nodes are numbers, and where it has to go next follows from where it is.
// import math/lanes
// import math/levels
// import math/tile
// import math/pieces

// The box around a node's segments in the view plane, its nearest depth, its largest radius (mm), and its most tiers.
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

// A node: at height 0 a bundle, above them boxes.
struct Node {
    height: u32,
    index: u32,
}

// The place of a node's box.
fn box_of(level: u32, node: Node) -> u32 {
    return first_box(level, node.height) + node.index;
}

// The squared distance (mm²) between the tile and a box.
fn squared_distance(tile: Tile, low: vec2f, high: vec2f) -> f32 {
    let gap = max(max(low - tile.center, tile.center - high) - tile.half, vec2f(0.0));
    return dot(gap, gap);
}

// The first of the nodes below the root.
fn first_node(level: u32) -> Node {
    return Node(parameters.levels[level].height_count - 1u, 0u);
}

// Whether the walk has left the last node.
fn is_beyond(level: u32, node: Node) -> bool {
    return node.height >= parameters.levels[level].height_count;
}

// The first of the nodes within a node.
fn within(node: Node) -> Node {
    return Node(node.height - 1u, node.index * FAN);
}

// The node that follows all that is within a node: its next brother, or that of the node that holds it, and so on.
fn after(node: Node) -> Node {
    let next = node.index + 1u;
    // The last of FAN = 2⁴ brothers is followed by what follows their node.
    let up = countTrailingZeros(next) / 4u;
    return Node(node.height + up, next >> (4u * up));
}
