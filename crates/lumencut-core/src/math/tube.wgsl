// The inside of a vessel as tables that rays follow; tube.rs explains the numbers and the steps.

const AROUND = 256u;
const NEWTON: f32 = 1.02;
const SHORTEST: f32 = 0.02;
const LONGEST: f32 = 0.5;
const REFINED = 8u;
const EXACT: f32 = 1e-3;
const MAX_STEPS = 1000u;
// Least divisor.
const LEAST: f32 = 1e-9;

struct TubeRow {
    middle: vec4f,
    tangent: vec4f,
    across: vec4f,
}

// Has the layout of `WallParameters` in `reformations/endoscopy/wall.rs`.
struct WallParameters {
    // The eye (mm from the origin of the tube), and the distance of rows (mm).
    eye: vec4f,
    // The index of the origin of the tube, and the distance of samples beyond openings (mm).
    origin: vec4f,
    // Change of the index per mm along each axis.
    x: vec4f,
    y: vec4f,
    z: vec4f,
    size: vec2u,
    // The number of rows, and the row next to the eye.
    rows: u32,
    near: u32,
}

@group(0) @binding(1) var<uniform> tube: WallParameters;
@group(0) @binding(4) var<storage, read> tube_rows: array<TubeRow>;
@group(0) @binding(5) var<storage, read> radii: array<f32>;

struct TubePlace {
    row: u32,
    along: f32,
    offset: vec2f,
}

struct Inside {
    inside: f32,
    rise: f32,
    radius: f32,
    open: bool,
}

const NOTHING = 0u;
const WALL = 1u;
const OPENING = 2u;

struct Met {
    kind: u32,
    away: f32,
    row: u32,
}

fn turn_of(offset: vec2f) -> f32 {
    let share = offset.y / max(abs(offset.x) + abs(offset.y), LEAST);
    let turn = select(share, 2.0 - share, offset.x < 0.0);
    return select(turn, turn + 4.0, turn < 0.0);
}

fn find(place: vec3f, near: u32) -> TubePlace {
    let half = 0.5 * tube.eye.w;
    var row = near;
    var way = 0.0;
    loop {
        let at = tube_rows[row];
        let away = place - at.middle.xyz;
        let along = dot(away, at.tangent.xyz);
        let is_before = along < -half && row > 0u && way <= 0.0;
        let is_after = along > half && row + 1u < tube.rows && way >= 0.0;
        if !is_before && !is_after {
            break;
        }
        way = along;
        row = select(row + 1u, row - 1u, is_before);
    }
    let at = tube_rows[row];
    let away = place - at.middle.xyz;
    let ahead = cross(at.across.xyz, at.tangent.xyz);
    let offset = vec2f(dot(away, at.across.xyz), dot(away, ahead));
    return TubePlace(row, dot(away, at.tangent.xyz), offset);
}

fn is_beyond(place: TubePlace) -> bool {
    return (place.row == 0u && place.along < 0.0) || (place.row + 1u == tube.rows && place.along > 0.0);
}

fn inside_of(place: TubePlace, ray: vec3f) -> Inside {
    let at = tube_rows[place.row];
    let ahead = cross(at.across.xyz, at.tangent.xyz);
    let away = length(place.offset);
    let rise = dot(place.offset, vec2f(dot(ray, at.across.xyz), dot(ray, ahead))) / max(away, LEAST);
    let other = select(min(place.row + 1u, tube.rows - 1u), max(place.row, 1u) - 1u, place.along < 0.0);
    let share = min(abs(place.along) / tube.eye.w, 1.0);
    let turn = turn_of(place.offset) * (f32(AROUND) / 4.0);
    let column = floor(turn);
    let part = turn - column;
    let first = u32(column) % AROUND;
    let second = (u32(column) + 1u) % AROUND;
    let own = radii[place.row * AROUND + first];
    let own_next = radii[place.row * AROUND + second];
    let nearest = select(own, own_next, part >= 0.5);
    let here = abs(own) + (abs(own_next) - abs(own)) * part;
    let beside = abs(radii[other * AROUND + first]);
    let there = beside + (abs(radii[other * AROUND + second]) - beside) * part;
    let radius = here + (there - here) * share;
    return Inside(radius - away, rise, radius, nearest < 0.0);
}

// The first of `before` and `after` is a distance, the second the depth within the wall there.
fn crossed(ray: vec3f, before: vec2f, after: vec2f, end: TubePlace) -> Met {
    var low = before;
    var high = after;
    var away = after.x;
    var place = end;
    for (var n = 0u; n < REFINED; n++) {
        let share = low.y / max(low.y - high.y, LEAST);
        away = low.x + (high.x - low.x) * clamp(share, 0.02, 0.98);
        place = find(tube.eye.xyz + ray * away, place.row);
        let found = inside_of(place, ray).inside;
        if abs(found) < EXACT {
            break;
        }
        if found > 0.0 {
            low = vec2f(away, found);
        } else {
            high = vec2f(away, found);
        }
    }
    return Met(select(WALL, OPENING, inside_of(place, ray).open), away, place.row);
}

fn met(ray: vec3f, start: f32, end: f32) -> Met {
    var away = start;
    var before = vec2f(start, 0.0);
    var place = find(tube.eye.xyz + ray * away, tube.near);
    for (var n = 0u; n < MAX_STEPS; n++) {
        if is_beyond(place) {
            return Met(OPENING, away, place.row);
        }
        let here = inside_of(place, ray);
        if here.inside <= 0.0 {
            return crossed(ray, before, vec2f(away, here.inside), place);
        }
        if away >= end {
            break;
        }
        before = vec2f(away, here.inside);
        let straight = NEWTON * here.inside / max(here.rise, 1e-3);
        away = min(away + clamp(straight, SHORTEST * here.radius, LONGEST * here.radius), end);
        place = find(tube.eye.xyz + ray * away, place.row);
    }
    return Met(NOTHING, 0.0, 0u);
}
