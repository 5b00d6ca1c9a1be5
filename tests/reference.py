"""The method once more: slow, in numpy with 64-bit floats, written from its description alone.

The package must agree with it except where two pieces cost the same or a pixel lies on the border of a piece,
both within rounding: there `Surface.unsure_depth` and `Surface.unsure_vessel` say so.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: Segments shorter than this in projection are collinear with the view (mm).
COLLINEAR = 1e-3
#: Costs closer than this may tie in 32-bit floats (mm of depth).
TIE = 1e-3
#: Pixels nearer than this to the border of a piece, or to where the lumen ends, may fall on either side (mm).
BORDER = 1e-4
#: How far rounding moves a projected point (mm), for scenes of some 100 mm.
ROUNDING = 1e-5
#: More than the depth of any scene (mm).
LIFT = 1e7


def view_from_world(points, camera):
    """View coordinates (n, 3): x right, y up, z = depth."""
    direction = camera.direction / np.linalg.norm(camera.direction)
    right = np.cross(direction, camera.up)
    right /= np.linalg.norm(right)
    up = np.cross(right, direction)
    return (points - camera.center) @ np.stack([right, up, direction], axis=1)


def pixel_centers(camera):
    """View x and y of all pixels, row by row, shape (H · W, 2)."""
    width, height = camera.size
    x = (np.arange(width) + 0.5 - width / 2) * camera.pixel_spacing
    y = (height / 2 - np.arange(height) - 0.5) * camera.pixel_spacing
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def basis(count, parameters):
    """Values of the clamped cubic B-splines with uniform knots, shape (parameters, count): Cox-de Boor."""
    spans = count - 3
    knots = np.concatenate([np.zeros(3), np.arange(spans + 1.0), np.full(3, float(spans))])
    u = np.asarray(parameters)[:, None]
    last = np.flatnonzero(knots[:-1] < knots[1:])[-1]
    degree_0 = (u >= knots[:-1]) & (u < knots[1:])
    degree_0[:, last] |= u[:, 0] == spans
    value = degree_0.astype(float)
    for degree in (1, 2, 3):
        span = knots[degree:] - knots[:-degree]
        rising = np.divide(u - knots[:-degree], span, out=np.zeros((len(u), len(span))), where=span > 0)
        value = rising[:, :-1] * value[:, :-1] + (1 - rising[:, 1:]) * value[:, 1:] * (span[1:] > 0)
    return value


def coarser(points, radius):
    """The next level of detail of one vessel."""
    controls = np.column_stack([points, radius])
    count = max(-(-len(points) // 2), 2)
    if len(points) < 4:
        samples = np.linspace(controls[0], controls[-1], count)
    else:
        samples = basis(len(points), np.linspace(0, len(points) - 3, count)) @ controls
    samples[0], samples[-1] = controls[0], controls[-1]
    return samples[:, :3], samples[:, 3]


def levels_of(tree, count):
    """Level 0 to `count`, each a list of (points, radius); unknown radii are 0."""
    levels = [[(v.points, np.zeros(len(v.points)) if v.radius is None else v.radius) for v in tree]]
    for _ in range(count):
        levels.append([coarser(*vessel) for vessel in levels[-1]])
    return levels


def distinct(points):
    """The points that do not repeat the one before them: a segment without length is not along the view."""
    kept = [0]
    for i in range(1, len(points)):
        if np.linalg.norm(points[i] - points[kept[-1]]) >= COLLINEAR:
            kept.append(i)
    return kept


@dataclass
class Pieces:
    """The stripes, and the pieces at points, of one projected vessel; an edge that is not there is zero."""

    start: np.ndarray
    edge: np.ndarray
    stripe: np.ndarray  # z, r at the start, z, r at the end
    point: np.ndarray
    before: np.ndarray
    after: np.ndarray
    at_point: np.ndarray  # z, r


def pieces_of(view, radius):
    """The local surface of a polyline in view space."""
    p, z, nothing = view[:, :2], view[:, 2], np.zeros(2)
    zr = np.column_stack([z, radius])
    edges = np.diff(p, axis=0)
    solid = np.flatnonzero(np.linalg.norm(edges, axis=1) >= COLLINEAR)
    if len(solid) == 0:
        nearest = np.argmin(z)
        fans = [(p[nearest], nothing, nothing, zr[nearest])]
    else:
        first, last, end = solid[0], solid[-1], len(p) - 1
        # A half-plane before the first segment, or a plane where a run starts the vessel; so at the end.
        fans = [(p[0], nothing, edges[0] if first == 0 else nothing, zr[0])]
        for i in solid[solid != last]:
            # A wedge, or a half-plane directed forward where a run follows.
            after = edges[i + 1] if i + 1 in solid else nothing
            fans.append((p[i + 1], edges[i], after, zr[i + 1]))
        fans.append((p[end], edges[last] if last + 1 == end else nothing, nothing, zr[end]))
    point, before, after, at_point = (np.array(column) for column in zip(*fans, strict=True))
    stripe = np.column_stack([zr[solid], zr[solid + 1]])
    return Pieces(p[solid], edges[solid], stripe, point, before, after, at_point)


def beyond(offset, edge):
    """How far (mm) offsets (P, S, 2) lie along edges (S, 2); infinitely where the edge is not there."""
    length = np.linalg.norm(edge, axis=-1)
    along = (offset * edge).sum(axis=-1)
    return np.divide(along, length, out=np.full(along.shape, np.inf), where=length > 0)


def candidates(pieces, q):
    """Depth, radius, local distance, how far inside (mm, ≥ 0 where covered), error of depth, each (P, S).

    The error is what the slope of a stripe makes of ends that rounding has moved: much where it is short and
    steep, as it turns about its ends.
    """
    offset = q[:, None] - pieces.start
    length = np.linalg.norm(pieces.edge, axis=1)
    along = beyond(offset, pieces.edge)
    t = along / length
    z0, r0, z1, r1 = pieces.stripe.T
    d = np.linalg.norm(offset - t[..., None] * pieces.edge, axis=-1)
    error = ROUNDING * (1 + d / length) * np.abs(z1 - z0) / length
    stripes = (z0 + t * (z1 - z0), r0 + t * (r1 - r0), d, np.minimum(along, length - along), error)
    offset = q[:, None] - pieces.point
    inside = np.minimum(beyond(offset, pieces.before), beyond(-offset, pieces.after))
    z, r = (np.broadcast_to(column, inside.shape) for column in pieces.at_point.T)
    fans = (z, r, np.linalg.norm(offset, axis=-1), inside, np.zeros(inside.shape))
    return tuple(np.concatenate(pair, axis=1) for pair in zip(stripes, fans, strict=True))


def key(z, r, d, settings, slack=0.0):
    """What orders the pieces: the cost, or less than any cost for lumen under `lumen_first`."""
    cost = z + settings.cost_weight * np.maximum(d - r, 0)
    if settings.lumen_first:
        return np.where(d - r <= settings.lumen_margin + slack, z - LIFT, cost)
    return cost


@dataclass
class Level:
    """The winners of one level at some pixels, and between what they may vary within rounding."""

    z: np.ndarray
    vessel: np.ndarray
    slack: np.ndarray
    z_range: np.ndarray
    other_vessel: np.ndarray


def winners(vessels, q, settings):
    """The piece with the smallest cost at each pixel; on a tie the smaller vessel id."""
    count = len(q)
    best, sure = np.full(count, np.inf), np.full(count, np.inf)
    z_best, id_best, slack = np.zeros(count), np.zeros(count, int), np.zeros(count)
    for vessel, pieces in enumerate(vessels):
        z, r, d, inside, error = candidates(pieces, q)
        cost = np.where(inside >= 0, key(z, r, d, settings), np.inf)
        mine = np.arange(count), cost.argmin(axis=1)
        wins = cost[mine] < best
        best, z_best = np.where(wins, cost[mine], best), np.where(wins, z[mine], z_best)
        id_best, slack = np.where(wins, vessel, id_best), np.where(wins, error[mine], slack)
        certain = np.where(inside >= BORDER, key(z, r, d, settings, -BORDER), np.inf)
        sure = np.minimum(sure, certain.min(axis=1))
    low, high, others = np.full(count, np.inf), np.full(count, -np.inf), np.zeros(count, bool)
    for vessel, pieces in enumerate(vessels):
        z, r, d, inside, _ = candidates(pieces, q)
        rival = (inside >= -BORDER) & (key(z, r, d, settings, BORDER) <= sure[:, None] + TIE)
        low = np.minimum(low, np.where(rival, z, np.inf).min(axis=1))
        high = np.maximum(high, np.where(rival, z, -np.inf).max(axis=1))
        others |= rival.any(axis=1) & (id_best != vessel)
    return Level(z_best, id_best, slack, high - low, others)


def distance_to(vessels, q):
    """The smallest projected distance to any segment of any vessel (points, radius) in view space."""
    nearest = np.full(len(q), np.inf)
    for view in vessels:
        start, edge = view[:-1, :2], np.diff(view[:, :2], axis=0)
        square = (edge**2).sum(axis=1)
        offset = q[:, None] - start
        t = np.divide((offset * edge).sum(axis=-1), square, out=np.zeros(offset.shape[:2]), where=square > 0)
        foot = np.clip(t, 0, 1)[..., None] * edge
        nearest = np.minimum(nearest, np.linalg.norm(offset - foot, axis=-1).min(axis=1))
    return nearest


@dataclass
class Surface:
    """Images of shape (H, W), before the depth filter."""

    depth: np.ndarray
    vessel: np.ndarray
    distance: np.ndarray
    slack: np.ndarray  # what rounding may add to the error of the depth (mm)
    unsure_depth: np.ndarray
    unsure_vessel: np.ndarray


def cut_surface(tree, camera, settings, depth_tolerance=1e-3):
    """The cut surface, and where it may differ within rounding by more than `depth_tolerance` (mm)."""
    q, n = pixel_centers(camera), settings.levels
    levels = levels_of(tree, n)
    views = [[view_from_world(points, camera) for points, _ in level] for level in levels]
    distance = distance_to(views[0], q)
    f = np.sqrt(n * distance / settings.level_distance)
    fine = np.minimum(n, np.floor(f)).astype(int)
    coarse = np.minimum(n, fine + 1)
    shape = (n + 1, len(q))
    z, slack, z_range = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    vessel, others = np.zeros(shape, int), np.zeros(shape, bool)
    for k in range(n + 1):
        used = np.flatnonzero((fine == k) | (coarse == k))
        if len(used) == 0:
            continue
        pieces = []
        for view, (points, radius) in zip(views[k], levels[k], strict=True):
            new = distinct(points)
            pieces.append(pieces_of(view[new], radius[new] * settings.preserve_lumen))
        won = winners(pieces, q[used], settings)
        z[k, used], vessel[k, used], slack[k, used] = won.z, won.vessel, won.slack
        z_range[k, used], others[k, used] = won.z_range, won.other_vessel
    pixel = np.arange(len(q))
    weight = np.where(fine == n, 0.0, f - fine)
    depth = (1 - weight) * z[fine, pixel] + weight * z[coarse, pixel]
    ruling = np.where(weight > 0.5, coarse, fine)
    mixed = (1 - weight) * slack[fine, pixel] + weight * slack[coarse, pixel]
    # The square root makes much of little where the distance is nearly 0.
    blur = np.sqrt(n / settings.level_distance) * (np.sqrt(distance + 2e-5) - np.sqrt(distance))
    step = np.abs(z[coarse, pixel] - z[fine, pixel])
    vague = (1 - weight) * z_range[fine, pixel] + weight * z_range[coarse, pixel] + blur * step
    balanced = (np.abs(weight - 0.5) < blur + 1e-5) & (vessel[fine, pixel] != vessel[coarse, pixel])
    other = others[ruling, pixel] | balanced
    flat = (depth, vessel[ruling, pixel], distance, mixed, vague > depth_tolerance, other)
    return Surface(*(image.reshape(camera.size[::-1]) for image in flat))


def depth_filter(image):
    """The 7 × 7 Gaussian of σ = 2√(2 ln 2)/π pixels, clamped at the border."""
    sigma = 2 * np.sqrt(2 * np.log(2)) / np.pi
    rows, columns = np.mgrid[-3:4, -3:4]
    weights = np.exp(-(rows**2 + columns**2) / (2 * sigma**2))
    padded = np.pad(image, 3, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (7, 7))
    return (windows * weights).sum(axis=(2, 3)) / weights.sum()


def position(depth, camera):
    """World points (H, W, 3) of a depth image."""
    q = pixel_centers(camera).reshape(*depth.shape, 2)
    right = np.cross(camera.direction, camera.up)
    right /= np.linalg.norm(right)
    up = np.cross(right, camera.direction)
    return camera.center + q[..., :1] * right + q[..., 1:] * up + depth[..., None] * camera.direction


def trilinear(volume, world):
    """The volume at world points (H, W, 3): the border goes on for half a voxel, beyond is NaN."""
    affine, last = volume.world_from_index, np.asarray(volume.size) - 1
    index = np.linalg.solve(affine[:3, :3], (world - affine[:3, 3])[..., None])[..., 0]
    outside = ((index < -0.5) | (index > last + 0.5)).any(axis=-1)
    index = np.clip(index, 0, last)
    low = np.minimum(np.floor(index).astype(int), np.maximum(last - 1, 0))
    value = np.zeros(index.shape[:-1])
    for corner in np.ndindex(2, 2, 2):
        weight = np.where(corner, index - low, 1 - (index - low)).prod(axis=-1)
        i, j, k = np.moveaxis(np.minimum(low + corner, last), -1, 0)
        value += weight * volume.array[k, j, i].astype(float)
    return np.where(outside, np.nan, value)
