// The cost that decides which piece of the cut surface a pixel shows (paper Eq. 2); see cost.rs.
// import math/levels

override LUMEN_FIRST: bool = false;

fn keys(z: vec4f, d: vec4f, r: vec4f, tiers: f32) -> vec4f {
    let beyond = d - r;
    let cost = z + parameters.weight * max(beyond, vec4f(0.0));
    if LUMEN_FIRST {
        let lifted = z - parameters.lift * (tiers + select(vec4f(1.0), vec4f(2.0), beyond <= vec4f(0.0)));
        return select(cost, lifted, beyond <= vec4f(parameters.margin));
    }
    return cost;
}

fn beyond_wall(key: f32, d: f32, r: f32) -> f32 {
    if LUMEN_FIRST && key < -0.5 * parameters.lift {
        return 0.0;
    }
    return max(d - r - parameters.margin, 0.0);
}

fn is_lumen(key: f32, d: f32, r: f32) -> bool {
    let is_outside_lumen = key >= -1.5 * parameters.lift || (is_first(key) && key >= -3.5 * parameters.lift);
    return select(d - r <= 0.0, !is_outside_lumen, LUMEN_FIRST);
}

fn is_first(key: f32) -> bool {
    return LUMEN_FIRST && key < -2.5 * parameters.lift;
}

fn key_bound(z: f32, d: f32, r: f32, tiers: f32) -> f32 {
    let beyond = d - parameters.distance_slack - r;
    let nearest = z - parameters.depth_slack;
    let cost = nearest + parameters.weight * max(beyond, 0.0);
    if LUMEN_FIRST {
        let lifted = nearest - parameters.lift * (tiers + select(1.0, 2.0, beyond <= 0.0));
        return select(cost, lifted, beyond <= parameters.margin);
    }
    return cost;
}

fn key_limit(key: f32) -> f32 {
    return key + parameters.depth_slack + abs(key) * 4e-7;
}
