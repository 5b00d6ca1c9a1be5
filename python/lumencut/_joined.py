"""Several vessels that meet, as one line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut.errors import VesselTreeError

#: Points (n, 3) and, where known, radii (n,).
Line: TypeAlias = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None]

#: Ends no farther apart than this meet (mm): what files lose by rounding, and far less than any lumen.
MEETING = 0.1


def joined(lines: Sequence[Line], words: Sequence[str]) -> Line:
    """Return the lines as one, each in the direction in which it meets the one before.

    Parameters
    ----------
    lines : sequence of (points, radius)
        One or more lines in their order; a point that two of them share is taken once, from the former.
    words : sequence of str
        How an error calls each of them.

    Raises
    ------
    VesselTreeError
        For neighbours whose ends are farther apart than `MEETING`.
    """
    parts = [_first(lines)]
    for n, line in enumerate(lines[1:], 1):
        end = parts[-1][0][-1]
        part = min((line, _turned(line)), key=lambda one: float(np.linalg.norm(one[0][0] - end)))
        gap = float(np.linalg.norm(part[0][0] - end))
        if not gap <= MEETING:
            found = f"a gap of {gap:.4g} mm between {words[n - 1]} and {words[n]}"
            expected = f"vessels in their order along the path, with ends at most {MEETING} mm apart"
            raise VesselTreeError("path through the tree", found, expected)
        parts.append((part[0][1:], None if part[1] is None else part[1][1:]))
    points = np.concatenate([part[0] for part in parts])
    radii = [part[1] for part in parts if part[1] is not None]
    return points, np.concatenate(radii) if len(radii) == len(parts) else None


def _first(lines: Sequence[Line]) -> Line:
    """The first line, towards the second one."""
    line = lines[0]
    if len(lines) == 1:
        return line
    ends = lines[1][0][[0, -1]]
    return min((line, _turned(line)), key=lambda one: float(np.linalg.norm(ends - one[0][-1], axis=1).min()))


def _turned(line: Line) -> Line:
    points, radius = line
    return points[::-1], None if radius is None else radius[::-1]
