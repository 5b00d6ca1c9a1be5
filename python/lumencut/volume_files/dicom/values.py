"""The slices of a stack → one array of values in the volume's unit, holes interpolated."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.volume_files.dicom.geometry import Stack
from lumencut.volume_files.dicom.pixels import PixelReader
from lumencut.volume_files.opened import Progress, refusing
from lumencut.volume_files.rescale import holding, is_integral, rescaled

_INT32 = np.iinfo(np.int32)


def load(stack: Stack, notes: list[str], progress: Progress) -> npt.NDArray[Any]:
    """Read slice after slice into the narrowest type that has held all values so far."""
    exact = all(is_integral(*s.scaling) for s in stack.slices)
    ni, nj, nk = stack.size
    volume: npt.NDArray[Any] | None = None
    with PixelReader(stack.slices, notes) as reader:
        for number, (one, place) in enumerate(zip(stack.slices, stack.places, strict=True)):
            with refusing(one.image.source, "DICOM", notes):
                values = in_unit(reader.next(), *one.scaling)
            if volume is None:
                start = np.int16 if exact and values.dtype.kind in "iu" else np.float32
                volume = np.empty((nk, nj, ni), start)
            volume = _widened(volume, stack.places[:number], values)
            volume[place] = values
            progress(number + 1, len(stack.slices))
    assert volume is not None, "a series has at least one slice"
    _interpolate(volume, stack.places)
    return volume


def in_unit(stored: npt.NDArray[Any], slope: float, intercept: float) -> npt.NDArray[Any]:
    """Give slope · stored + intercept of one slice, in integers wherever that is exact."""
    if (slope, intercept) == (1.0, 0.0):
        return stored
    if stored.dtype.kind in "iu" and stored.dtype.itemsize <= 2 and is_integral(slope, intercept):
        reach = max(abs(int(stored.min())), abs(int(stored.max()))) * abs(int(slope)) + abs(int(intercept))
        if reach <= _INT32.max:
            return np.asarray(stored.astype(np.int32) * np.int32(slope) + np.int32(intercept))
    return np.asarray(rescaled(stored[None], slope, intercept)[0])


def _widened(
    volume: npt.NDArray[Any], filled: npt.NDArray[np.int64], values: npt.NDArray[Any]
) -> npt.NDArray[Any]:
    """The volume, of a wider type if it cannot hold the values exactly; the filled slices are kept."""
    if volume.dtype.kind == "f" or values.dtype.kind == "f":
        wide = np.dtype(np.float32)
    else:
        limits = np.iinfo(volume.dtype)
        low, high = int(values.min()), int(values.max())
        if limits.min <= low and high <= limits.max:
            return volume
        done = [volume[place] for place in filled]
        ends = (min(int(s.min()) for s in done), max(int(s.max()) for s in done)) if done else (low, high)
        wide = holding(min(low, ends[0]), max(high, ends[1])) or np.dtype(np.float32)
    if wide == volume.dtype:
        return volume
    wider = np.empty(volume.shape, wide)
    for place in filled:
        wider[place] = volume[place]
    return wider


def _interpolate(volume: npt.NDArray[Any], places: npt.NDArray[np.int64]) -> None:
    """Fill the slices between neighbouring places linearly, rounded to the nearest value in integers."""
    for before, after in itertools.pairwise(places):
        for k in range(before + 1, after):
            part = (k - before) / (after - before)
            mixed = (1 - part) * volume[before].astype(np.float64) + part * volume[after]
            volume[k] = np.rint(mixed) if volume.dtype.kind in "iu" else mixed
