// Transfer functions: the colour and the opacity of intensities; see transfer.rs.
// import math/window
// import math/context_parameters

const INVISIBLE: f32 = 1e-6;

fn share_of(rise: u32, intensity: f32) -> f32 {
    return clamp((intensity - parameters.rises[rise].start) * parameters.rises[rise].per_intensity, 0.0, 1.0);
}

// The opacity of one millimetre.
fn opacity_of(intensity: f32) -> f32 {
    var opacity = parameters.first_opacity;
    for (var n = 0u; n < parameters.rise_count; n++) {
        opacity += parameters.rises[n].opacity * share_of(n, within(intensity));
    }
    return select(0.0, min(opacity, 1.0), opacity > INVISIBLE);
}

fn color_of(intensity: f32) -> vec3f {
    var color = parameters.first_color;
    for (var n = 0u; n < parameters.rise_count; n++) {
        color += parameters.rises[n].color * share_of(n, within(intensity));
    }
    return color;
}

fn is_transparent(range: vec2f) -> bool {
    for (var n = 0u; n < parameters.gap_count; n++) {
        if range.x >= parameters.gaps[n].x && range.y <= parameters.gaps[n].y {
            return true;
        }
    }
    return false;
}
