// The ray loop of the context: takes samples in runs of eight, and skips blocks that change nothing.
// import math/accumulate
// import math/blocks
// import math/ray

// Number of samples of a ray that are taken together.
const RUN: i32 = 8;

fn trace(ray: Ray) -> vec4f {
    let way = ray.part * (grid.z.xyz + grid.z_rest.xyz);
    var gathered = nothing();
    var level = parameters.level_count - 1u;
    var n = 0;
    loop {
        // Threads in lockstep wait for each other, so all skip first, and then all sample.
        n = skip(ray, way, gathered, n, &level);
        if n >= ray.count {
            break;
        }
        let place = sample_place(ray, n);
        let count = min(RUN, ray.count - n);
        for (var m = 0; m < count; m++) {
            take(&gathered, GridPosition(place.whole, place.part + f32(m) * way), ray.part);
        }
        n += RUN;
        if ignores(gathered, ALL) {
            break;
        }
    }
    return finished(gathered);
}

fn skip(ray: Ray, way: vec3f, gathered: Gathered, first: i32, level: ptr<function, u32>) -> i32 {
    let coarsest = parameters.level_count - 1u;
    var n = first;
    while n < ray.count {
        let cell = cell_of(sample_place(ray, n));
        if ignores(gathered, range_at(*level, cell.voxel)) {
            n += 1 + samples_left(*level, cell, way);
            *level = min(*level + 1u, coarsest);
        } else if *level == 0u {
            break;
        } else {
            *level -= 1u;
        }
    }
    return n;
}

fn take(gathered: ptr<function, Gathered>, place: GridPosition, thickness: f32) {
    let value = value_in(cell_of(place));
    if value < HUGE {
        gather(gathered, value, place, thickness);
    }
}
