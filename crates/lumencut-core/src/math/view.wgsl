// The view: its pixels in view space (mm).

struct ViewParameters {
    size: vec2u,
    // The side of a pixel (mm), split into a part of few digits, whose products with integers are exact, and
    // the rest.
    spacing: vec2f,
    // The axes of view space in world space, each split into a part of few digits and the rest.
    axes: array<Axis, 3>,
}

struct Axis {
    coarse: vec4f,
    fine: vec4f,
}

@group(0) @binding(0) var<uniform> view: ViewParameters;

fn view_x(i: u32) -> f32 {
    let n = f32(i) + 0.5 - 0.5 * f32(view.size.x);
    return n * view.spacing.x + n * view.spacing.y;
}

fn views_x(i: vec4u) -> vec4f {
    let n = vec4f(i) + 0.5 - 0.5 * f32(view.size.x);
    return n * view.spacing.x + n * view.spacing.y;
}

fn view_y(j: u32) -> f32 {
    let n = 0.5 * f32(view.size.y) - f32(j) - 0.5;
    return n * view.spacing.x + n * view.spacing.y;
}

fn in_view(pixel: vec2u) -> bool {
    return all(pixel < view.size);
}

fn place_of(pixel: vec2u) -> u32 {
    return pixel.y * view.size.x + pixel.x;
}
