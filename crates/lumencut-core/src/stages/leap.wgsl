// Leaps: depth jumps between neighbouring pixels that do not belong to one surface, and the side on which a
// leap's line is drawn; see leap.rs.
// import math/view
// import math/leaps

const SMALLEST_LEAP: f32 = 2.0;
const CHOSEN_GAP: f32 = -1.0;
const WALL_GAP: f32 = -2.0;
const ALONG_VIEW: f32 = 0.9;
const MOST_DIAMETERS: f32 = 2.0;

struct LeapParameters {
    pixel_spacing: f32,
}

@group(0) @binding(1) var<uniform> parameters: LeapParameters;
@group(0) @binding(2) var<storage, read> depth: array<f32>;
@group(0) @binding(3) var<storage, read> sheet: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> leap_image: array<u32>;
@group(0) @binding(5) var<storage, read> vessel: array<i32>;

fn is_off(change: f32, sheet: vec4f, step: vec2f, ends_first: bool) -> bool {
    let expected = sheet.x * step.x + sheet.y * step.y;
    return abs(change - expected) > select(max(2.0 * abs(sheet.z), SMALLEST_LEAP), SMALLEST_LEAP, ends_first);
}

// Whether both sides show one lumen that runs along the view between them.
fn is_fold(here: u32, there: u32, apart: f32) -> bool {
    let a = sheet[here];
    let b = sheet[there];
    let is_one = a.z > 0.0 && b.z > 0.0 && vessel[here] == vessel[there] && max(a.w, b.w) <= WALL_GAP;
    return is_one && apart <= MOST_DIAMETERS * 2.0 * min(a.z, b.z) && apart > ALONG_VIEW * abs(b.w - a.w);
}

// The line lies outside the lumen if only one side is lumen, otherwise on the farther side.
fn leap_bits(here: u32, there: u32, step: vec2f) -> u32 {
    let change = depth[there] - depth[here];
    let ends_first = (sheet[here].w == CHOSEN_GAP) != (sheet[there].w == CHOSEN_GAP);
    if !(is_off(change, sheet[here], step, ends_first) && is_off(change, sheet[there], step, ends_first)) {
        return 0u;
    }
    if is_fold(here, there, abs(change)) {
        return 0u;
    }
    let from_lumen = sheet[here].z > 0.0;
    let to_lumen = sheet[there].z > 0.0;
    let line_beyond = select(from_lumen, change > 0.0, from_lumen == to_lumen);
    return TO_THE_RIGHT | DOWNWARDS | select(0u, LINE_TO_THE_RIGHT | LINE_DOWNWARDS, line_beyond);
}

@compute @workgroup_size(16, 4)
fn leap(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let here = place_of(thread.xy);
    let side = parameters.pixel_spacing;
    var bits = select(select(0u, WALL, sheet[here].w < 0.0), LUMEN, sheet[here].z > 0.0);
    if thread.y + 1u < view.size.y {
        bits |= leap_bits(here, here + view.size.x, vec2f(0.0, -side)) & (DOWNWARDS | LINE_DOWNWARDS);
    }
    if thread.x + 1u < view.size.x {
        bits |= leap_bits(here, here + 1u, vec2f(side, 0.0)) & (TO_THE_RIGHT | LINE_TO_THE_RIGHT);
    }
    leap_image[here] = bits;
}
