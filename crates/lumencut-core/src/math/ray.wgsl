// Rays through the volume: the part of a ray in the volume is cut into equal parts, sampled in their middle.
// import math/sampling
// import math/view

// The start of a ray that crosses the entire volume, and that of a ray that is not needed (depth in mm).
const WHOLE: f32 = -1e9;
const NONE: f32 = 1e9;
const NEVER: f32 = 2e9;
const SPARE: f32 = 1e-3;

// The voxel index (continuous) at which a ray crosses the plane at the grid's reference depth: the sum of both parts.
struct Foot {
    index: vec3f,
    rest: vec3f,
}

// A depth relative to the grid's reference (mm), split into a multiple of the grid's unit and the rest.
struct Depth {
    coarse: f32,
    rest: f32,
}

struct Ray {
    foot: Foot,
    near: Depth,
    // The length of a part (mm).
    part: f32,
    count: i32,
}

// Columns to the right of the middle of the image, and rows above it; exact.
fn from_middle(pixel: vec2u) -> vec2f {
    let n = vec2f(pixel) + 0.5 - 0.5 * vec2f(view.size);
    return vec2f(n.x, -n.y);
}

fn foot_at(n: vec2f) -> Foot {
    let index = grid.origin + n.x * grid.x + n.y * grid.y;
    let rest = grid.origin_rest + n.x * grid.x_rest + n.y * grid.y_rest;
    return Foot(index.xyz, rest.xyz);
}

// A multiple of the grid's unit; it has so few digits that its products are exact.
fn coarse(depth: f32) -> f32 {
    return round(depth * grid.per_unit) * grid.unit;
}

fn endless() -> Depth {
    return Depth(NONE, 0.0);
}

fn depth_at(depth: f32) -> Depth {
    let below = depth - grid.depth;
    return Depth(coarse(below), below - coarse(below));
}

fn deeper(depth: Depth, by: f32) -> Depth {
    let rest = depth.rest + by;
    return Depth(depth.coarse + coarse(rest), rest - coarse(rest));
}

fn place_at(foot: Foot, depth: Depth) -> GridPosition {
    let way = depth.coarse * grid.z.xyz;
    let rest = foot.rest + depth.coarse * grid.z_rest.xyz + depth.rest * (grid.z.xyz + grid.z_rest.xyz);
    return GridPosition(floor(foot.index) + floor(way), fract(foot.index) + fract(way) + rest);
}

fn latest(one: vec3f, rest: vec3f, start: Depth) -> Depth {
    var last = start;
    for (var a = 0; a < 3; a++) {
        let other = Depth(one[a], rest[a]);
        if other.coarse + other.rest > last.coarse + last.rest {
            last = other;
        }
    }
    return last;
}

fn coarse_meetings(foot: Foot, plane: vec3f) -> vec3f {
    return round((plane - foot.index) * grid.per_voxel.xyz * grid.per_unit) * grid.unit;
}

fn rests(foot: Foot, plane: vec3f, at: vec3f) -> vec3f {
    // The remaining distance to the plane; its large terms cancel exactly.
    let left = plane - foot.index - at * grid.z.xyz - (foot.rest + at * grid.z_rest.xyz);
    return left * grid.per_voxel.xyz;
}

fn cut(foot: Foot, start: Depth, end: Depth, per_step: f32) -> Ray {
    let is_parallel = grid.per_voxel.xyz == vec3f();
    let first = vec3f(-0.5);
    let last = grid.last + 0.5;
    let one = coarse_meetings(foot, first);
    let other = coarse_meetings(foot, last);
    let one_rest = rests(foot, first, one);
    let other_rest = rests(foot, last, other);
    let is_forward = grid.per_voxel.xyz > vec3f();
    let index = foot.index + foot.rest;
    let misses = is_parallel & ((index < first) | (index > last));
    var enter = select(other, one, is_forward);
    enter = select(enter, select(vec3f(-NEVER), vec3f(NEVER), misses), is_parallel);
    let leave = select(select(one, other, is_forward), vec3f(NEVER), is_parallel);
    let near = latest(enter, select(other_rest, one_rest, is_forward), start);
    let back = latest(-leave, -select(one_rest, other_rest, is_forward), Depth(-end.coarse, -end.rest));
    let chord = -(back.coarse + near.coarse) - (back.rest + near.rest);
    if chord <= 0.0 {
        return Ray(foot, near, 0.0, 0);
    }
    let count = max(i32(ceil(chord * per_step - SPARE)), 1);
    return Ray(foot, near, chord / f32(count), count);
}

fn sample_place(ray: Ray, n: i32) -> GridPosition {
    return place_at(ray.foot, deeper(ray.near, ray.part * (f32(n) + 0.5)));
}
