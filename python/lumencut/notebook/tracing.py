"""Tracing by clicks into a picture: the points, and the vessels through them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lumencut.errors import TracingError
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.tracing.tracer import Tracer

Point = npt.NDArray[np.float64]


class ClickedVessels:
    """Vessels that are traced point by point, in addition to existing ones.

    Parameters
    ----------
    volume : Volume
        The angiography.
    before : VesselTree or None
        Vessels that are kept as they are.
    """

    def __init__(self, volume: Volume, before: VesselTree | None) -> None:
        self._tracer, self._before = Tracer(volume), before
        self._ended: set[int] = set()

    @property
    def points(self) -> list[Point]:
        """The points that were set, mm, LPS."""
        return [point for vessel in self._tracer.points for point in vessel]

    def add(self, point: Point) -> None:
        """Add a point to the present vessel, or begin the next vessel with it.

        Raises
        ------
        TracingError
            If no lumen leads to it; the points are unchanged.
        """
        vessel = self._current()
        self._tracer.add(point, vessel)
        try:
            self.tree()
        except TracingError:
            self._tracer.remove(len(self._tracer.points[vessel]) - 1, vessel)
            raise

    def _current(self) -> int:
        """Return the vessel to which the next point will be added."""
        filled = [vessel for vessel, points in enumerate(self._tracer.points) if len(points)]
        last = filled[-1] if filled else -1
        return last if last >= 0 and last not in self._ended else last + 1

    def end(self) -> None:
        """End the present vessel; if it has only one point, it is discarded."""
        current = self._current()
        points = self._tracer.points
        count = len(points[current]) if current < len(points) else 0
        if count == 1:
            self._tracer.remove(0, current)
        elif count > 1:
            self._ended.add(current)

    def undo(self) -> None:
        """Remove the last point; its vessel becomes the present one."""
        points = self._tracer.points
        last = next((vessel for vessel in reversed(range(len(points))) if len(points[vessel])), None)
        if last is not None:
            self._tracer.remove(len(points[last]) - 1, last)
            self._ended.discard(last)

    def tree(self) -> VesselTree | None:
        """Return all vessels; None if there are none yet.

        Raises
        ------
        TracingError
            If no lumen leads from a point to the next.
        """
        traced = any(len(vessel) > 1 for vessel in self._tracer.points)
        before = () if self._before is None else tuple(self._before)
        if not traced:
            return self._before
        return VesselTree((*before, *self._tracer.tree))
