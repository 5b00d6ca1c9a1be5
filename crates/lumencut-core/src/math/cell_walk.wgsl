// Follows rays through the volume cell by cell; within a cell the volume along a ray is a cubic.
// import math/cubic
// import math/ray

const NO_MEETING: f32 = 1e9;
const ALONG_PLANE: f32 = 1e-9;

struct Found {
    // The largest value, or the negated smallest one.
    best: f32,
    // Σ value · share of the ray's segment, and Σ share.
    sum: f32,
    share: f32,
}

fn corners_at(voxel: vec3i, sign: f32) -> Corners {
    let corners = corners_in(voxel);
    if FLOAT_VOXELS && largest_corner(corners) >= HUGE {
        return Corners(vec4f(HUGE), vec4f(HUGE));
    }
    return Corners(corners.near * sign, corners.far * sign);
}

// Follows a ray over `way` voxels. Finds values above `so_far`, or sums all values if `wants_mean`.
fn walk_cells(start: GridPosition, way: vec3f, sign: f32, limit: f32, wants_mean: bool, so_far: f32) -> Found {
    let carry = floor(start.part);
    let first = start.whole + carry;
    let place = start.part - carry;
    let is_along = abs(way) < vec3f(ALONG_PLANE);
    let per_voxel = 1.0 / select(way, vec3f(1.0), is_along);
    let sense = select(vec3f(-1.0), vec3f(1.0), way > vec3f());
    let low = vec3f(grid.low);
    var cell = vec3f();
    var plane = select(vec3f(), vec3f(1.0), way > vec3f());
    var found = Found(so_far, 0.0, 0.0);
    var enter = 0.0;
    // Each iteration crosses a plane or ends the loop.
    let most = i32(abs(way.x)) + i32(abs(way.y)) + i32(abs(way.z)) + 8;
    for (var turn = 0; turn < most; turn++) {
        let meeting = select((plane - place) * per_voxel, vec3f(NO_MEETING), is_along);
        let leave = min(1.0, min(meeting.x, min(meeting.y, meeting.z)));
        let voxel = clamp(first + cell, vec3f(), low);
        let corners = corners_at(vec3i(voxel), sign);
        let top = largest_corner(corners);
        if top < HUGE && (wants_mean || min(top, limit) > found.best) {
            let beside = place + (first - voxel);
            let one = clamp(beside + way * enter, vec3f(), vec3f(1.0));
            let other = clamp(beside + way * leave, vec3f(), vec3f(1.0));
            let cubic = cubic_between(corners, one, other);
            if wants_mean {
                let share = max(leave - enter, 0.0);
                found.sum += share * mean_of(cubic);
                found.share += share;
            } else {
                found.best = max(found.best, min(min(largest_of(cubic), top), limit));
            }
        }
        if leave >= 1.0 {
            break;
        }
        let is_crossed = meeting <= vec3f(leave);
        cell += select(vec3f(), sense, is_crossed);
        plane += select(vec3f(), sense, is_crossed);
        enter = leave;
    }
    return found;
}
