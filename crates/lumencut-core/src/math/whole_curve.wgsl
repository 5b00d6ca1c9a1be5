// Keys that count the distance to the entire projected vessel instead of the distance to a piece; see whole_curve.rs.
// import math/pieces
// import math/own_pieces

override WHOLE_CURVE: bool = false;

// The distance of each pixel from the projection of one vessel (mm).
var<private> curve_distance: array<vec4f, MAX_QUADS>;

fn end_of_level(level: u32) -> u32 {
    let next = parameters.levels[min(level + 1u, MAX_LEVELS)].first_slot;
    return select(arrayLength(&projected), next, next > parameters.levels[level].first_slot);
}

fn end_of_curve(first: u32, end_of_all: u32) -> u32 {
    var end = first;
    while end < end_of_all && projected[end].vessel == projected[first].vessel {
        end++;
    }
    return end;
}

fn measure_curve(first: u32, end: u32) {
    for (var q = 0u; q < ACROSS * ROWS; q++) {
        curve_distance[q] = vec4f(FAR);
    }
    for (var i = first; i < end; i++) {
        let here = projected[i];
        let is_stripe = here.inverse_length > 0.0;
        let next = projected[select(i, i + 1u, is_stripe)];
        let unit = here.edge * here.inverse_length;
        for (var a = 0u; a < ACROSS; a++) {
            for (var r = 0u; r < ROWS; r++) {
                let ux = quad_x[a] - here.point.x;
                let uy = row_y[r] - here.point.y;
                let after_start = ux * here.edge.x + uy * here.edge.y;
                let beyond_end = (quad_x[a] - next.point.x) * here.edge.x + (row_y[r] - next.point.y) * here.edge.y;
                let is_along = vec4<bool>(is_stripe) & (after_start >= vec4f(0.0)) & (beyond_end <= vec4f(0.0));
                let away = select(sqrt(ux * ux + uy * uy), abs(ux * unit.y - uy * unit.x), is_along);
                curve_distance[quad_of(a, r)] = min(curve_distance[quad_of(a, r)], away);
            }
        }
    }
}

fn offer_curve(first: u32, end: u32, first_of_level: u32) {
    for (var i = first; i < end; i++) {
        let here = projected[i];
        let is_stripe = here.inverse_length > 0.0;
        let next = projected[select(i, i + 1u, is_stripe)];
        let per_square = here.inverse_length * here.inverse_length;
        let piece = 2u * (i - first_of_level);
        for (var a = 0u; a < ACROSS; a++) {
            for (var r = 0u; r < ROWS; r++) {
                let q = quad_of(a, r);
                let ux = quad_x[a] - here.point.x;
                let uy = row_y[r] - here.point.y;
                let after_start = ux * here.edge.x + uy * here.edge.y;
                if here.stands != 0u {
                    let beyond_before = ux * here.before.x + uy * here.before.y;
                    let covered = (beyond_before >= vec4f(0.0)) & (after_start <= vec4f(0.0));
                    let z = vec4f(here.point.z);
                    offer(q, covered, keys(z, curve_distance[q], vec4f(here.radius), 0.0), z, piece);
                }
                if is_stripe {
                    let beyond_end = (quad_x[a] - next.point.x) * here.edge.x + (row_y[r] - next.point.y) * here.edge.y;
                    let t = min(after_start * per_square, vec4f(1.0));
                    let z = here.point.z + t * (next.point.z - here.point.z);
                    let radius = here.radius + t * (next.radius - here.radius);
                    let covered = (after_start >= vec4f(0.0)) & (beyond_end <= vec4f(0.0));
                    offer(q, covered, keys(z, curve_distance[q], radius, 0.0), z, piece + 1u);
                }
            }
        }
    }
}

fn lowest_keys_of_curves(level: u32) {
    let first_of_level = parameters.levels[level].first_slot;
    let end_of_all = end_of_level(level);
    var first = first_of_level;
    while first < end_of_all {
        let end = end_of_curve(first, end_of_all);
        measure_curve(first, end);
        offer_curve(first, end, first_of_level);
        first = end;
    }
}

// The distance of q from the vessel that slot i of a level belongs to.
fn distance_to_curve(level: u32, i: u32, q: vec2f) -> f32 {
    let vessel = projected[i].vessel;
    var nearest = FAR;
    for (var n = parameters.levels[level].first_slot; n < end_of_level(level); n++) {
        if projected[n].vessel == vessel {
            let here = projected[n];
            nearest = min(nearest, length(q - here.point.xy));
            if here.inverse_length > 0.0 {
                let at = foot(here, projected[n + 1u], q);
                nearest = select(nearest, min(nearest, at.distance), at.covered);
            }
        }
    }
    return nearest;
}
