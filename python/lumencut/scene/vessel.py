"""One unbranched vessel; how it is cut into two, and two are joined into one."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import numbers
from lumencut.base.pickles import by_name
from lumencut.base.values import Value, content_of
from lumencut.errors import VesselTreeError
from lumencut.scene.vessel_checks import marks, radii, shares


@by_name
class Vessel(Value):
    """One unbranched centerline; vessels with the same points, radii, name, confidence and bridges are equal.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        At least two points (mm, LPS), at most 1e6 mm from the origin along each axis.
    radius : array_like, shape (n,) or scalar, optional
        Radius of the lumen at each point (mm), 0 or more; without it the wall lies on the centerline.
    name : str, optional
        The vessel's name.
    confidence : array_like, shape (n,), optional
        Confidence of each point, 0 to 1, if the vessel was traced.
    bridged : array_like of bool, shape (n,), optional
        Which points lie where no lumen was visible, because a bridge was requested.

    Raises
    ------
    VesselTreeError
        For points or radii of another shape or value.
    """

    #: Whether doubts about the line of this vessel were reported.
    _line_settled = False

    def __init__(
        self,
        points: npt.ArrayLike,
        radius: npt.ArrayLike | None = None,
        name: str | None = None,
        *,
        confidence: npt.ArrayLike | None = None,
        bridged: npt.ArrayLike | None = None,
    ) -> None:
        self._points = numbers(VesselTreeError, "points of the vessel", points, (-1, 3))
        self._radius = None if radius is None else radii(radius, len(self._points))
        if not (name is None or isinstance(name, str)):
            raise VesselTreeError("name of the vessel", f"{type(name).__name__}", "a text or None")
        self._name = name
        self._confidence = None if confidence is None else shares(confidence, len(self._points))
        self._bridged = None if bridged is None else marks(bridged, len(self._points))
        _lumencut.check_vessel(self._points, self._radius)

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """The points, shape (n, 3), mm, LPS."""
        return self._points

    @property
    def radius(self) -> npt.NDArray[np.float64] | None:
        """The radius at each point, shape (n,), mm, where known."""
        return self._radius

    @property
    def name(self) -> str | None:
        """The vessel's name, where known."""
        return self._name

    @property
    def confidence(self) -> npt.NDArray[np.float64] | None:
        """Confidence of each point, 0 to 1, shape (n,), if known."""
        return self._confidence

    @property
    def bridged(self) -> npt.NDArray[np.bool_] | None:
        """Which points lie where no lumen was visible, shape (n,), where known."""
        return self._bridged

    def named(self, name: str | None) -> Vessel:
        """Return the vessel with another name."""
        made = Vessel(self._points, self._radius, name, confidence=self._confidence, bridged=self._bridged)
        made._line_settled = self._line_settled
        return made

    @property
    def length(self) -> float:
        """Arc length (mm)."""
        return float(np.linalg.norm(np.diff(self._points, axis=0), axis=1).sum())

    def _content(self) -> tuple[Any, ...]:
        marks = None if self._bridged is None else self._bridged.tobytes()
        return (
            content_of(self._points),
            content_of(self._radius),
            self._name,
            content_of(self._confidence),
            marks,
        )

    def __len__(self) -> int:
        return len(self._points)

    def __repr__(self) -> str:
        name = "" if self._name is None else f"{self._name!r}, "
        return f"Vessel({name}{len(self)} points, {self.length:.1f} mm)"


def parts_of(vessel: Vessel, at: float, taken: list[str]) -> list[Vessel]:
    """Return both parts of a vessel cut at an arc length (mm), with names that no other vessel has."""
    name = vessel.name
    names = [name, None if name is None else _lumencut.part_name(taken, name)]
    parts = _lumencut.cut(_arrays(vessel), at)
    return [_vessel(part, name, vessel) for part, name in zip(parts, names, strict=True)]


def joined(first: Vessel, second: Vessel) -> Vessel:
    """Return two vessels as one, under the name of the first one."""
    return _vessel(_lumencut.join(_arrays(first), _arrays(second)), first.name, first, second)


def _arrays(vessel: Vessel) -> tuple[Any, ...]:
    return vessel.points, vessel.radius, vessel.confidence, vessel.bridged


def _vessel(arrays: tuple[Any, ...], name: str | None, *sources: Vessel) -> Vessel:
    points, radius, confidence, bridged = arrays
    made = Vessel(points, radius, name, confidence=confidence, bridged=bridged)
    made._line_settled = all(source._line_settled for source in sources)
    return made
