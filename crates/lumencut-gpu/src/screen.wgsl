// Draws a picture on a canvas: one triangle covers the canvas, and every pixel is read from the picture.

struct ScreenParameters {
    size: vec2u,
}

@group(0) @binding(0) var<uniform> parameters: ScreenParameters;
// RGBA with straight alpha, a byte each, red lowest.
@group(0) @binding(1) var<storage, read> image: array<u32>;

@vertex
fn corner(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    let place = vec2f(f32((vertex << 1u) & 2u), f32(vertex & 2u));
    return vec4f(2.0 * place - 1.0, 0.0, 1.0);
}

@fragment
fn pixel(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let place = min(vec2u(position.xy), parameters.size - 1u);
    let color = unpack4x8unorm(image[place.y * parameters.size.x + place.x]);
    return vec4f(color.xyz * color.w, color.w);
}
