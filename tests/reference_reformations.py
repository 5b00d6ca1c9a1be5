"""mpCPR and CR, computed again in 64-bit floats without a search: every pixel against every piece."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lumencut import Volume


def view_of(tree, camera):
    """View coordinates of the points of each vessel."""
    axes = np.stack([camera.right_axis, camera.up, camera.direction], axis=1)
    return [(vessel.points - camera.center) @ axes for vessel in tree]


def places(camera):
    """View x of the columns and view y of the rows."""
    (width, height), side = camera.size, camera.pixel_spacing
    x = (np.arange(width) + 0.5 - width / 2) * side
    return x, (height / 2 - np.arange(height) - 0.5) * side


def mpcpr(tree, camera):
    """Return depth, vessel and folded (H, W) of mpCPR; segments within a row are ignored."""
    columns, rows = places(camera)
    shape = (len(rows), len(columns))
    depth, vessel, folded = np.full(shape, np.nan), np.full(shape, -1), np.zeros(shape, bool)
    for j, y in enumerate(rows):
        met = np.concatenate([crossed(points, y, n) for n, points in enumerate(view_of(tree, camera))])
        for i, x in enumerate(columns if len(met) else ()):
            order = np.lexsort([met[:, 2], met[:, 1], np.abs(met[:, 0] - x)])
            depth[j, i], vessel[j, i] = met[order[0], 1:]
            folded[j, i] = (met[:, 2] == vessel[j, i]).sum() > 1
    return depth, vessel, folded


def crossed(points, y, number):
    """Return where a row crosses a vessel: view x, depth and the number of the vessel, (n, 3)."""
    before, after = points[:-1], points[1:]
    owned = before[:, 1] == y
    inside = (before[:, 1] - y) * (after[:, 1] - y) < 0
    inside[-1] |= after[-1, 1] == y
    which = np.flatnonzero(owned | inside)
    t = (y - before[which, 1]) / (after[which, 1] - before[which, 1])
    met = before[which] + t[:, None] * (after[which] - before[which])
    return np.column_stack([met[:, 0], met[:, 2], np.full(len(which), number)])


class Pieces(NamedTuple):
    """The pieces of a tree that cover one pixel."""

    distance: np.ndarray
    depth: np.ndarray
    radius: np.ndarray
    vessel: np.ndarray
    #: The start point of the piece, and how far along the vessel the place is from this point (mm).
    start: np.ndarray
    beyond: np.ndarray


def cr(tree, camera, radius_offset, arc_threshold):
    """Depth and vessel (H, W) of CR, by the rule of docs/method/reformations.md."""
    columns, rows = places(camera)
    offset, threshold = (pixels * camera.pixel_spacing for pixels in (radius_offset, arc_threshold))
    line, ways = Lines(tree, camera), all_ways(tree)
    depth, vessel = np.zeros((2, len(rows), len(columns)))
    for j, y in enumerate(rows):
        for i, x in enumerate(columns):
            pieces = line.seen(x, y)
            held = np.flatnonzero(pieces.distance <= pieces.radius + offset)
            candidates = np.arange(len(pieces.distance))
            if len(held):
                front = held[np.argmin(pieces.depth[held])]
                far = distance_along(ways, line.lengths, pieces, front)
                candidates = np.flatnonzero((far <= threshold) | (candidates == front))
            won = candidates[np.argmin(pieces.distance[candidates])]
            depth[j, i], vessel[j, i] = pieces.depth[won], pieces.vessel[won]
    return depth, vessel.astype(int)


class Lines:
    """The points of a tree in a view, vessel after vessel."""

    def __init__(self, tree, camera):
        view = view_of(tree, camera)
        self.points = np.concatenate(view)
        self.radius = np.concatenate([vessel.radius for vessel in tree])
        self.vessel = np.repeat(np.arange(len(view)), [len(points) for points in view])
        steps = np.diff(np.concatenate([vessel.points for vessel in tree]), axis=0)
        #: Whether a segment starts at each point; 0 at the end of a vessel.
        goes_on = np.append(self.vessel[1:] == self.vessel[:-1], False)
        self.lengths = np.where(goes_on, np.append(np.linalg.norm(steps, axis=1), 0.0), 0.0)
        self.edge = np.append(np.diff(self.points, axis=0), [[0, 0, 0]], axis=0) * goes_on[:, None]
        self.before = np.concatenate([[[0, 0, 0]], self.edge[:-1]])

    def seen(self, x, y):
        """Return all stripes and wedges that cover the pixel at (x, y)."""
        to = np.array([x, y]) - self.points[:, :2]
        edge, square = self.edge[:, :2], (self.edge[:, :2] ** 2).sum(axis=1)
        along = (to * edge).sum(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            t = along / square
        stripe = np.flatnonzero((square > 0) & (t >= 0) & (t <= 1))
        wedge = np.flatnonzero(((to * self.before[:, :2]).sum(axis=1) >= 0) & (along <= 0))
        start = np.concatenate([stripe, wedge])
        t = np.concatenate([t[stripe], np.zeros(len(wedge))])
        next_radius = np.append(self.radius[1:], 0.0)[start]
        radius = self.radius[start] + t * (next_radius - self.radius[start])
        away = to[start] - t[:, None] * edge[start]
        depth = self.points[start, 2] + t * self.edge[start, 2]
        distance = np.hypot(away[:, 0], away[:, 1])
        return Pieces(distance, depth, radius, self.vessel[start], start, t * self.lengths[start])


def all_ways(tree):
    """Return the shortest path length along the tree between any two points, (n, n): Floyd and Warshall."""
    points = np.concatenate([vessel.points for vessel in tree])
    ends = np.cumsum([len(vessel.points) for vessel in tree])
    ways = np.full((len(points), len(points)), np.inf)
    np.fill_diagonal(ways, 0)
    step = np.linalg.norm(np.diff(points, axis=0), axis=1)
    within = np.setdiff1d(np.arange(len(points) - 1), ends - 1)
    ways[within, within + 1] = ways[within + 1, within] = step[within]
    for end in {*(ends - 1), *(ends[:-1]), 0}:
        same = np.linalg.norm(points - points[end], axis=1) <= 1e-3
        ways[end, same] = ways[same, end] = 0
    for n in range(len(points)):
        np.minimum(ways, ways[:, n, None] + ways[None, n], out=ways)
    return ways


def distance_along(ways, lengths, pieces, front):
    """Return how far the place of each piece is from that of a given piece, along the tree (mm)."""
    same = pieces.start == pieces.start[front]
    far = np.where(same, np.abs(pieces.beyond - pieces.beyond[front]), np.inf)
    here = pieces.start[front], pieces.beyond[front], lengths[pieces.start[front]]
    there = pieces.start, pieces.beyond, lengths[pieces.start]
    for own, own_part in _ends(*here):
        for other, other_part in _ends(*there):
            far = np.minimum(far, own_part + ways[own, other] + other_part)
    return far


def _ends(start, beyond, length):
    """Return both end points of the segments, and the distance of a place from each."""
    following = np.where(length > 0, start + 1, start)
    return (start, beyond), (following, length - beyond)


def index_valued(affine, size=(30, 26, 22)):
    """Return three volumes; the values of their voxels are the indices i, j and k."""
    k, j, i = np.meshgrid(*(np.arange(n, dtype=np.float64) for n in size[::-1]), indexing="ij")
    return [Volume(axis, world_from_index=affine) for axis in (i, j, k)]


GRIDS = {
    "straight": np.array([[1.1, 0, 0, -15], [0, 0.9, 0, -12], [0, 0, 1.3, -14], [0, 0, 0, 1.0]]),
    "oblique": np.array(
        [[0.9, -0.3, 0.2, -12], [0.35, 0.85, 0.1, -16], [-0.2, 0.1, 1.2, -11], [0, 0, 0, 1.0]]
    ),
    "sheared": np.array([[1.0, 0, 0.4, -20], [0, 1, -0.3, -10], [0, 0, 1.2, -13], [0, 0, 0, 1.0]]),
}
