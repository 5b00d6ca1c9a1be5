// The surface: the volume at the world point that each pixel's depth stands for (paper section 3.3.4).
// import math/ray

const MEAN = 0u;
const LARGEST = 1u;
const SMALLEST = 2u;
// A sum of so many samples keeps its digits.
const CHUNK = 256u;

// A thick cut surface.
struct Slab {
    // The length of a part (mm).
    part: f32,
    // The parts on each side of the one in the middle.
    beside: u32,
    // What it shows.
    mode: u32,
    padding: u32,
}

@group(0) @binding(1) var<uniform> slab: Slab;
@group(0) @binding(4) var<storage, read> depth: array<f32>;
@group(0) @binding(5) var<storage, read_write> value: array<f32>;

// The volume `behind` a depth; HUGE outside it.
fn sample(foot: Foot, depth: Depth, behind: f32) -> f32 {
    let place = place_at(foot, deeper(depth, behind));
    if is_outside(place) {
        return HUGE;
    }
    return value_in(cell_of(place));
}

// All samples of a slab, but for those that are outside; there is one at the cut surface.
fn thick(foot: Foot, depth: Depth, center: f32) -> f32 {
    var shown = center;
    var sum = 0.0;
    var count = 1.0;
    for (var n = 0u; n < 2u * slab.beside; n++) {
        let way = f32(n / 2u + 1u) * slab.part;
        let beside = sample(foot, depth, select(way, -way, n % 2u == 0u));
        if beside < HUGE {
            switch slab.mode {
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
    let pixel = place_of(thread.xy);
    let foot = foot_at(from_middle(thread.xy));
    let at = depth_at(depth[pixel]);
    let center = sample(foot, at, 0.0);
    value[pixel] = center;
    if center < HUGE && slab.beside > 0u {
        value[pixel] = thick(foot, at, center);
    }
}
