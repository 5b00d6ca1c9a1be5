// The smallest and largest value of each block of the volume, so that rays skip blocks they cannot see.
// import math/sampling
// import math/context_parameters

const SIDE_BITS = 2u;
const ALL = vec2f(-HUGE, HUGE);
// Larger than any voxel index and than the number of samples of any ray.
const FARTHEST: f32 = 1e6;

@group(0) @binding(4) var<storage, read> blocks: array<vec2f>;

fn side_bits(level: u32) -> u32 {
    return SIDE_BITS + parameters.finest + level;
}

fn range_at(level: u32, voxel: vec3i) -> vec2f {
    let size = parameters.levels[level];
    let block = vec3u(voxel) >> vec3u(side_bits(level));
    return blocks[size.w + (block.z * size.y + block.y) * size.x + block.x];
}

// A lower bound on the number of further samples in the block, if the ray moves by `way` per step.
fn samples_left(level: u32, cell: Cell, way: vec3f) -> i32 {
    let bits = vec3u(side_bits(level));
    let block = vec3u(cell.voxel) >> bits;
    let first = vec3i(block << bits);
    let beyond = vec3i((block + 1u) << bits);
    // The outermost blocks extend to infinity.
    let up = select(vec3f(beyond - cell.voxel) - cell.share, vec3f(FARTHEST), beyond > grid.low);
    let down = select(vec3f(cell.voxel - first) + cell.share, vec3f(FARTHEST), first == vec3i());
    let room = select(down, up, way > vec3f());
    let steps = (min(room, vec3f(FARTHEST)) - POSITION_ROUNDING) / max(abs(way), vec3f(1.0 / FARTHEST));
    return i32(clamp(min(min(steps.x, steps.y), steps.z), 0.0, FARTHEST));
}
