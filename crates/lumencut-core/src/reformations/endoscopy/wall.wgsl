// The wall stage: where the ray of each pixel meets the wall of a vessel; wall.rs explains the steps.
// import math/sampling
// import math/tube

// A ray: its unit direction, and where it starts and ends (mm from the eye).
struct WallRay {
    direction: vec3f,
    start: f32,
    end: f32,
    padding_0: f32,
    padding_1: f32,
    padding_2: f32,
}

@group(0) @binding(6) var<storage, read> rays: array<WallRay>;
@group(0) @binding(7) var<storage, read_write> wall_image: array<f32>;

// Above 0 within the lumen; HUGE outside the volume.
fn within_lumen(ray: vec3f, away: f32, row: TubeRow) -> f32 {
    let place = tube.eye.xyz + ray * away;
    let index = tube.origin.xyz + place.x * tube.x.xyz + place.y * tube.y.xyz + place.z * tube.z.xyz;
    let whole = floor(index);
    let position = GridPosition(whole, index - whole);
    if is_outside(position) {
        return HUGE;
    }
    let value = value_in(cell_of(position));
    if value >= HUGE {
        return HUGE;
    }
    return min(row.across.w * (value - row.middle.w), row.across.w * (row.tangent.w - value));
}

// The distance at which a ray that has passed an opening leaves the lumen; HUGE if it does not.
fn followed(ray: vec3f, found: Met, end: f32) -> f32 {
    let row = tube_rows[found.row];
    var before = within_lumen(ray, found.away, row);
    if before <= 0.0 {
        return found.away;
    }
    var found_end = HUGE;
    var n = 0.0;
    loop {
        let last = found.away + n * tube.origin.w;
        let away = found.away + (n + 1.0) * tube.origin.w;
        let here = within_lumen(ray, away, row);
        if away > end || here >= HUGE {
            break;
        }
        if here <= 0.0 {
            found_end = last + tube.origin.w * before / (before - here);
            break;
        }
        before = here;
        n += 1.0;
    }
    return found_end;
}

@compute @workgroup_size(8, 8)
fn wall(@builtin(global_invocation_id) thread: vec3u) {
    if any(thread.xy >= tube.size) {
        return;
    }
    let pixel = thread.y * tube.size.x + thread.x;
    let ray = rays[pixel];
    let found = met(ray.direction, ray.start, ray.end);
    var away = HUGE;
    if found.kind == WALL {
        away = found.away;
    } else if found.kind == OPENING {
        let last = followed(ray.direction, found, ray.end);
        away = select(-last, HUGE, last >= HUGE);
    }
    wall_image[pixel] = away;
}
