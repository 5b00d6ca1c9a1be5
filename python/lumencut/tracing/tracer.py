"""Centerlines from a volume and a few points along its vessels."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from types import NoneType
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import callback, flag, number, numbers
from lumencut.base.wording import counted
from lumencut.errors import TracingError
from lumencut.scene.images import as_volume
from lumencut.scene.polarity import Polarity, traced_volume
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.tracing.levels import trace_by_levels

Progress = Callable[[int, int], object]
_Points = npt.NDArray[np.float64]


def trace(
    volume: Volume | Any,
    points: npt.ArrayLike | Sequence[npt.ArrayLike],
    stoppers: npt.ArrayLike = (),
    *,
    stopper_radius: float = 3.0,
    bridge: bool = False,
    polarity: Polarity = "bright",
    names: Sequence[str | None] | None = None,
    progress: Progress | None = None,
) -> VesselTree:
    """Trace the centerlines of vessels from two or more points along each.

    The points need not be central: each line runs in the middle of the lumen, from the cross-section of its
    first point to that of its last one. A minimal path leads from point to point; its cost is low where
    values resemble those at the points and lumen surrounds them. It is then moved to the middle of
    cross-sections and smoothed over about 1 mm. The outline is that of Tang et al. 2012, Metz et al. 2009 and
    Manniesing et al. 2010; docs/method/tracing.md describes the differences.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The scan, such as an angiography.
    points : array_like, shape (n, 3), or a sequence of several such
        Two or more points in order along one vessel (mm, LPS), or a list of them for each of several vessels.
        A later vessel that begins or ends within an earlier one is joined to it: its end is exactly a point
        of the earlier one.
    stoppers : array_like, shape (m, 3), default none
        Points (mm, LPS) around which no vessel may pass.
    stopper_radius : float, default 3.0
        Radius of the forbidden region around each stopper (mm).
    bridge : bool, default False
        Whether vessels may continue where no lumen is visible, as in an occlusion. Without it a stretch of
        more than 5 mm is an error, and one of more than 1.2 mm where the vessel does not continue in the same
        direction.
    polarity : {"bright", "dark"}, default "bright"
        Whether lumen is brighter than the tissue around it, or darker, as in airways and bile ducts.
    names : sequence of str or None, optional
        The names of the vessels.
    progress : callable, optional
        Called at intervals with the work done and the total work.

    Returns
    -------
    VesselTree
        A vessel for each list, points at most 0.5 mm apart, with ``radius``, ``confidence`` and ``bridged``.
        :attr:`VesselTree.notes` says what is doubtful: detours, changes of brightness, guesses in dim lumen.

    Raises
    ------
    TracingError
        For points outside the volume or not in lumen, equal points, and points between which there is no
        lumen: the error names the weakest place, what the volume has there, and what was expected.
    SettingsError
        For another polarity.
    VolumeError
        For anything that is not a volume.
    """
    lists, scan = _lists(points), traced_volume(as_volume(volume), polarity)
    for vessel, listed in enumerate(lists):
        if len(listed) < 2:
            found = counted(len(listed), "point")
            raise TracingError(f"points of vessel {vessel}", found, "two or more, in order along the vessel")

    def route(part: Volume) -> VesselTree:
        tracer = Tracer(part, bridge=bridge, polarity=polarity)
        for vessel, listed in enumerate(lists):
            for point in listed:
                tracer.add(point, vessel)
        for stopper in _rows("stoppers", stoppers):
            tracer.stop(stopper, stopper_radius)
        return tracer.route(names=names, progress=progress)

    return trace_by_levels(scan, lists, route)


class Tracer:
    """Centerlines of one volume that follow points and stoppers as they are added, moved and removed.

    Reading its :attr:`tree` after a change recomputes the paths between points next to the change and
    keeps all others. Lines may differ from those of :func:`trace` by small parts of a voxel, because the
    values of lumen are not estimated again as long as all points fit. Changes must not come from several
    threads at a time.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The scan. Its voxels must not change as long as the tracer is used.
    bridge, polarity
        As for :func:`trace`.

    Raises
    ------
    SettingsError
        For another polarity.
    VolumeError
        For anything that is not a volume.
    """

    def __init__(self, volume: Volume | Any, *, bridge: bool = False, polarity: Polarity = "bright") -> None:
        self._volume = traced_volume(as_volume(volume), polarity)
        self._bridge = flag(TracingError, "bridge", bridge)
        self._kept = _lumencut.Tracer()
        self._vessels: list[list[_Points]] = []
        self._stoppers: list[tuple[_Points, float]] = []
        self._tree: VesselTree | None = None

    @property
    def points(self) -> tuple[_Points, ...]:
        """The points of each vessel, each of shape (n, 3), mm, LPS."""
        return tuple(np.array(vessel).reshape(-1, 3) for vessel in self._vessels)

    @property
    def stoppers(self) -> tuple[tuple[_Points, float], ...]:
        """The stoppers: position (3,) (mm, LPS) and radius (mm)."""
        return tuple(self._stoppers)

    @property
    def tree(self) -> VesselTree:
        """The vessels of two and more points; as :meth:`route`, with its errors."""
        return self.route()

    def add(self, point: npt.ArrayLike, vessel: int | None = None, index: int | None = None) -> int:
        """Add a point to a vessel and return the vessel.

        Parameters
        ----------
        point : array_like, shape (3,)
            The point (mm, LPS).
        vessel : int, optional
            To which vessel; by default the last one. The number of vessels begins a new one.
        index : int, optional
            Before which of its points; by default after all of them.
        """
        added = _place("point", point)
        count = len(self._vessels)
        vessel = max(count - 1, 0) if vessel is None else _index("vessel", vessel, count + 1)
        here = self._vessels[vessel] if vessel < count else []
        at = len(here) if index is None else _index("index of the point", index, len(here) + 1)
        if vessel == count:
            self._vessels.append(here)
        here.insert(at, added)
        self._tree = None
        return vessel

    def move(self, index: int, point: npt.ArrayLike, vessel: int = 0) -> None:
        """Move a point of a vessel to another place (mm, LPS)."""
        moved = _place("point", point)
        here = self._vessel(vessel)
        here[_index("index of the point", index, len(here))] = moved
        self._tree = None

    def remove(self, index: int, vessel: int = 0) -> None:
        """Remove a point of a vessel; a vessel without points keeps its place among the others."""
        here = self._vessel(vessel)
        del here[_index("index of the point", index, len(here))]
        self._tree = None

    def stop(self, point: npt.ArrayLike, radius: float = 3.0) -> int:
        """Add a stopper of a radius (mm) at a place (mm, LPS), and return its index."""
        self._stoppers.append(
            (_place("stopper", point), number(TracingError, "radius of the stopper", radius))
        )
        self._tree = None
        return len(self._stoppers) - 1

    def remove_stopper(self, index: int) -> None:
        """Remove a stopper."""
        del self._stoppers[_index("index of the stopper", index, len(self._stoppers))]
        self._tree = None

    def route(
        self, *, names: Sequence[str | None] | None = None, progress: Progress | None = None
    ) -> VesselTree:
        """Trace what has changed, and return the vessels of two and more points; parameters as :func:`trace`.

        Raises
        ------
        TracingError
            As :func:`trace`; the points stay as they are, and can be changed.
        """
        lists = [np.array(vessel) for vessel in self._vessels if len(vessel) > 1]
        if isinstance(names, (str, bytes)) or not isinstance(names, (Iterable, NoneType)):
            raise TracingError("names", f"{names!r:.80}", "a text or None for each vessel")
        called = [None] * len(lists) if names is None else list(names)
        callback(TracingError, "progress", progress)
        if len(called) != len(lists):
            raise TracingError(
                "names", counted(len(called), "name"), f"one for each of {counted(len(lists), 'vessel')}"
            )
        if self._tree is None:
            if not lists:
                raise TracingError("points", "none", "two or more points along a vessel")
            traced = self._kept.trace(
                self._volume,
                lists,
                [(tuple(center.tolist()), radius) for center, radius in self._stoppers],
                self._bridge,
                progress,
            )
            self._tree = VesselTree(
                Vessel(points, radius, confidence=confidence, bridged=bridged)
                for points, radius, confidence, bridged, _ in traced
            )
            doubts = [(vessel, doubt) for vessel, (*_, told) in enumerate(traced) for doubt in told]
            self._tree._notes = tuple(f"vessel {vessel}: {doubt}" for vessel, doubt in doubts)
        if names is None:
            return self._tree
        tree = VesselTree(vessel.named(name) for vessel, name in zip(self._tree, called, strict=True))
        tree._notes = self._tree._notes
        return tree

    def _vessel(self, vessel: int) -> list[_Points]:
        return self._vessels[_index("vessel", vessel, len(self._vessels))]


def _lists(points: Any) -> list[_Points]:
    """Return the points of each vessel, given those of one or of several vessels."""
    try:
        is_one = np.ndim(points) == 2
    except ValueError:
        is_one = False
    if is_one:
        return [_rows("points", points)]
    try:
        several = list(points)
    except TypeError as error:
        raise TracingError(
            "points", type(points).__name__, "points of shape (n, 3), or a list of them"
        ) from error
    return [_rows(f"points of vessel {n}", listed) for n, listed in enumerate(several)]


def _rows(subject: str, points: Any) -> _Points:
    """Points as an array (n, 3), with n = 0 for an empty list."""
    with suppress(ValueError):
        # An empty list cannot become an array of shape (n, 3).
        if np.size(points) == 0:
            return np.empty((0, 3))
    return numbers(TracingError, subject, points, (-1, 3))


def _place(subject: str, point: Any) -> _Points:
    return numbers(TracingError, subject, point, (3,))


def _index(subject: str, index: SupportsIndex, count: int) -> int:
    try:
        return range(count)[operator.index(index)]
    except (IndexError, TypeError) as error:
        expected = f"a whole number from 0 to {count - 1}" if count else "nothing: there is none yet"
        raise TracingError(subject, f"{index!r}", expected) from error
