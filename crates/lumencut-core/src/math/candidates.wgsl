// Finds which of the two pieces of a slot can be shown in a tile.
// import math/lanes
// import math/tile
// import math/cost
// import math/pieces

fn smallest_keys(tile: Tile, slot: Slot) -> vec2f {
    let u = tile.center - slot.start;
    let w = tile.center - slot.next;
    let edge = slot.edge;
    let sides = tile.half + 1e-5 * max(abs(u), abs(w));
    let start = dot(u, edge);
    let along = dot(sides, abs(edge));
    let in_stripe = start + along >= 0.0 && dot(w, edge) - along <= 0.0;
    let in_wedge = dot(u, slot.before) + dot(sides, abs(slot.before)) >= 0.0 && start - along <= 0.0;

    let inverse = slot.inverse_length;
    let z0 = slot.stripe_z;
    let change = inverse * inverse * slot.stripe_dz;
    let near = max(z0 + start * change - along * abs(change), min(z0, z0 + slot.stripe_dz));
    let across = (abs(u.x * edge.y - u.y * edge.x) - dot(sides, abs(edge.yx))) * inverse;
    let stripe = key_bound(near, across, max(slot.radius, slot.radius + slot.radius_change), slot.tiers);

    let away = max(across, length(max(abs(u) - tile.half, vec2f(0.0))));
    let wedge = key_bound(slot.wedge_z, away, slot.radius, slot.tiers);
    return select(vec2f(ABSENT), vec2f(stripe, wedge), vec2<bool>(in_stripe, in_wedge));
}
