// The cost that decides which piece of the cut surface a pixel sees (paper Eq. 2), and its *lumen first* variant.
// import math/levels

override LUMEN_FIRST: bool = false;

// The keys of a piece at depths `z` with lumen radii `r`, at distances `d` from its own centerline.
fn keys(z: vec4f, d: vec4f, r: vec4f) -> vec4f {
    let beyond = d - r;
    let cost = z + parameters.weight * max(beyond, vec4f(0.0));
    if LUMEN_FIRST {
        return select(cost, z - parameters.lift, beyond <= vec4f(parameters.margin));
    }
    return cost;
}

// A key that nothing at depth ≥ `z` with radius ≤ `r` falls below from a distance ≥ `d`.
fn key_bound(z: f32, d: f32, r: f32) -> f32 {
    let beyond = d - parameters.distance_slack - r;
    let nearest = z - parameters.depth_slack;
    let cost = nearest + parameters.weight * max(beyond, 0.0);
    if LUMEN_FIRST {
        return select(cost, nearest - parameters.lift, beyond <= parameters.margin);
    }
    return cost;
}

// The bound beyond which nothing can beat or tie with `key`.
fn key_limit(key: f32) -> f32 {
    return key + parameters.depth_slack + abs(key) * 4e-7;
}
