"""The tree that vessels form: unbranched centerlines in world space (LPS, mm)."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator
from typing import Any, SupportsIndex, overload

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import callback, integers, number
from lumencut.base.pickles import by_name
from lumencut.base.values import Value
from lumencut.base.wording import counted
from lumencut.errors import SettingsError, VesselTreeError
from lumencut.scene.measured_radii import measured_radii
from lumencut.scene.vessel import Vessel, joined, parts_of
from lumencut.scene.vessel_gap import Gap
from lumencut.scene.vessel_names import all_named, the_one_named
from lumencut.scene.wall_level import Wall


@by_name
class VesselTree(Value):
    """A set of vessels that may share end points; a vessel's index is its id.

    Forests, cycles and loose pieces are legal. Trees of equal vessels in the same order are equal.
    ``tree[2]`` is the vessel with the id 2, ``tree["LAD"]`` the one with that name. Names need not be unique:
    one that several vessels have is a ``VesselTreeError`` that gives their ids, as is one that no vessel has;
    it is a ``KeyError`` too. ``"LAD" in tree`` tests whether any vessel has the name.

    Parameters
    ----------
    vessels : iterable of Vessel
        At least one vessel.

    Raises
    ------
    VesselTreeError
        For a tree without vessels, or members that are not vessels.
    """

    #: Whether the user stated the space of the coordinates, or was warned about it.
    _space_settled = False
    _gaps: tuple[Gap, ...] = ()
    _notes: tuple[str, ...] = ()
    _doubtful: tuple[Vessel, ...] = ()
    _doubts: tuple[str, ...] = ()
    _parts: tuple[tuple[int, ...], ...] | None = None

    def __init__(self, vessels: Iterable[Vessel]) -> None:
        try:
            self._vessels = tuple(vessels)
        except TypeError as error:
            raise VesselTreeError("vessel tree", type(vessels).__name__, "several Vessel objects") from error
        if not self._vessels:
            raise VesselTreeError("vessel tree", "no vessels", "at least one vessel")
        for vessel in self._vessels:
            if not isinstance(vessel, Vessel):
                raise VesselTreeError(
                    "vessel tree", f"a member of type {type(vessel).__name__}", "only Vessel objects"
                )

    def levels(self, count: int = 6) -> list[VesselTree]:
        """Return this tree and its levels of detail, finest first.

        Level k + 1 is the clamped cubic B-spline over the points of level k, evaluated at half as many
        parameters; end points stay where they are (Auzinger et al. 2013, sections 3.1.4 and 3.2.2).

        Parameters
        ----------
        count : int, default 6
            Number of levels beyond the finest.
        """
        (checked,) = integers(VesselTreeError, "count of levels", [count], 0, 64, 1)
        made = _lumencut.levels(self._arrays(), checked)
        names = [vessel.name for vessel in self._vessels]
        return [
            VesselTree(
                Vessel(points, radius, name) for (points, radius), name in zip(level, names, strict=True)
            )
            for level in made
        ]

    def smoothed(self, radii: float) -> VesselTree:
        """Return the tree with smooth centerlines, as the setting ``centerline_smoothing`` makes them.

        Each vessel is smoothed along its arc length by a Gaussian whose standard deviation at each point is
        ``radii`` times the radius there. Ends, points where another vessel ends, and points whose radius is 0
        or not known stay where they are; radii, names and the number of points stay too.

        Parameters
        ----------
        radii : float
            Standard deviation in radii, 0 to 10; with 0 every point stays.

        Raises
        ------
        SettingsError
            For another value of ``radii``.
        """
        made = _lumencut.smoothed(self._arrays(), number(SettingsError, "centerline_smoothing", radii))
        smoothed = VesselTree(
            Vessel(points, vessel.radius, vessel.name, confidence=vessel.confidence, bridged=vessel.bridged)
            for points, vessel in zip(made, self._vessels, strict=True)
        )
        smoothed._settle_lines_of(self)
        smoothed._space_settled, smoothed._parts = self._space_settled, self._parts
        return smoothed

    def measured(
        self,
        volume: Any,
        step: float = 0.5,
        fwhm: float | None = None,
        *,
        wall: Wall = None,
        progress: Callable[[int, int], object] | None = None,
    ) -> VesselTree:
        """Return the tree with radii measured in a volume, those of circles with the area of the lumen.

        Between sections at most 10 mm apart radii are interpolated, as within junctions. Elsewhere points
        keep their radius; points without one get that of the nearest section. :attr:`notes` states their
        number.

        Parameters
        ----------
        volume : Volume, or anything :func:`lumencut.render` takes as one
            The angiography.
        step : float, default 0.5
            The distance of sections (mm), at most.
        fwhm : float, optional
            As for :func:`lumencut.measure`; by default, estimated from the widest suitable vessel.
        wall : pair of float or "off", optional
            The level of walls, as for :func:`lumencut.measure`.
        progress : callable, optional
            Called at intervals with the work done and the total work.

        Raises
        ------
        SettingsError
            For an invalid step, wall or width of the point spread.
        VolumeError
            For anything that is not a volume.
        KeyboardInterrupt
            After Ctrl-C.
        """
        callback(VesselTreeError, "progress", progress)
        found, notes = measured_radii(volume, self._arrays(), step, fwhm, wall, progress)
        measured = VesselTree(
            Vessel(vessel.points, radius, vessel.name, confidence=vessel.confidence, bridged=vessel.bridged)
            for vessel, radius in zip(self._vessels, found, strict=True)
        )
        measured._settle_lines_of(self)
        measured._space_settled, measured._gaps = self._space_settled, self._gaps
        measured._notes, measured._parts = (*self._notes, *notes), self._parts
        return measured

    def ids(self, *vessels: SupportsIndex | str) -> list[int]:
        """Return the ids of vessels, rising, each once; parameters and errors are those of :meth:`select`."""
        return sorted(self._ids(vessels))

    def select(self, *vessels: SupportsIndex | str) -> VesselTree:
        """Return a tree of these vessels only, in their order in this tree, with new ids.

        Parameters
        ----------
        *vessels : int or str
            Ids and names. A name stands for all vessels that have it.

        Raises
        ------
        VesselTreeError
            For an id or a name that no vessel has, or no vessels at all.
        """
        wanted = self._ids(vessels)
        return self._part(index for index in range(len(self)) if index in wanted)

    def without(self, *vessels: SupportsIndex | str) -> VesselTree:
        """Return the tree without these vessels; parameters and errors are those of :meth:`select`."""
        unwanted = self._ids(vessels)
        return self._part(index for index in range(len(self)) if index not in unwanted)

    def path(self, ids: Iterable[SupportsIndex | str]) -> Vessel:
        """Return several vessels that meet as one, such as those from the root to an end.

        Parameters
        ----------
        ids : iterable of int or str
            Ids and names in their order along the path. Each vessel begins where the one before ends,
            regardless of the order of its points: ends at most 0.1 mm apart meet, and become one point.
            If a branch begins at a point between the ends of its parent, the path leaves the parent there:
            it comes from the first point of the parent, or from the vessel before it.

        Returns
        -------
        Vessel
            It has radii if all of the vessels have them, and their names joined by ``" + "`` if all have one.

        Raises
        ------
        VesselTreeError
            For no ids, an id or a name that not exactly one vessel has, a vessel that comes twice, or
            neighbours that do not meet.
        """
        if isinstance(ids, str) or not isinstance(ids, Iterable):
            raise VesselTreeError("path through the tree", repr(ids), "several ids or names")
        wanted = list(ids)
        if not wanted:
            raise VesselTreeError("path through the tree", "no vessels", "at least one id or name")
        vessels = [self._vessels[self._id(one)] for one in wanted]
        for n, vessel in enumerate(vessels):
            if any(vessel is other for other in vessels[:n]):
                raise VesselTreeError(
                    "path through the tree", f"vessel {wanted[n]!r} twice", "each vessel once"
                )
        lines = [(vessel.points, vessel.radius) for vessel in vessels]
        points, radius = _lumencut.path(lines, [f"vessel {one!r}" for one in wanted])
        names = [vessel.name for vessel in vessels if vessel.name is not None]
        path = Vessel(points, radius, " + ".join(names) if len(names) == len(vessels) else None)
        path._line_settled = all(vessel._line_settled for vessel in vessels)
        return path

    def cut(self, vessel: SupportsIndex | str, at: float) -> VesselTree:
        """Return the tree with a vessel cut in two; both parts have the point where it was cut.

        The parts replace the vessel, so that the ids of those after it are higher by 1. The
        first part keeps the name; where there is one, the second is called ``"<name> part 1"``, with the
        first number that is free.

        Parameters
        ----------
        vessel : int or str
            Its id or name.
        at : float
            The arc length where it is cut (mm), more than 0 and less than its length.

        Raises
        ------
        VesselTreeError
            For an id or a name that not exactly one vessel has, or a place that is not between its ends.
        """
        id_ = self._id(vessel)
        place = number(VesselTreeError, "place of the cut", at)
        taken = [one.name for one in self._vessels if one.name is not None]
        parts = parts_of(self._vessels[id_], place, taken)
        return self._with([*self._vessels[:id_], *parts, *self._vessels[id_ + 1 :]])

    def joined(self, first: SupportsIndex | str, second: SupportsIndex | str) -> VesselTree:
        """Return the tree with two vessels joined to one, at the ends that are nearest to each other.

        The new vessel has the place, the name and the direction of the first one, and the second one is
        removed. A gap between the ends is crossed straight, and the points in it count as bridged.

        Parameters
        ----------
        first, second : int or str
            Their ids or names.

        Raises
        ------
        VesselTreeError
            For an id or a name that not exactly one vessel has, one vessel twice, or ends that are farther
            apart than 5 mm and than twice the larger radius there.
        """
        kept, gone = self._id(first), self._id(second)
        if kept == gone:
            raise VesselTreeError("vessels to join", f"{first!r} and {second!r}, the same one", "two vessels")
        vessels = list(self._vessels)
        vessels[kept] = joined(vessels[kept], vessels[gone])
        return self._with(vessels[:gone] + vessels[gone + 1 :])

    def _with(self, vessels: Iterable[Vessel]) -> VesselTree:
        """Return a tree of other vessels in the same space."""
        tree = VesselTree(vessels)
        tree._space_settled = self._space_settled
        return tree

    def _settle_lines_of(self, other: VesselTree) -> None:
        """Copy to this tree that the lines of equal vessels were checked."""
        for vessel, same in zip(self._vessels, other._vessels, strict=True):
            vessel._line_settled = same._line_settled

    def _id(self, vessel: SupportsIndex | str) -> int:
        """Return the id of the only vessel with this id or name."""
        return the_one_named(self._vessels, vessel) if isinstance(vessel, str) else self.ids(vessel)[0]

    def _part(self, ids: Iterable[int]) -> VesselTree:
        return self._with(self._vessels[index] for index in ids)

    def _ids(self, vessels: Iterable[SupportsIndex | str]) -> set[int]:
        """Return the ids of vessels, given by id or name."""
        found: set[int] = set()
        for vessel in vessels:
            if isinstance(vessel, str):
                found.update(all_named(self._vessels, vessel))
                continue
            try:
                found.add(range(len(self))[operator.index(vessel)])
            except (IndexError, TypeError) as error:
                expected = f"an id from 0 to {len(self) - 1}, or a name"
                raise VesselTreeError(
                    "vessel of the tree",
                    f"{vessel!r:.80} in a tree of {counted(len(self), 'vessel')}",
                    expected,
                ) from error
        return found

    @property
    def gaps(self) -> tuple[Gap, ...]:
        """Gaps between the pieces of the mask that the tree was traced from, the narrowest first.

        Trees from elsewhere, and parts of a tree, have none.
        """
        return self._gaps

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on how the tree was found or traced, a sentence each."""
        return self._notes

    @property
    def doubtful(self) -> VesselTree:
        """Uncertain vessels of :func:`lumencut.find_vessels` and :func:`lumencut.trace_from`, if any."""
        tree = VesselTree.__new__(VesselTree)
        tree._vessels = self._doubtful
        tree._space_settled = self._space_settled
        return tree

    @property
    def doubts(self) -> tuple[str, ...]:
        """Why each vessel of :attr:`doubtful` is doubtful, in words."""
        return self._doubts

    @property
    def parts(self) -> tuple[tuple[int, ...], ...]:
        """The ids of vessels that are connected, one tuple for each part, the most important part first.

        In a tree of :func:`lumencut.find_vessels` each part begins with its root. In other trees vessels are
        connected if an end of one is a point of the other, to 0.001 mm; ids rise, and the longest part is the
        first.
        """
        if self._parts is None:
            made = _lumencut.parts([vessel.points for vessel in self._vessels])
            self._parts = tuple(tuple(part) for part in made)
        return self._parts

    @property
    def bounds(self) -> npt.NDArray[np.float64]:
        """Corners of the axis-aligned box around all points, shape (2, 3), mm, LPS."""
        points = self.points
        return np.stack([points.min(axis=0), points.max(axis=0)])

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """The points of all vessels, one vessel after the other, shape (n, 3), mm, LPS."""
        return np.concatenate([np.empty((0, 3)), *(vessel.points for vessel in self._vessels)])

    @property
    def segment_count(self) -> int:
        """Number of segments of all vessels."""
        return sum(len(vessel) - 1 for vessel in self._vessels)

    def _arrays(self) -> list[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None]]:
        return [(vessel.points, vessel.radius) for vessel in self._vessels]

    def __len__(self) -> int:
        return len(self._vessels)

    def _content(self) -> tuple[Any, ...]:
        return self._vessels

    @overload
    def __getitem__(self, vessel_id: SupportsIndex | str) -> Vessel: ...
    @overload
    def __getitem__(self, vessel_id: slice) -> tuple[Vessel, ...]: ...
    def __getitem__(self, vessel_id: SupportsIndex | str | slice) -> Vessel | tuple[Vessel, ...]:
        return self._vessels[self._id(vessel_id) if isinstance(vessel_id, str) else vessel_id]

    def __contains__(self, vessel: object) -> bool:
        if isinstance(vessel, str):
            return any(vessel == one.name for one in self._vessels)
        return vessel in self._vessels

    def __iter__(self) -> Iterator[Vessel]:
        return iter(self._vessels)

    def __repr__(self) -> str:
        return f"VesselTree({len(self)} vessels, {self.segment_count} segments)"
