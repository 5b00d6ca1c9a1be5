// The largest, the smallest or the mean value along a ray through the entire volume.
// import math/blocks
// import math/cell_walk

// Number of parts of a ray that are followed together.
const STRETCH: i32 = 8;

// Number of stretches per partial sum: sums of few numbers lose fewer digits.
const FEW: i32 = 16;

fn part_place(ray: Ray, n: i32) -> GridPosition {
    return place_at(ray.foot, deeper(ray.near, ray.part * f32(n)));
}

// The largest value of `sign` · volume along a ray, clamped to `limit`; -HUGE if there is none.
fn largest_along(ray: Ray, sign: f32, limit: f32) -> f32 {
    let way = ray.part * (grid.z.xyz + grid.z_rest.xyz);
    var best = -HUGE;
    var level = parameters.level_count - 1u;
    var n = 0;
    loop {
        n = skip_parts(ray, way, vec3f(sign, limit, best), n, &level);
        if n >= ray.count || best >= limit {
            break;
        }
        let count = min(STRETCH, ray.count - n);
        best = walk_cells(part_place(ray, n), f32(count) * way, sign, limit, false, best).best;
        n += count;
    }
    return best;
}

// The first part from `first` on that can exceed the best; `search` holds the sign, the limit and the best.
fn skip_parts(ray: Ray, way: vec3f, search: vec3f, first: i32, level: ptr<function, u32>) -> i32 {
    let coarsest = parameters.level_count - 1u;
    var n = first;
    while n < ray.count {
        let cell = cell_of(part_place(ray, n));
        if is_no_larger(range_at(*level, cell.voxel), search) {
            // Only complete parts are skipped; one that leaves the block is skipped only with a larger block.
            let left = samples_left(*level, cell, way);
            if left > 0 {
                n += left;
                *level = min(*level + 1u, coarsest);
                continue;
            }
            if *level == coarsest || !is_no_larger(range_at(*level + 1u, cell.voxel), search) {
                break;
            }
            *level += 1u;
        } else if *level == 0u {
            break;
        } else {
            *level -= 1u;
        }
    }
    return n;
}

fn is_no_larger(range: vec2f, search: vec3f) -> bool {
    let top = select(-range.x, range.y, search.x > 0.0);
    return min(top, search.y) <= search.z;
}

fn sums_along(ray: Ray) -> vec2f {
    let way = ray.part * (grid.z.xyz + grid.z_rest.xyz);
    var sums = vec2f();
    var few = vec2f();
    var turn = 0;
    for (var n = 0; n < ray.count; n += STRETCH) {
        let count = f32(min(STRETCH, ray.count - n));
        let found = walk_cells(part_place(ray, n), count * way, 1.0, HUGE, true, 0.0);
        few += count * vec2f(found.sum, found.share);
        turn++;
        if turn % FEW == 0 {
            sums += few;
            few = vec2f();
        }
    }
    return sums + few;
}
