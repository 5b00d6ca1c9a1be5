"""The slices of a stack → one array of values in the volume's unit, holes interpolated."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.foreign_errors import Progress, refusing
from lumencut.base.memory import require_memory
from lumencut.base.rescale import holding, is_integral, rescaled
from lumencut.dicom.reading.pixels import PixelReader
from lumencut.dicom.reading.stack import Stack
from lumencut.scene.volume_file import Filled, unfollowed

_INT32 = np.iinfo(np.int32)


def load(stack: Stack, notes: list[str], progress: Progress, filled: Filled) -> npt.NDArray[Any]:
    """Read slice after slice, and fill in missing ones."""
    places = np.array([one.place for one in stack.slices])
    whole = np.flatnonzero(places % 1 == 0)
    if len(whole) == len(places):
        rows = places.astype(np.int64)
        followed = filled if len(rows) == rows[-1] + 1 else unfollowed
        volume = measured = _read(stack, rows, notes, progress, followed)
    else:
        rows = np.arange(len(places))
        measured = _read(stack, rows, notes, progress, unfollowed)
        volume = np.empty((stack.size[2], *measured.shape[1:]), measured.dtype)
        volume[places[whole].astype(np.int64)] = measured[whole]
    for fill in stack.fills:
        volume[fill.k] = _mixed(measured[rows[fill.before]], measured[rows[fill.after]], fill.part)
    return volume


def settled_type(stack: Stack) -> np.dtype[Any] | None:
    """The type of the values; None if only the values themselves decide."""
    if not _is_exact(stack) or all(s.image.pixel_keyword != "PixelData" for s in stack.slices):
        return np.dtype(np.float32)
    limits = np.iinfo(np.int16)
    ranges = {(_stored_range(s.image.header), s.scaling) for s in stack.slices}
    ends = [end * slope + intercept for stored, (slope, intercept) in ranges for end in stored]
    is_narrow = limits.min <= min(ends) and max(ends) <= limits.max
    return np.dtype(np.int16) if is_narrow else None


def memory_needed(stack: Stack) -> int:
    """Return the smallest size of the values in bytes, including measured slices of a resampled stack."""
    settled = settled_type(stack)
    ni, nj, nk = stack.size
    is_resampled = any(one.place % 1 for one in stack.slices)
    slices = nk + (len(stack.slices) if is_resampled else 0)
    return ni * nj * slices * (np.dtype(np.int16) if settled is None else settled).itemsize


def _stored_range(header: Any) -> tuple[int, int]:
    """The smallest and the largest value that the stored bits can hold."""
    bits = int(header.get("BitsStored") or header.BitsAllocated)
    if header.get("PixelRepresentation"):
        return -(1 << bits - 1), (1 << bits - 1) - 1
    return 0, (1 << bits) - 1


def _is_exact(stack: Stack) -> bool:
    return all(is_integral(*s.scaling) for s in stack.slices)


def _read(
    stack: Stack, places: npt.NDArray[np.int64], notes: list[str], progress: Progress, filled: Filled
) -> npt.NDArray[Any]:
    """Read each slice to its place, in the narrowest type that has held all values so far."""
    exact = _is_exact(stack)
    ni, nj, _ = stack.size
    volume: npt.NDArray[Any] | None = None
    with PixelReader(stack.slices, notes) as reader:
        for number, (one, place) in enumerate(zip(stack.slices, places, strict=True)):
            with refusing(one.image.source, "DICOM", notes):
                values = in_unit(reader.next(), *one.scaling)
            if volume is None:
                start = np.int16 if exact and values.dtype.kind in "iu" else np.float32
                volume = np.empty((int(places[-1]) + 1, nj, ni), start)
            volume = _widened(volume, places[:number], values, one.image.source)
            volume[place] = values
            filled(volume, number + 1)
            progress(number + 1, len(stack.slices))
    assert volume is not None, "a series has at least one slice"
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
    volume: npt.NDArray[Any], filled: npt.NDArray[np.int64], values: npt.NDArray[Any], subject: object
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
    require_memory(subject, volume.size * wide.itemsize)
    wider = np.empty(volume.shape, wide)
    for place in filled:
        wider[place] = volume[place]
    return wider


def _mixed(before: npt.NDArray[Any], after: npt.NDArray[Any], part: float) -> npt.NDArray[Any]:
    mixed = (1 - part) * before.astype(np.float64) + part * after
    return np.asarray(np.rint(mixed) if before.dtype.kind in "iu" else mixed)
