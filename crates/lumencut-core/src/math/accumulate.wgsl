// Accumulates the samples of rays from near to far: colours and opacities.
// import math/lanes
// import math/light
// import math/thickness
// import math/transfer
// import math/window

override SHADED: bool = false;

const OPAQUE: f32 = 1.0 - 1.0 / 1024.0;

struct Gathered {
    color: vec3f,
    opacity: f32,
    most: f32,
    best: f32,
}

fn nothing() -> Gathered {
    return Gathered(vec3f(), 0.0, parameters.most, -HUGE);
}

fn ignores(gathered: Gathered, range: vec2f) -> bool {
    let is_no_brighter = min(range.y, parameters.last) <= gathered.best;
    return (parameters.push == 0.0 || ramp_at(parameters.window, range.y) <= gathered.most)
        && (parameters.mix == 0.0 || is_no_brighter)
        && (gathered.opacity >= OPAQUE || is_transparent(range));
}

fn gather(gathered: ptr<function, Gathered>, value: f32, place: GridPosition, thickness: f32) {
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

fn finished(gathered: Gathered) -> vec4f {
    let blended = vec4f(gathered.color, gathered.opacity);
    return blended + (brightest(gathered.best) - blended) * parameters.mix;
}

fn brightest(best: f32) -> vec4f {
    return select(vec4f(), vec4f(color_of(best), 1.0), best > -HUGE);
}

fn grey(shade: f32, is_found: bool) -> vec4f {
    return select(vec4f(), vec4f(vec3f(shade), 1.0), is_found);
}
