// Linear maps of intensity to [0, 1]: grey and opacity.

struct Ramp {
    scale: f32,
    offset: f32,
}

// The ramp at an intensity, in [0, 1].
fn ramp_at(ramp: Ramp, intensity: f32) -> f32 {
    return clamp(intensity * ramp.scale + ramp.offset, 0.0, 1.0);
}
