"""The pieces of the cut surface (docs/method/cut-surface.md), restricted to lumens.

A piece covers a pixel if the cut surface's piece does and if the centerline is at most a radius away. Both
neighbours at a common border compute the same number, so no pixel falls between them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.centerline import COLLINEAR_MM
from lumencut.evaluation.projection import Projection
from lumencut.evaluation.raster import Regions

_Floats: TypeAlias = npt.NDArray[np.float64]
_Indices: TypeAlias = npt.NDArray[np.intp]


class Offer(NamedTuple):
    """Values of pieces at positions (n,): whether they cover them, depth, radius, arc length (mm), vessel."""

    covers: npt.NDArray[np.bool_]
    depth: _Floats
    radius: _Floats
    arc: _Floats
    vessel: _Indices


@dataclass(frozen=True, eq=False)
class Stripes:
    """The lumens of segments; ``first`` is the index of the first point of each segment."""

    seen: Projection
    first: _Indices

    def regions(self) -> Regions:
        """Return each lumen as the intersection of four half-planes."""
        place, radius = self.seen.place, self.seen.centerline.radius
        start, end = place[self.first], place[self.first + 1]
        r0, r1 = radius[self.first], radius[self.first + 1]
        length = np.linalg.norm(end - start, axis=1)
        along = (end - start) / length[:, None]
        across = np.stack([-along[:, 1], along[:, 0]], axis=1)
        # |distance| ≤ r0 + t · (r1 − r0), t linear in the position.
        growth = ((r1 - r0) / length)[:, None] * along
        normal = np.stack([-along, along, across - growth, -across - growth], axis=1)
        from_start = np.stack([np.zeros_like(length), length, r0, r0], axis=1)
        limit = from_start + (normal * start[:, None]).sum(axis=2)
        reach = np.hypot(length / 2, np.maximum(r0, r1))
        return Regions((start + end) / 2, reach, normal, limit)

    def offer(self, piece: _Indices, place: _Floats) -> Offer:
        """Evaluate these pieces at these positions (n, 2)."""
        first = self.first[piece]
        line, seen = self.seen.centerline, self.seen
        start, end = seen.place[first], seen.place[first + 1]
        edge = end - start
        along, beyond = _dot(place - start, edge), _dot(place - end, edge)
        t = along / _dot(edge, edge)
        foot = place - start - t[:, None] * edge
        depth, radius, arc = (
            values[first] + t * (values[first + 1] - values[first])
            for values in (seen.depth, line.radius, line.arc)
        )
        covers = (along >= 0) & (beyond <= 0) & (_dot(foot, foot) <= radius**2)
        return Offer(covers, depth, radius, arc, line.vessel[first])


@dataclass(frozen=True, eq=False)
class Fans:
    """The lumens around points: wedges, half-planes at ends, and full planes.

    ``before`` and ``after`` are the two edges of a wedge (n, 2); a missing edge is zero.
    """

    seen: Projection
    point: _Indices
    before: _Floats
    after: _Floats

    def regions(self) -> Regions:
        """Return each lumen as the intersection of a disc and two half-planes."""
        center = self.seen.place[self.point]
        normal = np.stack([-_unit(self.before), _unit(self.after)], axis=1)
        limit = (normal * center[:, None]).sum(axis=2)
        return Regions(center, self.seen.centerline.radius[self.point], normal, limit)

    def offer(self, piece: _Indices, place: _Floats) -> Offer:
        """Evaluate these pieces at these positions (n, 2)."""
        point, line = self.point[piece], self.seen.centerline
        offset, radius = place - self.seen.place[point], line.radius[point]
        covers = (_dot(offset, self.before[piece]) >= 0) & (_dot(offset, self.after[piece]) <= 0)
        covers &= _dot(offset, offset) <= radius**2
        return Offer(covers, self.seen.depth[point], radius, line.arc[point], line.vessel[point])


def pieces_of(seen: Projection) -> tuple[Stripes, Fans]:
    """Return the pieces of all vessels in a view."""
    edge = np.append(np.diff(seen.place, axis=0), np.zeros((1, 2)), axis=0)
    vessel = seen.centerline.vessel
    within = np.append(vessel[:-1] == vessel[1:], False)
    solid = within & (np.linalg.norm(edge, axis=1) >= COLLINEAR_MM)
    edge = np.where(solid[:, None], edge, 0.0)
    fans = [_after_stripes(solid, within, edge), *_at_ends(seen, solid, edge)]
    point, before, after = (np.concatenate(column) for column in zip(*fans, strict=True))
    return Stripes(seen, np.flatnonzero(solid)), Fans(seen, point, before, after)


def _after_stripes(
    solid: npt.NDArray[np.bool_], within: npt.NDArray[np.bool_], edge: _Floats
) -> tuple[_Indices, _Floats, _Floats]:
    """Return the wedges at the ends of stripes, and the half-planes before a collinear run or an end."""
    end = np.flatnonzero(solid) + 1
    # If a run reaches the end of the vessel, the full plane there replaces this half-plane.
    runs_out = _last_solid(solid, within)[end - 1] & within[end]
    end = end[~runs_out]
    return end, edge[end - 1], edge[end]


def _last_solid(solid: npt.NDArray[np.bool_], within: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Return which segments are the last stripe of their vessel."""
    where = np.flatnonzero(solid)
    owner: _Indices = np.cumsum(~within) - ~within
    last = np.zeros(len(solid), bool)
    last[where[np.diff(owner[where], append=-1) != 0]] = True
    return last


def _at_ends(
    seen: Projection, solid: npt.NDArray[np.bool_], edge: _Floats
) -> list[tuple[_Indices, _Floats, _Floats]]:
    """Return half-planes at starts, full planes at runs at vessel ends, and vessels projected to a point."""
    vessel = seen.centerline.vessel
    first = np.flatnonzero(np.diff(vessel, prepend=-1))
    last = np.append(first[1:], len(vessel)) - 1
    flat = np.add.reduceat(solid, first) == 0
    lone = np.array(
        [a + np.argmin(seen.depth[a : b + 1]) for a, b in zip(first[flat], last[flat], strict=True)]
    )
    runs_out = ~flat & ~solid[np.maximum(last - 1, 0)]
    starts, ends = first[~flat], np.concatenate([last[runs_out], lone.astype(int)])
    nothing = np.zeros((len(ends), 2))
    return [(starts, np.zeros((len(starts), 2)), edge[starts]), (ends, nothing, nothing)]


def _dot(a: _Floats, b: _Floats) -> _Floats:
    product: _Floats = a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1]
    return product


def _unit(edge: _Floats) -> _Floats:
    length = np.linalg.norm(edge, axis=1)[:, None]
    unit: _Floats = np.divide(edge, length, out=np.zeros_like(edge), where=length > 0)
    return unit
