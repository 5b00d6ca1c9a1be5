// Shading by the gradient of the volume, with light from the viewer; light.rs explains the constants.
// import math/sampling
// import math/context_parameters

const AMBIENT: f32 = 0.4;
const DIFFUSE: f32 = 0.6;
const SPECULAR: f32 = 0.2;
const STEEPEST: f32 = 1e12;

struct Light {
    lit: f32,
    shine: f32,
}

const UNSHADED = Light(1.0, 0.0);

fn value_beside(place: GridPosition, by: vec3f) -> f32 {
    return value_in(cell_of(GridPosition(place.whole + by, place.part)));
}

fn shade(place: GridPosition) -> Light {
    var change: vec3f;
    for (var a = 0; a < 3; a++) {
        let side = vec3f(vec3i(a) == vec3i(0, 1, 2));
        let ends = vec2f(value_beside(place, side), value_beside(place, -side));
        if FLOAT_VOXELS && any(ends >= vec2f(HUGE)) {
            return UNSHADED;
        }
        change[a] = clamp(ends.x - ends.y, -STEEPEST, STEEPEST);
    }
    let z = dot(change, grid.z.xyz + grid.z_rest.xyz);
    let gradient = vec3f(dot(change, grid.right.xyz), dot(change, grid.up.xyz), z);
    let square = dot(gradient, gradient);
    if square <= 0.0 {
        return UNSHADED;
    }
    let cosine = abs(gradient.z) / sqrt(square);
    let contrast = dot(change, change);
    let surface = contrast / (contrast + parameters.noise);
    let fourth = cosine * cosine * cosine * cosine;
    let sixteenth = fourth * fourth * fourth * fourth;
    return Light(1.0 + surface * (AMBIENT + DIFFUSE * cosine - 1.0), surface * SPECULAR * sixteenth);
}
