// The surface: the volume at the world point where each pixel looks (paper section 3.3.4).
// import math/ray

// Whether pixels have places of their own; else they look along the rays of a camera, at depths.
override CURVED: bool = false;

const MEAN = 0u;
const LARGEST = 1u;
const SMALLEST = 2u;
// A sum of so many samples keeps its digits.
const CHUNK = 256u;

// A thick cut surface.
struct SurfaceParameters {
    // The length of a part (mm).
    part: f32,
    // The parts on each side of the one in the middle.
    beside: u32,
    // What it shows.
    mode: u32,
    padding: u32,
    // The length of a part with the digits of f64, for the CPU.
    exact_part: vec2u,
}

// Where a pixel of a curved geometry lies in the volume: the whole numbers of its index, what is to be added to them, and
// the index per mm along the direction in which a slab is thick. The last numbers mean nothing.
struct CurvedPlace {
    whole: vec4f,
    part: vec4f,
    per_mm: vec4f,
}

@group(0) @binding(1) var<uniform> parameters: SurfaceParameters;
@group(0) @binding(4) var<storage, read> depth: array<f32>;
@group(0) @binding(5) var<storage, read_write> value: array<f32>;
// Where pixels have no places of their own, its binding holds nothing.
@group(0) @binding(6) var<storage, read> places: array<CurvedPlace>;

// Where a pixel looks.
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

fn place_behind(seen: Target, behind: f32) -> Place {
    if CURVED {
        let own = places[seen.pixel];
        return Place(own.whole.xyz, own.part.xyz + behind * own.per_mm.xyz);
    }
    return place_at(seen.foot, deeper(seen.depth, behind));
}

// The volume `behind` where a pixel looks; HUGE outside it.
fn sample(seen: Target, behind: f32) -> f32 {
    let place = place_behind(seen, behind);
    if is_outside(place) {
        return HUGE;
    }
    return value_in(cell_of(place));
}

// All samples of a slab, but for those that are outside; there is one at the cut surface.
fn thick(seen: Target, center: f32) -> f32 {
    var shown = center;
    var sum = 0.0;
    var count = 1.0;
    for (var n = 0u; n < 2u * parameters.beside; n++) {
        let way = f32(n / 2u + 1u) * parameters.part;
        let beside = sample(seen, select(way, -way, n % 2u == 0u));
        if beside < HUGE {
            switch parameters.mode {
                case LARGEST: { shown = max(shown, beside); }
                case SMALLEST: { shown = min(shown, beside); }
                default: {
                    sum += beside;
                    count += 1.0;
                }
            }
        }
        if n % CHUNK == CHUNK - 1u {
            shown += sum;
            sum = 0.0;
        }
    }
    return (shown + sum) / count;
}

@compute @workgroup_size(8, 8)
fn surface(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let seen = target_of(thread.xy);
    let center = sample(seen, 0.0);
    value[seen.pixel] = center;
    if center < HUGE && parameters.beside > 0u {
        value[seen.pixel] = thick(seen, center);
    }
}
