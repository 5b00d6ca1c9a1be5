// The levels in one view, in three passes: projected points and edges, wedges, and boxes.
// import math/lanes
// import math/view
// import math/levels
// import math/pieces
// import math/hierarchy

// A point relative to the middle of the tree (mm). It is split into a part with so few digits that its
// products with the axes' coarse parts are exact, and the rest.
struct Point {
    coarse: vec3f,
    radius: f32,
    fine: vec3f,
    // Index in the list of all bundles at which the slot of this point is stored.
    place: u32,
}

const COLLINEAR_LENGTH: f32 = 1e-3;
const POINT_THREADS = 64u;
const SPAN_THREADS = 64u;
const LEVEL_THREADS = 256u;
const NOWHERE = 0xffffffffu;

struct Along {
    next: u32,
    arc_length: f32,
    vessel: i32,
}

@group(0) @binding(2) var<storage, read> alongs: array<Along>;
@group(0) @binding(2) var<storage, read> spans: array<Span>;
@group(0) @binding(3) var<storage, read> points: array<Point>;
@group(0) @binding(4) var<storage, read_write> projected: array<Projected>;
@group(0) @binding(5) var<storage, read_write> bundled: array<Slot>;

fn along(axis: u32, point: Point) -> f32 {
    let coarse = view.axes[axis].coarse.xyz;
    let fine = view.axes[axis].fine.xyz;
    // The sum is exact, in any order of its terms and with any rounding.
    let exact = dot(coarse, point.coarse) + parameters.origin_coarse[axis];
    return exact + (dot(fine, point.coarse) + dot(coarse + fine, point.fine) + parameters.origin_fine[axis]);
}

fn view_from_world(point: Point) -> vec3f {
    return vec3f(along(0u, point), along(1u, point), along(2u, point));
}

@compute @workgroup_size(POINT_THREADS)
fn projection(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let i = (group.y * groups.x + group.x) * POINT_THREADS + thread;
    if i >= arrayLength(&points) {
        return;
    }
    let here = view_from_world(points[i]);
    let next = alongs[i].next;
    let edge = view_from_world(points[next]).xy - here.xy;
    let square = dot(edge, edge);
    let is_edge = next != i && square >= COLLINEAR_LENGTH * COLLINEAR_LENGTH;
    let known = points[i].radius * parameters.radius_scale;
    var written: Projected;
    written.point = here;
    written.radius = select(parameters.unknown_radius, known, known > 0.0);
    written.edge = select(vec2f(0.0), edge, is_edge);
    written.inverse_length = select(0.0, 1.0 / sqrt(max(square, 1e-30)), is_edge);
    written.arc_length = alongs[i].arc_length;
    written.vessel = alongs[i].vessel;
    projected[i] = written;
}

var<workgroup> first_stripe: atomic<u32>;
var<workgroup> last_stripe: atomic<u32>;
var<workgroup> nearest_depth: atomic<u32>;
var<workgroup> nearest_point: atomic<u32>;

fn is_stripe(i: u32) -> bool {
    return any(projected[i].edge != vec2f(0.0));
}

