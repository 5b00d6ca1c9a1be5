// Ramps that map intensities to grey or opacity.

// Intensities are clamped to this, beyond all windows and control points, so that products stay finite.
const FAR_INTENSITY: f32 = 1e20;

fn within(intensity: f32) -> f32 {
    return clamp(intensity, -FAR_INTENSITY, FAR_INTENSITY);
}

// The ramp (factor, summand) at an intensity, 0 to 1.
fn ramp_at(ramp: vec2f, intensity: f32) -> f32 {
    return clamp(within(intensity) * ramp.x + ramp.y, 0.0, 1.0);
}
