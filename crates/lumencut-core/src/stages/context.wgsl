// The context: rays through the volume behind the cut surface (paper section 3.3.6). The first pass writes
// the starts of rays, the second follows the rays. In a preview, one ray serves a square of pixels, and a third
// pass blends the squares.
// import math/reduce
// import math/trace

// Must equal the values of the Rust enum `Gathering`.
const BLEND = 0u;
const BRIGHTEST = 1u;
const DARKEST = 2u;
const AVERAGE = 3u;

override MODE: u32 = 0u;

// Side of the square of pixels that one ray serves.
override SIDE: u32 = 1u;

// The binding of `focus` is empty if there is no focus.
override HAS_FOCUS: bool = false;
// Whether rays start at a partly shown cut surface; otherwise they start in front of the volume.
override FROM_CUT: bool = true;

// context.rs explains this value.
const IN_FRONT: f32 = NONE / 2.0;

@group(0) @binding(2) var<storage, read> value: array<f32>;
@group(0) @binding(3) var<storage, read> depth: array<f32>;
@group(0) @binding(4) var<storage, read_write> start_image: array<f32>;
@group(0) @binding(5) var<storage, read> focus: array<vec4f>;
@group(0) @binding(5) var<storage, read> start: array<f32>;
@group(0) @binding(6) var<storage, read_write> context_image: array<vec4f>;

struct Square {
    color: vec4f,
    // Where the ray of the square starts.
    start: f32,
}
@group(0) @binding(7) var<storage, read_write> squares: array<Square>;

// The bindings of `spread`.
@group(0) @binding(1) var<storage, read> fine_start: array<f32>;
@group(0) @binding(2) var<storage, read> followed: array<Square>;
@group(0) @binding(3) var<storage, read_write> spread_image: array<vec4f>;

// The start of the ray of each pixel; context.rs explains the cases.
@compute @workgroup_size(8, 8)
fn starts(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let p = place_of(thread.xy);
    var share = 1.0;
    if HAS_FOCUS {
        share = focus[p].x;
    }
    let is_transparent = ramp_at(parameters.opacity, value[p]) * share < 1.0;
    let behind = select(NONE, depth[p] + parameters.behind, is_transparent);
    let is_whole = value[p] >= HUGE || (share < 1.0 && !FROM_CUT);
    start_image[p] = select(behind, WHOLE, is_whole);
}

fn ray_from(n: vec2f, start: f32) -> vec4f {
    if start >= NONE {
        return vec4f();
    }
    let ray = cut(foot_at(n), depth_at(start), endless(), parameters.per_step);
    switch MODE {
        case BRIGHTEST: { return brightest(largest_along(ray, 1.0, parameters.last)); }
        // Below the black end of the window everything is black.
        case DARKEST: {
            let darkest = -largest_along(ray, -1.0, -parameters.black);
            return grey(ramp_at(parameters.window, darkest), darkest < HUGE);
        }
        case AVERAGE: {
            let sums = sums_along(ray);
            return grey(ramp_at(parameters.window, sums.x / max(sums.y, TINY)), sums.y > 0.0);
        }
        default: { return trace(ray); }
    }
}

// The ray of a square of pixels. context.rs explains where it starts.
fn follow_square(square: vec2u) {
    let first = SIDE * square;
    var nearest = NONE;
    for (var n = 0u; n < SIDE * SIDE; n++) {
        let pixel = first + vec2u(n % SIDE, n / SIDE);
        if in_view(pixel) {
            let own = start[place_of(pixel)];
            nearest = min(nearest, select(own, IN_FRONT, own <= WHOLE));
        }
    }
    let begin = select(nearest, WHOLE, nearest == IN_FRONT);
    let middle = from_middle(first) + vec2f(0.5, -0.5) * f32(SIDE - 1u);
    let place = square.y * squares_across() + square.x;
    squares[place] = Square(ray_from(middle, begin), begin);
}

fn squares_across() -> u32 {
    return (view.size.x + SIDE - 1u) / SIDE;
}

@compute @workgroup_size(8, 8)
fn context(@builtin(global_invocation_id) thread: vec3u) {
    if SIDE > 1u {
        if in_view(SIDE * thread.xy) {
            follow_square(thread.xy);
        }
    } else if in_view(thread.xy) {
        let p = place_of(thread.xy);
        context_image[p] = ray_from(from_middle(thread.xy), start[p]);
    }
}

// Blends the four squares around each pixel; context.rs explains which of them count.
@compute @workgroup_size(8, 8)
fn spread(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let p = place_of(thread.xy);
    let own = fine_start[p];
    let last = (vec2i(view.size) - 1) / i32(SIDE);
    let place = (vec2f(thread.xy) + 0.5) / f32(SIDE) - 0.5;
    let low = floor(place);
    let part = place - low;
    var sum = vec4f();
    var all = 0.0;
    for (var n = 0u; n < 4u; n++) {
        let step = vec2u(n % 2u, n / 2u);
        let square = vec2u(clamp(vec2i(low) + vec2i(step), vec2i(0), last));
        let found = followed[square.y * squares_across() + square.x];
        let counts = found.start < NONE && (found.start <= WHOLE) == (own <= WHOLE);
        let both = select(1.0 - part, part, step == vec2u(1u));
        let weight = select(0.0, both.x * both.y, counts);
        sum += weight * found.color;
        all += weight;
    }
    let square = thread.xy / SIDE;
    let nearest = followed[square.y * squares_across() + square.x].color;
    let blended = select(nearest, sum / max(all, TINY), all > 0.0);
    spread_image[p] = select(blended, vec4f(), own >= NONE);
}
