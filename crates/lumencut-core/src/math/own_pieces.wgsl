// The piece of the winner's vessel at a coarser level that is nearest to the winner (the piece shown at the
// finest level) in arc length. Each pixel searches on its own.
// import math/lanes
// import math/levels
// import math/cost

@group(0) @binding(8) var<storage, read> projected: array<Projected>;
@group(0) @binding(9) var<storage, read> spans: array<Span>;

// The decision for a pixel, made once, on the finest level; decision.rs explains the fields.
struct Decision {
    vessel: i32,
    arc_length: f32,
    beyond_wall: f32,
    // The lumen radius as a sheet stores it: negative outside the lumen.
    sheet_radius: f32,
    slope: vec2f,
    is_first: bool,
}

struct Foot {
    covered: bool,
    t: f32,
    distance: f32,
}

fn foot(here: Projected, next: Projected, q: vec2f) -> Foot {
    let u = q - here.point.xy;
    let w = q - next.point.xy;
    let unit = here.edge * here.inverse_length;
    let after_start = u.x * here.edge.x + u.y * here.edge.y;
    let beyond_end = w.x * here.edge.x + w.y * here.edge.y;
    let t = min(after_start * (here.inverse_length * here.inverse_length), 1.0);
    return Foot(after_start >= 0.0 && beyond_end <= 0.0, t, abs(u.x * unit.y - u.y * unit.x));
}

fn slope_of(here: Projected, next: Projected) -> vec2f {
    return here.edge * (here.inverse_length * here.inverse_length * (next.point.z - here.point.z));
}

fn decide(level: u32, key: f32, piece: u32, vessel: i32, q: vec2f) -> Decision {
    let i = parameters.levels[level].first_slot + piece / 2u;
    let here = projected[i];
    let is_stripe = piece % 2u == 1u;
    let next = projected[select(i, i + 1u, is_stripe)];
    let at = foot(here, next, q);
    let t = select(0.0, at.t, is_stripe);
    let distance = select(length(q - here.point.xy), at.distance, is_stripe);
    let radius = here.radius + t * (next.radius - here.radius);
    let s = here.arc_length + t * (next.arc_length - here.arc_length);
    let sheet_radius = select(-radius, radius, is_lumen(key, distance, radius));
    let beyond = beyond_wall(key, distance, radius);
    return Decision(vessel, s, beyond, sheet_radius, slope_of(here, next), is_first(key));
}

// Depth, distance and radius of a piece at q (mm).
fn piece_at(piece: u32, q: vec2f) -> vec3f {
    let here = projected[piece / 2u];
    if piece % 2u == 0u {
        return vec3f(here.point.z, length(q - here.point.xy), here.radius);
    }
    let next = projected[piece / 2u + 1u];
    let at = foot(here, next, q);
    let z = here.point.z + at.t * (next.point.z - here.point.z);
    return vec3f(z, at.distance, here.radius + at.t * (next.radius - here.radius));
}

// Kind in pieces.rs: 0 stripe, 1 wedge, 2 half-plane, 3 full plane.
fn kind_of(piece: u32) -> f32 {
    let here = projected[piece / 2u];
    let missing = select(0.0, 1.0, all(here.before == vec2f(0.0))) + select(0.0, 1.0, all(here.edge == vec2f(0.0)));
    return select(1.0 + missing, 0.0, piece % 2u == 1u);
}

// The nearest piece so far; own_pieces.rs explains the fields.
struct NearestPiece {
    along: f32,
    apart: f32,
    cost: f32,
    piece: u32,
    z: f32,
    slope: vec2f,
}

fn cost_of(z: f32, d: f32, r: f32) -> f32 {
    return z + parameters.weight * max(d - r, 0.0);
}

fn nearer_of(a: NearestPiece, b: NearestPiece) -> NearestPiece {
    let is_first = b.cost < a.cost || (b.cost == a.cost && b.piece < a.piece);
    if b.apart < a.apart || (b.apart == a.apart && is_first) {
        return b;
    }
    return a;
}

fn with_pieces_of(i: u32, q: vec2f, s: f32, so_far: NearestPiece) -> NearestPiece {
    var nearest = so_far;
    let here = projected[i];
    if here.inverse_length > 0.0 {
        let next = projected[i + 1u];
        let at = foot(here, next, q);
        if at.covered {
            let z = here.point.z + at.t * (next.point.z - here.point.z);
            let cost = cost_of(z, at.distance, here.radius + at.t * (next.radius - here.radius));
            let along = here.arc_length + at.t * (next.arc_length - here.arc_length) - s;
            let offered = NearestPiece(along, abs(along), cost, 2u * i + 1u, z, slope_of(here, next));
            nearest = nearer_of(nearest, offered);
        }
    }
    // Computed as in `foot`, so that the pieces on both sides of a border get the same number.
    let u = q - here.point.xy;
    let beyond_before = u.x * here.before.x + u.y * here.before.y;
    let after_start = u.x * here.edge.x + u.y * here.edge.y;
    if here.stands != 0u && beyond_before >= 0.0 && after_start <= 0.0 {
        let cost = cost_of(here.point.z, length(u), here.radius);
        let along = here.arc_length - s;
        nearest = nearer_of(nearest, NearestPiece(along, abs(along), cost, 2u * i, here.point.z, vec2f(0.0)));
    }
    return nearest;
}

fn point_at(span: Span, s: f32) -> u32 {
    var low = span.first;
    var high = span.end;
    while low + 1u < high {
        let middle = (low + high) / 2u;
        if projected[middle].arc_length <= s {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

fn nearest_piece(level: u32, decision: Decision, q: vec2f) -> NearestPiece {
    let span = spans[level * parameters.vessel_count + u32(decision.vessel)];
    let s = decision.arc_length;
    let slack = 1e-6 * abs(s);
    var nearest = NearestPiece(0.0, UNSET, 0.0, NO_SLOT, 0.0, vec2f(0.0));
    var right = point_at(span, s);
    var left = right;
    loop {
        let is_right = right < span.end && projected[right].arc_length - s <= nearest.apart + slack;
        if is_right {
            nearest = with_pieces_of(right, q, s, nearest);
            right++;
        }
        let is_left = left > span.first && s - projected[left].arc_length <= nearest.apart + slack;
        if is_left {
            left--;
            nearest = with_pieces_of(left, q, s, nearest);
        }
        if !(is_left || is_right) {
            return nearest;
        }
    }
    return nearest;
}
