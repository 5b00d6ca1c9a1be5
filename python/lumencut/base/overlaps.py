"""Rejects segments that overlap, because a label map has one number in each voxel."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError


class OverlapError(FormatError):
    """Segments that cannot be one label map; their headers are valid."""


Overlaps = Counter[tuple[int, int]]
"""The number of shared voxels for two segments, by their numbers."""


def put(
    labels: npt.NDArray[np.integer], inside: npt.NDArray[np.bool_], number: int, overlaps: Overlaps
) -> None:
    """Write the number of a segment into its voxels, and count those that another one has already."""
    for other, count in zip(*np.unique(labels[inside], return_counts=True), strict=True):
        if other:
            overlaps[int(other), number] += int(count)
    labels[inside] = number


def refuse_overlaps(subject: object, names: Mapping[int, str], overlaps: Overlaps) -> None:
    """Reject segments that share voxels.

    Raises
    ------
    OverlapError
        Names the two that share most, and how others are chosen.
    """
    if not overlaps:
        return
    (one, other), count = overlaps.most_common(1)[0]
    first, second = (f"{number} {names.get(number, '')}".strip() for number in (one, other))
    more = f" and {len(overlaps) - 1} more pairs" if len(overlaps) > 1 else ""
    found = f"segments that overlap: {first} and {second} in {count} voxels{more}"
    if one == other:
        found = f"segment {first} twice in one place"
    mend = "choose segments that do not, by segments=(1,) of read_volume or --label of lumencut trace"
    raise OverlapError(str(subject), found, "at most one segment in each voxel", mend)