fn ordered(number: f32) -> u32 {
    let bits = bitcast<u32>(number);
    return select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

fn survey(span: Span, thread: u32) {
    if thread == 0u {
        atomicStore(&first_stripe, NOWHERE);
        atomicStore(&last_stripe, 0u);
        atomicStore(&nearest_depth, NOWHERE);
        atomicStore(&nearest_point, NOWHERE);
    }
    workgroupBarrier();
    for (var i = span.first + thread; i < span.end; i += SPAN_THREADS) {
        if is_stripe(i) {
            atomicMin(&first_stripe, i);
            atomicMax(&last_stripe, i);
        }
        atomicMin(&nearest_depth, ordered(projected[i].point.z));
    }
    workgroupBarrier();
    for (var i = span.first + thread; i < span.end; i += SPAN_THREADS) {
        if ordered(projected[i].point.z) == atomicLoad(&nearest_depth) {
            atomicMin(&nearest_point, i);
        }
    }
    workgroupBarrier();
}

// The edge before the wedge at a point, and 1 if there is a wedge; projection.rs explains the cases.
fn stand(span: Span, i: u32) -> vec3f {
    let first = atomicLoad(&first_stripe);
    let last = atomicLoad(&last_stripe);
    let end = span.end - 1u;
    if first == NOWHERE {
        // The vessel projects to a point, so it has one plane at its smallest depth.
        return vec3f(0.0, 0.0, select(0.0, 1.0, i == atomicLoad(&nearest_point)));
    }
    if i == end {
        return vec3f(select(vec2f(0.0), projected[last].edge, last + 1u == end), 1.0);
    }
    if i == span.first {
        return vec3f(0.0, 0.0, 1.0);
    }
    if i <= first || i > last {
        return vec3f(0.0);
    }
    return vec3f(projected[i - 1u].edge, select(0.0, 1.0, is_stripe(i - 1u)));
}

fn place(span: Span, i: u32) {
    let here = projected[i];
    let stands = stand(span, i);
    projected[i].before = stands.xy;
    projected[i].stands = u32(stands.z);
    let stripe = is_stripe(i);
    let end = projected[select(i, i + 1u, stripe)];
    var slot: Slot;
    slot.start = here.point.xy;
    slot.next = end.point.xy;
    slot.edge = here.edge;
    slot.before = stands.xy;
    slot.inverse_length = here.inverse_length;
    slot.stripe_z = select(ABSENT, here.point.z, stripe);
    slot.stripe_dz = select(0.0, end.point.z - here.point.z, stripe);
    slot.wedge_z = select(ABSENT, here.point.z, stands.z > 0.0);
    slot.radius = here.radius;
    slot.radius_change = end.radius - here.radius;
    slot.slot = i - span.level;
    slot.tiers = select(0.0, 2.0, span.first_chosen <= i && i < span.end_chosen);
    bundled[points[i].place] = slot;
}

// One workgroup for each vessel at each level.
@compute @workgroup_size(SPAN_THREADS)
fn bundle(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let n = group.y * groups.x + group.x;
    if n >= arrayLength(&spans) {
        return;
    }
    let span = spans[n];
    survey(span, thread);
    for (var i = span.first + thread; i < span.end; i += SPAN_THREADS) {
        place(span, i);
    }
}


@group(0) @binding(3) var<storage, read_write> drawn: array<NodeBox>;

fn nothing() -> NodeBox {
    return NodeBox(vec2f(FAR), vec2f(-FAR), ABSENT, 0.0, 0.0, 0.0);
}

fn enclose_bundle(level: u32, n: u32) {
    let first = (parameters.levels[level].first_bundle + n) * FAN;
    var box = nothing();
    for (var s = first; s < first + FAN; s++) {
        let slot = slots[s];
        if slot.slot != NO_SLOT {
            box.low = min(box.low, min(slot.start, slot.next));
            box.high = max(box.high, max(slot.start, slot.next));
            box.z = min(box.z, min(min(slot.stripe_z, slot.stripe_z + slot.stripe_dz), slot.wedge_z));
            box.radius = max(box.radius, max(slot.radius, slot.radius + slot.radius_change));
            box.tiers = max(box.tiers, slot.tiers);
        }
    }
    drawn[first_box(level, 0u) + n] = box;
}

fn enclose_boxes(level: u32, height: u32, n: u32) {
    let first = first_box(level, height - 1u) + n * FAN;
    var box = nothing();
    for (var b = first; b < first + FAN; b++) {
        let inner = drawn[b];
        if inner.low.x < FAR {
            box.low = min(box.low, inner.low);
            box.high = max(box.high, inner.high);
            box.z = min(box.z, inner.z);
            box.radius = max(box.radius, inner.radius);
            box.tiers = max(box.tiers, inner.tiers);
        }
    }
    drawn[first_box(level, height) + n] = box;
}

// One workgroup per level computes the boxes, height by height.
@compute @workgroup_size(LEVEL_THREADS)
fn enclose(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let level = group.x;
    let heights = parameters.levels[level].height_count;
    var nodes = parameters.levels[level].bundle_count;
    for (var n = thread; n < nodes; n += LEVEL_THREADS) {
        enclose_bundle(level, n);
    }
    for (var height = 1u; height < heights; height++) {
        nodes = (nodes + FAN - 1u) / FAN;
        storageBarrier();
        for (var n = thread; n < nodes; n += LEVEL_THREADS) {
            enclose_boxes(level, height, n);
        }
    }
}
