"""Lists of lists as flat arrays, and work cut into parts of bounded size."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

#: How many numbers an array of one part of the work has at most: what stays in the caches of a processor.
_MOST = 1 << 18


def ragged(
    first: npt.NDArray[np.intp], count: npt.NDArray[np.intp]
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Return all members of the ranges ``first`` to ``first + count - 1``, and whose they are.

    Returns
    -------
    owner, member : numpy.ndarray, shape (sum of count,)
        The index of the range, and the number in it.
    """
    owner = np.repeat(np.arange(len(count)), count)
    before = np.cumsum(count) - count
    return owner, first[owner] + np.arange(len(owner)) - before[owner]


def parts(sizes: npt.NDArray[np.intp], most: int = _MOST) -> Iterator[slice]:
    """Cut a list into slices whose sizes add up to at most ``most``, or hold one entry."""
    if not len(sizes):
        return
    total = np.cumsum(sizes)
    start = 0
    while start < len(sizes):
        done = total[start - 1] if start else 0
        end = max(start + 1, int(np.searchsorted(total, done + most, side="right")))
        yield slice(start, end)
        start = end
