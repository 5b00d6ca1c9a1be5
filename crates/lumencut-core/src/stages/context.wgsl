// The context: rays through the volume behind the cut surface (paper section 3.3.6).
// import math/trace

// One ray for each square of four pixels.
override PREVIEW: bool = false;
// No cut surface: every ray crosses the whole volume.
override ALONE: bool = false;

@group(0) @binding(5) var<storage, read> value: array<f32>;
@group(0) @binding(6) var<storage, read> depth: array<f32>;
@group(0) @binding(7) var<storage, read_write> context_image: array<vec4f>;

// Where the ray of a pixel starts: nowhere behind an opaque cut surface, behind a transparent one, and in front of the
// volume where the cut surface is outside.
fn start_of(pixel: vec2u) -> f32 {
    if ALONE {
        return WHOLE;
    }
    let p = place_of(pixel);
    if value[p] >= HUGE {
        return WHOLE;
    }
    return select(NONE, depth[p] + settings.behind, ramp_at(settings.opacity, value[p]) < 1.0);
}

fn ray_from(n: vec2f, start: f32) -> vec4f {
    if start >= NONE {
        return vec4f();
    }
    return trace(cut(foot_at(n), depth_at(start), settings.per_step));
}

// A square of four pixels: its ray starts nearest behind a cut surface, so that none of them shows what lies before its
// own; else in front of the volume, where one of them starts there.
fn square(first: vec2u) {
    // Later than behind every cut surface, sooner than nowhere.
    const IN_FRONT = NONE / 2.0;
    var start = NONE;
    for (var n = 0u; n < 4u; n++) {
        let pixel = first + vec2u(n % 2u, n / 2u);
        if in_view(pixel) {
            let own = start_of(pixel);
            start = min(start, select(own, IN_FRONT, own <= WHOLE));
        }
    }
    let found = ray_from(from_middle(first) + vec2f(0.5, -0.5), select(start, WHOLE, start == IN_FRONT));
    for (var n = 0u; n < 4u; n++) {
        let pixel = first + vec2u(n % 2u, n / 2u);
        if in_view(pixel) {
            context_image[place_of(pixel)] = select(found, vec4f(), start_of(pixel) >= NONE);
        }
    }
}

@compute @workgroup_size(8, 8)
fn context(@builtin(global_invocation_id) thread: vec3u) {
    if PREVIEW {
        square(2u * thread.xy);
        return;
    }
    if in_view(thread.xy) {
        context_image[place_of(thread.xy)] = ray_from(from_middle(thread.xy), start_of(thread.xy));
    }
}
