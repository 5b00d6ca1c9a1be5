// The volume along a ray within one cell: a cubic in Bernstein form.
// import math/sampling

const TINY: f32 = 1e-30;

fn largest_corner(corners: Corners) -> f32 {
    let four = max(corners.near, corners.far);
    return max(max(four.x, four.y), max(four.z, four.w));
}

fn cubic_between(corners: Corners, enter: vec3f, leave: vec3f) -> vec4f {
    let step = corners.far - corners.near;
    let e = corners.near + step * enter.x;
    let l = corners.near + step * leave.x;
    let ee = e.xz + (e.yw - e.xz) * enter.y;
    let el = e.xz + (e.yw - e.xz) * leave.y;
    let le = l.xz + (l.yw - l.xz) * enter.y;
    let ll = l.xz + (l.yw - l.xz) * leave.y;
    let at_enter = vec4f(ee.x, el.x, le.x, ll.x) + (vec4f(ee.y, el.y, le.y, ll.y) - vec4f(ee.x, el.x, le.x, ll.x)) * enter.z;
    let at_leave = vec4f(ee.x, el.x, le.x, ll.x) + (vec4f(ee.y, el.y, le.y, ll.y) - vec4f(ee.x, el.x, le.x, ll.x)) * leave.z;
    let third = 1.0 / 3.0;
    return vec4f(
        at_enter.x,
        (at_enter.z + at_enter.y + at_leave.x) * third,
        (at_enter.w + at_leave.z + at_leave.y) * third,
        at_leave.w,
    );
}

fn largest_of(cubic: vec4f) -> f32 {
    let ends = max(cubic.x, cubic.w);
    if max(cubic.y, cubic.z) <= ends {
        return ends;
    }
    return max(ends, value_at(cubic, summit(cubic)));
}

fn summit(cubic: vec4f) -> f32 {
    let d = cubic.yzw - cubic.xyz;
    let size = abs(d);
    let s = d / max(max(size.x, max(size.y, size.z)), TINY);
    let curve = s.x - 2.0 * s.y + s.z;
    let bend = s.y - s.x;
    let root = sqrt(max(s.y * s.y - s.x * s.z, 0.0));
    let above = select(s.x, -(bend + root), bend > 0.0);
    let below = select(root - bend, curve, bend > 0.0);
    if abs(below) <= TINY {
        return 0.0;
    }
    return clamp(above / below, 0.0, 1.0);
}

fn value_at(cubic: vec4f, u: f32) -> f32 {
    let three = cubic.xyz + (cubic.yzw - cubic.xyz) * u;
    let two = three.xy + (three.yz - three.xy) * u;
    return two.x + (two.y - two.x) * u;
}

fn mean_of(cubic: vec4f) -> f32 {
    return ((cubic.x + cubic.w) + (cubic.y + cubic.z)) * 0.25;
}
