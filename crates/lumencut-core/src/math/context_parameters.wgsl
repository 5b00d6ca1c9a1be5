// The parameters of the context; the Rust struct of the same name explains the fields.

struct RiseParameters {
    color: vec3f,
    opacity: f32,
    start: f32,
    per_intensity: f32,
    padding: vec2f,
}

struct ContextParameters {
    window: vec2f,
    opacity: vec2f,
    per_step: f32,
    behind: f32,
    push: f32,
    mix: f32,
    most: f32,
    black: f32,
    noise: f32,
    last: f32,
    first_color: vec3f,
    first_opacity: f32,
    rise_count: u32,
    gap_count: u32,
    level_count: u32,
    finest: u32,
    rises: array<RiseParameters, 63>,
    gaps: array<vec4f, 33>,
    levels: array<vec4u, 16>,
}

@group(0) @binding(1) var<uniform> parameters: ContextParameters;
