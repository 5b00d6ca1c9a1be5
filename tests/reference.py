"""The pieces of the method, computed again: slow, in numpy with 64-bit floats, from their description.

`reference_surface` chooses between the pieces, `reference_images` makes the images.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: Segments shorter than this in projection are collinear with the view (mm).
COLLINEAR = 1e-3
#: How far rounding moves a projected point (mm), in scenes of about 100 mm.
ROUNDING = 1e-5


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


def coarser(points, radius, arc):
    """Return the next coarser level of detail of one vessel; arc lengths remain those of the vessel."""
    controls = np.column_stack([points, radius, arc])
    count = max(-(-len(points) // 2), 2)
    if len(points) < 4:
        samples = np.linspace(controls[0], controls[-1], count)
    else:
        samples = basis(len(points), np.linspace(0, len(points) - 3, count)) @ controls
    samples[0], samples[-1] = controls[0], controls[-1]
    return samples[:, :3], samples[:, 3], samples[:, 4]


def levels_of(tree, count):
    """Level 0 to `count`, each a list of (points, radius, arc length); unknown radii are 0."""
    levels = [[]]
    for vessel in tree:
        steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
        radius = np.zeros(len(vessel.points)) if vessel.radius is None else vessel.radius
        levels[0].append((vessel.points, radius, np.concatenate([[0], np.cumsum(steps)])))
    for _ in range(count):
        levels.append([coarser(*vessel) for vessel in levels[-1]])
    return levels


def distinct(points):
    """Return which points differ from the point before: segments without length do not run along the view."""
    kept = [0]
    for i in range(1, len(points)):
        if np.linalg.norm(points[i] - points[kept[-1]]) >= COLLINEAR:
            kept.append(i)
    return kept


@dataclass
class Pieces:
    """The stripes, and the pieces at points, of one projected vessel; a missing edge is zero."""

    start: np.ndarray
    edge: np.ndarray
    stripe: np.ndarray  # z, r, s at the start, z, r, s at the end
    point: np.ndarray
    before: np.ndarray
    after: np.ndarray
    at_point: np.ndarray  # z, r, s


def pieces_of(view, radius, arc):
    """The local surface of a polyline in view space, with the arc length s at each point."""
    p, z, nothing = view[:, :2], view[:, 2], np.zeros(2)
    zrs = np.column_stack([z, radius, arc])
    edges = np.diff(p, axis=0)
    solid = np.flatnonzero(np.linalg.norm(edges, axis=1) >= COLLINEAR)
    if len(solid) == 0:
        nearest = np.argmin(z)
        fans = [(p[nearest], nothing, nothing, zrs[nearest])]
    else:
        first, last, end = solid[0], solid[-1], len(p) - 1
        # A half-plane before the first segment, or a plane if a run starts the vessel; likewise at the end.
        fans = [(p[0], nothing, edges[0] if first == 0 else nothing, zrs[0])]
        for i in solid[solid != last]:
            # A wedge, or a half-plane in forward direction if a run follows.
            after = edges[i + 1] if i + 1 in solid else nothing
            fans.append((p[i + 1], edges[i], after, zrs[i + 1]))
        fans.append((p[end], edges[last] if last + 1 == end else nothing, nothing, zrs[end]))
    point, before, after, at_point = (np.array(column) for column in zip(*fans, strict=True))
    stripe = np.column_stack([zrs[solid], zrs[solid + 1]])
    return Pieces(p[solid], edges[solid], stripe, point, before, after, at_point)


def beyond(offset, edge):
    """Return how far (mm) offsets (P, S, 2) lie along edges (S, 2); infinite if the edge is missing."""
    length = np.linalg.norm(edge, axis=-1)
    along = (offset * edge).sum(axis=-1)
    return np.divide(along, length, out=np.full(along.shape, np.inf), where=length > 0)


@dataclass
class Candidates:
    """Values of the pieces of a vessel, stripes first, at some pixels, each (P, S)."""

    z: np.ndarray
    r: np.ndarray
    s: np.ndarray
    d: np.ndarray
    inside: np.ndarray  # how far inside the piece (mm), ≥ 0 where covered
    slope: np.ndarray  # change of depth to the right and upwards, (P, S, 2)
    z_error: np.ndarray
    r_error: np.ndarray
    s_error: np.ndarray
    kind: np.ndarray  # 0 stripe, 1 wedge, 2 half-plane, 3 full plane


def candidates(pieces, q):
    """Evaluate every piece at every pixel.

    The errors are changes of a stripe's depth if rounding moves its ends: large for a short and
    steep stripe, which turns about its ends.
    """
    offset = q[:, None] - pieces.start
    length = np.linalg.norm(pieces.edge, axis=1)
    along = beyond(offset, pieces.edge)
    t = along / length
    begin, change = pieces.stripe[:, :3].T, (pieces.stripe[:, 3:] - pieces.stripe[:, :3]).T
    d = np.linalg.norm(offset - t[..., None] * pieces.edge, axis=-1)
    values = [z0 + t * dz for z0, dz in zip(begin, change, strict=True)]
    errors = [ROUNDING * (1 + d / length) * np.abs(dz) / length for dz in change]
    slope = np.broadcast_to((change[0] / length**2)[:, None] * pieces.edge, (*t.shape, 2))
    inside = np.minimum(along, length - along)
    stripes = (*values, d, inside, slope, *errors, np.zeros(inside.shape, int))
    offset = q[:, None] - pieces.point
    inside = np.minimum(beyond(offset, pieces.before), beyond(-offset, pieces.after))
    values = [np.broadcast_to(column, inside.shape) for column in pieces.at_point.T]
    nothing = np.zeros(inside.shape)
    missing = sum((edge == 0).all(axis=1).astype(int) for edge in (pieces.before, pieces.after))
    d, flat, kind = np.linalg.norm(offset, axis=-1), np.zeros((*inside.shape, 2)), 1 + missing
    fans = (*values, d, inside, flat, *3 * [nothing], np.broadcast_to(kind, inside.shape))
    return Candidates(*(np.concatenate(pair, axis=1) for pair in zip(stripes, fans, strict=True)))


def distance_to(vessels, q):
    """Return the smallest projected distance to any segment of any vessel (points, radius) in view space."""
    nearest = np.full(len(q), np.inf)
    for view in vessels:
        start, edge = view[:-1, :2], np.diff(view[:, :2], axis=0)
        square = (edge**2).sum(axis=1)
        offset = q[:, None] - start
        t = np.divide((offset * edge).sum(axis=-1), square, out=np.zeros(offset.shape[:2]), where=square > 0)
        foot = np.clip(t, 0, 1)[..., None] * edge
        nearest = np.minimum(nearest, np.linalg.norm(offset - foot, axis=-1).min(axis=1))
    return nearest
