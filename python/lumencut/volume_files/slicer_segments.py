"""The segments that 3D Slicer describes in the header of a ``.seg.nrrd``, and the label map that they make."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError
from lumencut.volume_files.opened import decoded, printable
from lumencut.volume_files.rescale import slabs
from lumencut.volume_files.room import require_memory

_FIELD = re.compile(r"Segment(\d{1,6})_(ID|Name|LabelValue|Layer):=(.*)")
_MOST_LAYERS = 1000
_LARGEST_NUMBER = 65535


@dataclass(frozen=True)
class Segment:
    """One segment: its number in the label map, its name, and the layer and value that its voxels have."""

    number: int
    name: str
    layer: int
    value: int

    def __str__(self) -> str:
        return f"{self.number} {self.name}"


def segments_of(lines: Iterable[bytes], layers: int) -> tuple[Segment, ...]:
    """Return the segments that a header describes.

    A segment has the number of its label, unless several segments share one: then segments count from 1.

    Parameters
    ----------
    lines : iterable of bytes
        The lines of the header.
    layers : int
        How many values each voxel has. Files of before 2020 state neither layers nor labels: their segments
        have a layer each.
    """
    stated: dict[int, dict[str, str]] = {}
    for line in lines:
        if found := _FIELD.fullmatch(decoded(line).strip()):
            stated.setdefault(int(found[1]), {})[found[2]] = found[3].strip()
    segments = []
    for place, (_, fields) in enumerate(sorted(stated.items())):
        layer = _whole(fields.get("Layer"), place if layers > 1 else 0)
        value = _whole(fields.get("LabelValue"), 1)
        name = printable(fields.get("Name", "")) or f"segment {place + 1}"
        segments.append(Segment(value, name, layer, value))
    if len({segment.number for segment in segments}) < len(segments):
        return tuple(replace(segment, number=n) for n, segment in enumerate(segments, 1))
    return tuple(segments)


def _whole(text: str | None, otherwise: int) -> int:
    return int(text) if text is not None and re.fullmatch(r"\d{1,9}", text) else otherwise


def chosen_segments(
    path: Path, segments: Sequence[Segment], layers: int, numbers: Collection[int] | None
) -> tuple[Segment, ...]:
    """Return the segments that are read: those of some numbers, or all.

    Raises
    ------
    FormatError
        For a number of no segment, and for segments that cannot be: in a layer that is not there, or of value 0.
    """
    known = ", ".join(map(str, segments)) or "none"
    for number in numbers or ():
        if number not in {segment.number for segment in segments}:
            raise FormatError(str(path), f"no segment {number}", f"segments of the file: {known}")
    for segment in segments:
        if segment.layer >= layers or layers > _MOST_LAYERS:
            found = f"segment {segment} in layer {segment.layer} of {layers}"
            raise FormatError(str(path), found, "a layer of the file", "save the segmentation again")
        if not 0 < segment.number <= _LARGEST_NUMBER:
            found = f"segment {segment.name} with the label {segment.number}"
            raise FormatError(str(path), found, f"labels from 1 to {_LARGEST_NUMBER}", "save it again")
    return tuple(one for one in segments if numbers is None or one.number in numbers)


def label_map(
    path: Path, layers: npt.NDArray[Any], segments: Sequence[Segment], *, has_others: bool
) -> npt.NDArray[Any]:
    """Return the numbers of segments as labels [k, j, i].

    Parameters
    ----------
    path : Path
        Names the file in errors.
    layers : ndarray, shape (nk, nj, ni, n)
        The values of each layer.
    segments : sequence of Segment
        Those that are read.
    has_others : bool
        Keep values of the only layer that no segment has.

    Raises
    ------
    FormatError
        For segments that overlap.
    """
    most = max((segment.number for segment in segments), default=0)
    dtype = np.dtype(np.uint8 if most <= np.iinfo(np.uint8).max else np.uint16)
    dtype = layers.dtype if has_others else dtype
    require_memory(path, layers[..., 0].size * dtype.itemsize)
    labels = layers[..., 0].copy() if has_others else np.zeros(layers.shape[:3], dtype)
    if has_others:
        return labels
    overlaps: Counter[tuple[int, int]] = Counter()
    for slab, target in zip(slabs(layers), slabs(labels), strict=True):
        _place(slab, target, segments, overlaps)
    if overlaps:
        raise _overlapping(path, segments, overlaps)
    return labels


def _place(
    layers: npt.NDArray[Any],
    labels: npt.NDArray[Any],
    segments: Sequence[Segment],
    overlaps: Counter[tuple[int, int]],
) -> None:
    for segment in segments:
        inside = layers[..., segment.layer] == segment.value
        for other, count in zip(*np.unique(labels[inside], return_counts=True), strict=True):
            if other:
                overlaps[int(other), segment.number] += int(count)
        labels[inside] = segment.number


def _overlapping(
    path: Path, segments: Sequence[Segment], overlaps: Counter[tuple[int, int]]
) -> FormatError:
    named = {segment.number: segment for segment in segments}
    (one, other), count = overlaps.most_common(1)[0]
    more = f" and {len(overlaps) - 1} more pairs" if len(overlaps) > 1 else ""
    found = f"segments that overlap: {named[one]} and {named[other]} in {count} voxels{more}"
    mend = "choose segments that do not, by segments=(1,) of read_volume or --label of lumencut trace"
    return FormatError(str(path), found, "at most one segment in each voxel", mend)
