// Ramps: the window that maps intensities to grey, and the one that maps them to opacity.

// The ramp at an intensity, 0 to 1: what the intensity is multiplied by, and what is added then.
fn ramp_at(ramp: vec2f, intensity: f32) -> f32 {
    return clamp(intensity * ramp.x + ramp.y, 0.0, 1.0);
}
