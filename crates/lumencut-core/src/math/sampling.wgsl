// Trilinear sampling of the volume, with the arithmetic of the CPU.
// import math/lanes

// Whether the voxels are floats, stored as their bits; otherwise they are integers.
override FLOAT_VOXELS: bool = false;

const POSITION_ROUNDING: f32 = 1e-3;

// The volume's grid in the view. The fourth component of vectors is padding.
struct GridParameters {
    last: vec3f,
    // The number that was subtracted from voxels of an unsigned type.
    shift: f32,
    // The last voxel that has a neighbour above it; 0 along an axis with one voxel.
    low: vec3i,
    // The reference depth, in the middle of the volume (mm).
    depth: f32,
    // Depths are split into multiples of `unit` and the rest (mm).
    unit: f32,
    per_unit: f32,
    padding: vec2f,
    // The index at the image centre at the reference depth, and its change per column, row and mm of depth.
    // Each is split into a part of few digits, whose products and sums are exact, and the rest (`_rest`).
    origin: vec4f,
    origin_rest: vec4f,
    x: vec4f,
    x_rest: vec4f,
    y: vec4f,
    y_rest: vec4f,
    z: vec4f,
    z_rest: vec4f,
    // Depth per voxel (mm); 0 along axes perpendicular to the view.
    per_voxel: vec4f,
    // Change of the index per mm to the right, and upwards.
    right: vec4f,
    up: vec4f,
}

@group(0) @binding(2) var<uniform> grid: GridParameters;
@group(0) @binding(3) var voxels: texture_3d<i32>;

// A continuous index: an integer and a remainder, so that fractions keep their digits.
struct GridPosition {
    whole: vec3f,
    part: vec3f,
}

struct Cell {
    voxel: vec3i,
    share: vec3f,
}

// The values at the corners of a cell: the four rows along i, j fastest, each from its near to its far voxel.
struct Corners {
    near: vec4f,
    far: vec4f,
}

fn is_outside(place: GridPosition) -> bool {
    let above_first = place.whole + 0.5 + place.part;
    let above_last = place.whole - grid.last - 0.5 + place.part;
    return any(above_first < vec3f()) || any(above_last > vec3f());
}

fn cell_of(place: GridPosition) -> Cell {
    let carry = floor(place.part);
    let whole = place.whole + carry;
    let low = vec3f(grid.low);
    var share = place.part - carry;
    share = select(share, grid.last - low, whole > low);
    share = select(share, vec3f(), whole < vec3f());
    return Cell(vec3i(clamp(whole, vec3f(), low)), share);
}

fn voxel_at(i: i32, j: i32, k: i32) -> f32 {
    let stored = textureLoad(voxels, vec3i(i, j, k), 0).x;
    if FLOAT_VOXELS {
        return bitcast<f32>(stored);
    }
    return f32(stored) + grid.shift;
}

fn corners_in(near: vec3i) -> Corners {
    let far = near + vec3i(grid.last) - grid.low;
    let low = vec4f(
        voxel_at(near.x, near.y, near.z),
        voxel_at(near.x, far.y, near.z),
        voxel_at(near.x, near.y, far.z),
        voxel_at(near.x, far.y, far.z),
    );
    let high = vec4f(
        voxel_at(far.x, near.y, near.z),
        voxel_at(far.x, far.y, near.z),
        voxel_at(far.x, near.y, far.z),
        voxel_at(far.x, far.y, far.z),
    );
    return Corners(low, high);
}

// The value in a cell; HUGE if one of its voxels has none.
fn value_in(cell: Cell) -> f32 {
    let corners = corners_in(cell.voxel);
    let low = corners.near;
    let high = corners.far;
    if FLOAT_VOXELS && any(max(low, high) >= vec4f(HUGE)) {
        return HUGE;
    }
    let rows = low + (high - low) * cell.share.x;
    let planes = rows.xz + (rows.yw - rows.xz) * cell.share.y;
    return planes.x + (planes.y - planes.x) * cell.share.z;
}
