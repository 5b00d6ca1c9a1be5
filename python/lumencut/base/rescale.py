"""Stored values → values in the volume's unit, in an integer type wherever that is exact."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

_INTEGERS = tuple(np.dtype(name) for name in ("int16", "uint16", "int32", "uint32", "int64"))
_SLAB = 1 << 18


def is_integral(slope: float, intercept: float) -> bool:
    """Return whether integers stay integers under slope and intercept."""
    return float(slope).is_integer() and float(intercept).is_integer()


def holding(low: int, high: int, first: np.dtype[Any] | None = None) -> np.dtype[Any] | None:
    """Return the first integer type that holds every value from low to high; None if none does."""
    for candidate in (*((first,) if first is not None else ()), *_INTEGERS):
        limits = np.iinfo(candidate)
        if limits.min <= low and high <= limits.max:
            dtype: np.dtype[Any] = candidate.newbyteorder("=")
            return dtype
    return None


def rescaled(
    stored: npt.NDArray[Any],
    slope: float,
    intercept: float,
    allow: Callable[[int], None] = lambda count: None,
) -> npt.NDArray[Any]:
    """Return slope · stored + intercept; `allow` may reject the bytes that the result takes.

    Integers under an integral slope and intercept stay integers (their own type if it holds the result);
    64-bit floats stay so; everything else becomes float32.
    """
    if slope == 1 and intercept == 0:
        return stored
    if stored.dtype.kind in "iu" and is_integral(slope, intercept):
        ends = sorted(int(end) * int(slope) + int(intercept) for end in (stored.min(), stored.max()))
        dtype = holding(ends[0], ends[1], stored.dtype)
        if dtype is not None and int(stored.max()) < 2**62:
            allow(stored.size * dtype.itemsize)
            return _slab_wise(stored, np.dtype(np.int64), int(slope), int(intercept), dtype)
    result = np.dtype(np.float64 if stored.dtype == np.float64 else np.float32)
    allow(stored.size * result.itemsize)
    return _slab_wise(stored, np.dtype(np.float64), float(slope), float(intercept), result)


def slabs(array: npt.NDArray[Any]) -> Iterator[npt.NDArray[Any]]:
    """Yield views on several slices of the first axis: there may be a million slices of one voxel."""
    step = max(_SLAB // max(array[:1].size, 1), 1)
    for start in range(0, len(array), step):
        yield array[start : start + step]


def _slab_wise(
    stored: npt.NDArray[Any], between: np.dtype[Any], slope: float, intercept: float, result: np.dtype[Any]
) -> npt.NDArray[Any]:
    """Rescale slab by slab, so that the wide type never exists for the complete volume."""
    values = np.empty(stored.shape, result)
    with np.errstate(over="ignore", invalid="ignore"):
        for slab, target in zip(slabs(stored), slabs(values), strict=True):
            target[...] = slab.astype(between) * between.type(slope) + between.type(intercept)
    return values
