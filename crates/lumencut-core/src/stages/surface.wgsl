// The surface stage: samples the volume at the world position of each pixel (paper section 3.3.4).
// import math/cell_walk

// Whether pixels have separate positions; otherwise they lie on the rays of a camera, at given depths.
override CURVED: bool = false;

const MEAN = 0u;
const LARGEST = 1u;
const SMALLEST = 2u;
// Number of parts of a slab that are followed together.
const STRETCH: i32 = 8;

// A thick cut surface; surface.rs explains the fields.
struct SurfaceParameters {
    half: f32,
    mode: u32,
    per_step: f32,
    padding: u32,
}

// A pixel of a curved geometry: the integer part of its voxel index, the remainder, and the change of the
// index per mm along the slab direction. The fourth components are padding.
struct CurvedPixel {
    whole: vec4f,
    part: vec4f,
    per_mm: vec4f,
}

@group(0) @binding(1) var<uniform> parameters: SurfaceParameters;
@group(0) @binding(4) var<storage, read> depth: array<f32>;
@group(0) @binding(5) var<storage, read_write> value: array<f32>;
// Empty if the geometry is that of a camera.
@group(0) @binding(6) var<storage, read> places: array<CurvedPixel>;

struct Target {
    pixel: u32,
    foot: Foot,
    depth: Depth,
}

fn target_of(pixel: vec2u) -> Target {
    var seen: Target;
    seen.pixel = place_of(pixel);
    if !CURVED {
        seen.foot = foot_at(from_middle(pixel));
        seen.depth = depth_at(depth[seen.pixel]);
    }
    return seen;
}

fn place_of_target(seen: Target) -> GridPosition {
    if CURVED {
        let own = places[seen.pixel];
        return GridPosition(own.whole.xyz, own.part.xyz);
    }
    return place_at(seen.foot, seen.depth);
}

// The volume at a pixel; HUGE outside it.
fn thin(seen: Target) -> f32 {
    let place = place_of_target(seen);
    if is_outside(place) {
        return HUGE;
    }
    return value_in(cell_of(place));
}

// The ends of a curved pixel's slab within the volume (mm from the pixel's position).
fn slab_within(own: CurvedPixel) -> vec2f {
    var ends = vec2f(-parameters.half, parameters.half);
    let above_first = own.whole.xyz + 0.5 + own.part.xyz;
    let above_last = own.whole.xyz - grid.last - 0.5 + own.part.xyz;
    for (var a = 0; a < 3; a++) {
        let per_mm = own.per_mm[a];
        if abs(per_mm) >= ALONG_PLANE {
            let one = -above_first[a] / per_mm;
            let other = -above_last[a] / per_mm;
            ends = vec2f(max(ends.x, min(one, other)), min(ends.y, max(one, other)));
        }
    }
    return ends;
}

fn join(shown: Found, start: GridPosition, way: vec3f, share: f32) -> Found {
    let sign = select(1.0, -1.0, parameters.mode == SMALLEST);
    let found = walk_cells(start, way, sign, HUGE, parameters.mode == MEAN, shown.best);
    return Found(found.best, shown.sum + share * found.sum, shown.share + share * found.share);
}

fn thick(seen: Target, center: f32) -> f32 {
    var shown = Found(-HUGE, 0.0, 0.0);
    if CURVED {
        let own = places[seen.pixel];
        let ends = slab_within(own);
        let count = i32(ceil(max(ends.y - ends.x, 0.0) * parameters.per_step / f32(STRETCH)));
        let length = (ends.y - ends.x) / f32(max(count, 1));
        for (var n = 0; n < count; n++) {
            let begin = ends.x + f32(n) * length;
            let start = GridPosition(own.whole.xyz, own.part.xyz + begin * own.per_mm.xyz);
            shown = join(shown, start, length * own.per_mm.xyz, 1.0);
        }
    } else {
        let near = deeper(seen.depth, -parameters.half);
        let ray = cut(seen.foot, near, deeper(seen.depth, parameters.half), parameters.per_step);
        let way = ray.part * (grid.z.xyz + grid.z_rest.xyz);
        for (var n = 0; n < ray.count; n += STRETCH) {
            let count = f32(min(STRETCH, ray.count - n));
            let start = place_at(ray.foot, deeper(ray.near, ray.part * f32(n)));
            shown = join(shown, start, count * way, count);
        }
    }
    if parameters.mode == MEAN {
        return select(center, shown.sum / max(shown.share, TINY), shown.share > 0.0);
    }
    return select(center, select(shown.best, -shown.best, parameters.mode == SMALLEST), shown.best > -HUGE);
}

@compute @workgroup_size(8, 8)
fn surface(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let seen = target_of(thread.xy);
    let center = thin(seen);
    value[seen.pixel] = center;
    if center < HUGE && parameters.half > 0.0 {
        value[seen.pixel] = thick(seen, center);
    }
}
