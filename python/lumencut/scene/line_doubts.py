"""Doubts about lines, reported once per vessel: order of points, distant points, missing parts."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from lumencut import _lumencut
from lumencut.base.mends import Told
from lumencut.errors import LineWarning
from lumencut.scene.vessel import Vessel


class LineDoubt(NamedTuple):
    """A doubt about a vessel.

    Attributes
    ----------
    vessel : int
        Its id among the given vessels.
    other : int or None
        The id of the other vessel if two vessels lie side by side.
    text : Told
        The finding and the remedy.
    """

    vessel: int
    other: int | None
    text: Told


def line_doubts(vessels: Iterable[Vessel], *, parallel: bool = False) -> list[LineDoubt]:
    """Return doubts about the order of points; with `parallel` also about vessels side by side."""
    arrays = [((vessel.points, vessel.radius), vessel.name) for vessel in vessels]
    return worded(_lumencut.line_doubts(arrays, parallel))


def worded(doubts: Iterable[tuple[int, int | None, str, Any]]) -> list[LineDoubt]:
    """Return doubts of the core with their remedies in words."""
    return [LineDoubt(vessel, other, mend.after(f"{found}; ")) for vessel, other, found, mend in doubts]


def check_lines_once(vessels: Sequence[Vessel], subject: str = "vessel tree") -> None:
    """Warn of doubts about the order of points, unless that was done before.

    Warns
    -----
    LineWarning
        For each doubt about a vessel that was not checked before.
    """
    if all(vessel._line_settled for vessel in vessels):
        return
    new = [number for number, vessel in enumerate(vessels) if not vessel._line_settled]
    warn_of([doubt for doubt in line_doubts(vessels) if doubt.vessel in new], subject)
    settle(vessels)


def warn_of(doubts: Iterable[LineDoubt], subject: str) -> None:
    """Warn the caller of the package of doubts."""
    for doubt in doubts:
        warnings.warn(LineWarning(doubt.text.after(f"{subject}: ")), stacklevel=_level_outside())


def _level_outside() -> int:
    """Return the stack level of the first caller outside the package, as `warnings.warn` counts it."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "lumencut":
        level, frame = level + 1, frame.f_back
    return level


def settle(vessels: Iterable[Vessel]) -> None:
    """Remember that the lines of vessels were checked."""
    for vessel in vessels:
        vessel._line_settled = True
