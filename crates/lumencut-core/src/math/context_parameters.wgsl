// The parameters of the context, made in the room of the same name in Rust.

// A rise of the transfer function: what is added to all before it.
struct RiseParameters {
    color: vec3f,
    opacity: f32,
    start: f32,
    per_intensity: f32,
    padding: vec2f,
}

struct ContextParameters {
    // The ramps of the intensities from 0 to 1, and of the cut surface's opacity.
    window: vec2f,
    opacity: vec2f,
    // Parts of a ray per mm, at least.
    per_step: f32,
    // How far behind a transparent cut surface rays start (mm).
    behind: f32,
    // How far a brighter sample pushes back what was gathered before it, and the share of the maximum.
    push: f32,
    mix: f32,
    // In the window, what is brighter than all that is transparent before the first visible sample.
    most: f32,
    // The black end of the window.
    black: f32,
    // The square of a change that is half shaded.
    noise: f32,
    // The intensity from which on the colour stays the same.
    last: f32,
    // The transfer function before its first rise.
    first_color: vec3f,
    first_opacity: f32,
    // How many rises, gaps and levels there are, and by how much the first level's blocks are larger than the smallest
    // there are: 2 to this power.
    rise_count: u32,
    gap_count: u32,
    level_count: u32,
    finest: u32,
    rises: array<RiseParameters, 63>,
    // The ranges of intensity without opacity: from x to y.
    gaps: array<vec4f, 33>,
    // Blocks along each axis and the place of the first one's range, the smallest blocks first.
    levels: array<vec4u, 16>,
}

@group(0) @binding(1) var<uniform> parameters: ContextParameters;
