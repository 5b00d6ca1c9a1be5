"""Places where vessels cross in the projection."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.centerline import SEPARATE_ARC_MM, elsewhere
from lumencut.evaluation.projection import Projection
from lumencut.evaluation.ragged import parts, ragged


@dataclass(frozen=True, eq=False)
class Crossings:
    """Crossings in the view: positions (n, 2), and depth and radius (n,) of the nearer vessel (mm)."""

    place: npt.NDArray[np.float64]
    depth: npt.NDArray[np.float64]
    radius: npt.NDArray[np.float64]

    def chosen(self, which: npt.NDArray[np.bool_]) -> Crossings:
        """Return some of the crossings."""
        return Crossings(self.place[which], self.depth[which], self.radius[which])


def crossings_of(seen: Projection) -> Crossings:
    """Return the crossings of two vessels, or of two parts of one vessel more than 20 mm of arc length apart.

    They count if the depths differ by more than the sum of both radii: then the lumens do not touch.
    """
    segment = seen.centerline.segments
    low, high = np.sort([seen.place[segment], seen.place[segment + 1]], axis=0)
    found = [np.zeros((0, 4))]
    for first, second in _overlapping(low, high):
        crossing = ((low[first] <= high[second]) & (low[second] <= high[first])).all(axis=1)
        found.append(_met(seen, segment[first[crossing]], segment[second[crossing]]))
    x, y, depth, radius = np.concatenate(found).T
    return Crossings(np.stack([x, y], axis=1), depth, radius)


def _overlapping(
    low: npt.NDArray[np.float64], high: npt.NDArray[np.float64]
) -> Iterator[tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]]:
    """Yield each pair of boxes that overlap along the one axis with fewer overlaps."""
    sweeps = []
    for axis in (0, 1):
        order = np.argsort(low[:, axis], kind="stable")
        end = np.searchsorted(low[order, axis], high[order, axis], side="right")
        sweeps.append((int(end.sum()), order, end))
    _, order, end = min(sweeps, key=lambda sweep: sweep[0])
    after = np.arange(len(order)) + 1
    for part in parts(end - after):
        owner, member = ragged(after[part], (end - after)[part])
        yield order[part][owner], order[member]


def _met(
    seen: Projection, first: npt.NDArray[np.intp], second: npt.NDArray[np.intp]
) -> npt.NDArray[np.float64]:
    """Return where segments cross without touching: position, depth, radius of the nearer vessel, (n, 4)."""
    line = seen.centerline
    far = elsewhere(
        line.vessel[first], line.arc[first], line.vessel[second], line.arc[second], SEPARATE_ARC_MM
    )
    first, second = first[far], second[far]
    start, edge = seen.place[first], seen.place[first + 1] - seen.place[first]
    other = seen.place[second + 1] - seen.place[second]
    offset = seen.place[second] - start
    area = _cross(edge, other)
    with np.errstate(divide="ignore", invalid="ignore"):
        t, u = _cross(offset, other) / area, _cross(offset, edge) / area
    meets = (area != 0) & (t >= 0) & (t < 1) & (u >= 0) & (u < 1)
    t, u, first, second = t[meets], u[meets], first[meets], second[meets]
    depth = np.stack([_between(seen.depth, first, t), _between(seen.depth, second, u)])
    radius = np.stack([_between(line.radius, first, t), _between(line.radius, second, u)])
    nearer = depth.argmin(axis=0)[None]
    place = start[meets] + t[:, None] * edge[meets]
    known = [np.take_along_axis(values, nearer, axis=0)[0] for values in (depth, radius)]
    apart = np.abs(depth[0] - depth[1]) > radius.sum(axis=0)
    found: npt.NDArray[np.float64] = np.column_stack([place, *known])[apart]
    return found


def _between(
    values: npt.NDArray[np.float64], first: npt.NDArray[np.intp], t: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    between: npt.NDArray[np.float64] = values[first] + t * (values[first + 1] - values[first])
    return between


def _cross(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    area: npt.NDArray[np.float64] = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return area
