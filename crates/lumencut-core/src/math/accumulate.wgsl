// What rays make of their samples, for each kind of context.
// import math/lanes
// import math/light
// import math/thickness
// import math/transfer
// import math/window

const BLEND = 0u;
const BRIGHTEST = 1u;
const DARKEST = 2u;
const AVERAGE = 3u;

override MODE: u32 = 0u;
override SHADED: bool = false;

// The opacity from which on nothing behind is seen, unless it is brighter than all before.
const OPAQUE: f32 = 1.0 - 1.0 / 1024.0;

struct Gathered {
    color: vec3f,
    opacity: f32,
    // The largest sample so far in the window, 0 to 1.
    most: f32,
    // The largest or the smallest sample so far.
    best: f32,
    // The number of samples, and their sum in four: of single samples, and of 16, 256 and 4096.
    count: u32,
    sums: vec4f,
}

fn nothing() -> Gathered {
    let best = select(-HUGE, HUGE, MODE == DARKEST);
    return Gathered(vec3f(), 0.0, parameters.most, best, 0u, vec4f());
}

// Whether samples with values in a range would change nothing.
fn ignores(gathered: Gathered, range: vec2f) -> bool {
    // Beyond the last control point the colour stays the same.
    let is_no_brighter = min(range.y, parameters.last) <= gathered.best;
    switch MODE {
        case BRIGHTEST: { return is_no_brighter; }
        // Below the black end of the window everything is black.
        case DARKEST: { return max(range.x, parameters.black) >= gathered.best; }
        case AVERAGE: { return false; }
        default: {
            return (parameters.push == 0.0 || ramp_at(parameters.window, range.y) <= gathered.most)
                && (parameters.mix == 0.0 || is_no_brighter)
                && (gathered.opacity >= OPAQUE || is_transparent(range));
        }
    }
}

// Takes the next sample.
fn gather(gathered: ptr<function, Gathered>, value: f32, place: Place, thickness: f32) {
    switch MODE {
        case BRIGHTEST: { (*gathered).best = max((*gathered).best, min(value, parameters.last)); }
        case DARKEST: { (*gathered).best = min((*gathered).best, max(value, parameters.black)); }
        case AVERAGE: { average(gathered, value); }
        default: { blend(gathered, value, place, thickness); }
    }
}

// Sums of few numbers keep their digits: once there are sixteen, they are one of the next sum.
fn average(gathered: ptr<function, Gathered>, value: f32) {
    let count = (*gathered).count + 1u;
    var sums = (*gathered).sums + vec4f(value, 0.0, 0.0, 0.0);
    if count % 16u == 0u {
        sums = vec4f(0.0, sums.y + sums.x, sums.zw);
    }
    if count % 256u == 0u {
        sums = vec4f(0.0, 0.0, sums.z + sums.y, sums.w);
    }
    if count % 4096u == 0u {
        sums = vec4f(0.0, 0.0, 0.0, sums.w + sums.z);
    }
    (*gathered).count = count;
    (*gathered).sums = sums;
}

// DVR, MIDA and what lies between them and MIP.
fn blend(gathered: ptr<function, Gathered>, value: f32, place: Place, thickness: f32) {
    let intensity = ramp_at(parameters.window, value);
    let push = max(intensity - (*gathered).most, 0.0) * parameters.push;
    let is_seen = push > 0.0 || (*gathered).opacity < OPAQUE;
    (*gathered).most = max((*gathered).most, intensity);
    (*gathered).best = max((*gathered).best, min(value, parameters.last));
    (*gathered).color *= 1.0 - push;
    (*gathered).opacity *= 1.0 - push;
    let own = opacity_of(value);
    if !is_seen || own == 0.0 {
        return;
    }
    var light = UNSHADED;
    if SHADED {
        light = shade(place);
    }
    let color = min(color_of(value) * light.lit + light.shine, vec3f(1.0));
    let share = (1.0 - (*gathered).opacity) * of_thickness(own, thickness);
    (*gathered).color += share * color;
    (*gathered).opacity += share;
}

// The pixel: its colour times its opacity, and its opacity.
fn finished(gathered: Gathered) -> vec4f {
    switch MODE {
        case BRIGHTEST: { return brightest(gathered); }
        case DARKEST: {
            return grey(ramp_at(parameters.window, gathered.best), gathered.best < HUGE);
        }
        case AVERAGE: {
            let sum = gathered.sums.x + gathered.sums.y + gathered.sums.z + gathered.sums.w;
            let mean = sum / f32(max(gathered.count, 1u));
            return grey(ramp_at(parameters.window, mean), gathered.count > 0u);
        }
        default: {
            let blended = vec4f(gathered.color, gathered.opacity);
            return blended + (brightest(gathered) - blended) * parameters.mix;
        }
    }
}

fn brightest(gathered: Gathered) -> vec4f {
    return select(vec4f(), vec4f(color_of(gathered.best), 1.0), gathered.best > -HUGE);
}

fn grey(shade: f32, is_found: bool) -> vec4f {
    return select(vec4f(), vec4f(vec3f(shade), 1.0), is_found);
}
