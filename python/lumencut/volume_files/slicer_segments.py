"""The segments that 3D Slicer describes in the header of a ``.seg.nrrd``, and their label map."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError
from lumencut.volume_files.opened import Filled, Progress, VolumeFile, decoded, printable, unfollowed
from lumencut.volume_files.overlaps import Overlaps, put, refuse_overlaps
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


def has_segments(lines: Iterable[bytes]) -> bool:
    """Return whether a header describes segments."""
    return any(_FIELD.fullmatch(decoded(line).strip()) for line in lines)


def no_segmentation(path: Path) -> FormatError:
    """Return the error for segments of a file without segments."""
    expected = "a segmentation (DICOM SEG, or .seg.nrrd of 3D Slicer), to choose segments"
    return FormatError(str(path), "no segmentation", expected, "leave out segments")


def segmentation_file(
    file: VolumeFile,
    segments: Sequence[Segment],
    stored: tuple[int, int | None],
    numbers: Collection[int] | None,
) -> VolumeFile:
    """Return a file as the label map that its segments make.

    Parameters
    ----------
    file : VolumeFile
        The file, which loads the stored values.
    segments : sequence of Segment
        The segments that it describes.
    stored : int, int or None
        The number of layers, and their axis in the stored array.
    numbers : collection of int, optional
        The numbers of the segments that are read; by default all.
    """
    layers, along = stored
    wanted = chosen_segments(file.path, segments, layers, numbers)
    is_as_stored = layers == 1 and numbers is None and all(one.number == one.value for one in segments)
    dtype = file.dtype if is_as_stored else label_type(segments)

    def load(progress: Progress, filled: Filled) -> npt.NDArray[Any]:
        values = file.load(progress, filled if is_as_stored else unfollowed)
        if is_as_stored:
            return values
        by_layer = values[..., None] if along is None else np.moveaxis(values, along, -1)
        return label_map(file.path, by_layer, wanted, dtype)

    names = {segment.number: segment.name for segment in segments}
    details = {
        "segmentation": "1 layer" if layers == 1 else f"{layers} layers",
        "segments": "; ".join(map(str, segments)),
    }
    if any(segment.number != segment.value for segment in segments):
        file.remarks.append("several segments share a label: segments are numbered from 1")
    return replace(
        file, load=load, details=details, settled_type=dtype.newbyteorder("="), label_names=names,
        is_segmentation=True,
    )  # fmt: skip


def segments_of(lines: Iterable[bytes], layers: int) -> tuple[Segment, ...]:
    """Return the segments that a header describes.

    A segment has the number of its label, unless several segments share one: then segments count from 1.

    Parameters
    ----------
    lines : iterable of bytes
        The lines of the header.
    layers : int
        Number of values of each voxel. Files of before 2020 state neither layers nor labels: their segments
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
        For a number of no segment, a layer that the file does not have, and the label 0.
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
    path: Path, layers: npt.NDArray[Any], segments: Sequence[Segment], dtype: np.dtype[Any]
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
    dtype : numpy.dtype
        The type of the labels.

    Raises
    ------
    FormatError
        For segments that overlap.
    """
    require_memory(path, layers[..., 0].size * dtype.itemsize)
    labels, overlaps = np.zeros(layers.shape[:3], dtype), Overlaps()
    for slice_, target in zip(layers, labels, strict=True):
        for segment in segments:
            put(target, slice_[..., segment.layer] == segment.value, segment.number, overlaps)
    refuse_overlaps(path, {segment.number: segment.name for segment in segments}, overlaps)
    return labels


def label_type(segments: Sequence[Segment]) -> np.dtype[Any]:
    """Return the type that holds the numbers of segments."""
    most = max((segment.number for segment in segments), default=0)
    return np.dtype(np.uint8 if most <= np.iinfo(np.uint8).max else np.uint16)
