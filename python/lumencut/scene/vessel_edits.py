"""Cuts a vessel into two, and joins two vessels into one."""

from __future__ import annotations

from typing import Any

from lumencut import _lumencut
from lumencut.scene.vessel import Vessel


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
