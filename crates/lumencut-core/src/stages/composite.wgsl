// The picture: in front the cut surface with its silhouettes, behind it the context, then the background.
// import math/lanes
// import math/view
// import math/window

// The bindings of missing layers are empty.
override HAS_STRENGTH = true;
override HAS_FOCUS = false;
override HAS_RIM = false;
override HAS_CONTEXT = true;
override ALONE = false;

const RIM_FADES: vec2f = vec2f(0.80, 0.92);

// The colours of one picture, 0 to 1; composite.rs explains the fields.
struct CompositeParameters {
    background: vec4f,
    line: vec3f,
    context: f32,
    grey: vec2f,
    opacity: vec2f,
}

@group(0) @binding(1) var<storage, read> context: array<vec4f>;
// RGBA with straight alpha, a byte each, red lowest.
@group(0) @binding(2) var<storage, read_write> image: array<u32>;
@group(0) @binding(3) var<storage, read> parameters: CompositeParameters;
@group(0) @binding(4) var<storage, read> value: array<f32>;
@group(0) @binding(5) var<storage, read> strength: array<f32>;
@group(0) @binding(6) var<storage, read> focus: array<vec4f>;
// Colour and share, a byte each, red lowest.
@group(0) @binding(7) var<storage, read> rim: array<u32>;

// The nearest integer to a value of at most a little over 255; ties go to the even one.
fn byte(value: f32) -> u32 {
    return u32(round(min(value, 255.0)));
}

fn straight(pixel: vec4f, behind: vec3f) -> u32 {
    let any = pixel.w > 0.0;
    let per_alpha = 255.0 / select(1.0, pixel.w, any);
    let color = select(behind * 255.0, pixel.xyz * per_alpha, any);
    return byte(color.x) | (byte(color.y) << 8u) | (byte(color.z) << 16u) | (byte(pixel.w * 255.0) << 24u);
}

fn rimmed(grey: f32, rim: vec4f) -> vec3f {
    let x = clamp((grey - RIM_FADES.x) / (RIM_FADES.y - RIM_FADES.x), 0.0, 1.0);
    let share = rim.w * (1.0 - x * x * (3.0 - 2.0 * x));
    return grey + (rim.xyz - grey) * share;
}

@compute @workgroup_size(16, 4)
fn composite(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    let place = place_of(thread.xy);
    var shares = vec4f(1.0, 1.0, 1.0, 0.0);
    if HAS_FOCUS {
        shares = focus[place];
    }
    var behind = vec4f(0.0);
    if HAS_CONTEXT {
        behind = context[place] * vec4f(vec3f(parameters.context * shares.z), 1.0);
    }
    let rest = (1.0 - behind.w) * parameters.background.w;
    let back = vec4f(behind.xyz + parameters.background.xyz * rest, behind.w + rest);
    var pixel = back;
    // If there is no value, the surface is not shown.
    if !ALONE && value[place] < HUGE {
        let grey = ramp_at(parameters.grey, value[place]) * (1.0 - shares.w);
        let opacity = ramp_at(parameters.opacity, value[place]) * shares.x;
        var color = vec3f(grey);
        if HAS_RIM {
            color = rimmed(grey, unpack4x8unorm(rim[place]));
        }
        if HAS_STRENGTH {
            color += (parameters.line - color) * (strength[place] * (shares.x * shares.y));
        }
        pixel = vec4f(color, 1.0) * opacity + back * (1.0 - opacity);
    }
    image[place] = straight(pixel, parameters.background.xyz);
}

@compute @workgroup_size(16, 4)
fn layer(@builtin(global_invocation_id) thread: vec3u) {
    if !in_view(thread.xy) {
        return;
    }
    image[place_of(thread.xy)] = straight(context[place_of(thread.xy)], vec3f(0.0));
}
