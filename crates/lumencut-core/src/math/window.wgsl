// Ramps: the window that maps intensities to grey, and the one that maps them to opacity.

// Beyond all windows and control points; what is farther counts as this, so that products stay finite.
const FAR_INTENSITY: f32 = 1e20;

fn within(intensity: f32) -> f32 {
    return clamp(intensity, -FAR_INTENSITY, FAR_INTENSITY);
}

// The ramp at an intensity, 0 to 1: what the intensity is multiplied by, and what is added then.
fn ramp_at(ramp: vec2f, intensity: f32) -> f32 {
    return clamp(within(intensity) * ramp.x + ramp.y, 0.0, 1.0);
}
