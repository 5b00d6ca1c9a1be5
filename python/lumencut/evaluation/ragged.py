"""Lists of lists as flat arrays, and work in parts of bounded size."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

#: Number of array elements that are processed together, so that they fit into processor caches.
_MAX_PART = 1 << 18


def ragged(
    first: npt.NDArray[np.intp], count: npt.NDArray[np.intp]
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Return the integers from ``first`` to ``first + count - 1`` for each range, and their ranges.

    Returns
    -------
    owner, member : numpy.ndarray, shape (sum of count,)
        The index of the range, and the integer in the range.
    """
    owner = np.repeat(np.arange(len(count)), count)
    before = np.cumsum(count) - count
    return owner, first[owner] + np.arange(len(owner)) - before[owner]


def parts(sizes: npt.NDArray[np.intp], most: int = _MAX_PART) -> Iterator[slice]:
    """Split a list into slices whose total size is at most ``most``; a larger entry is a slice of its own."""
    if not len(sizes):
        return
    total = np.cumsum(sizes)
    start = 0
    while start < len(sizes):
        done = total[start - 1] if start else 0
        end = max(start + 1, int(np.searchsorted(total, done + most, side="right")))
        yield slice(start, end)
        start = end
