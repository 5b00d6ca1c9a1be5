"""The grid of a DICOM segmentation, from the positions of its frames, not their order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut._lumencut import dicom_directions
from lumencut.errors import FormatError

_EVEN = 0.05
"""Largest offset of places from the grid, as a share of the distance of slices, or of pixels."""
_PARALLEL = 1e-3
_ONE_PLACE = 0.01
"""Frames closer than this (mm) are at one place."""
_MOST_SLICES = 10_000
_AGAIN = "write the segmentation again"


@dataclass(frozen=True)
class SegmentFrame:
    """One frame: its number in the file, from 0, its segment (0 where its pixels are labels), its slice k."""

    number: int
    segment: int
    k: int


@dataclass(frozen=True, eq=False)
class SegmentGrid:
    """The frames on an even grid; slices without a frame are empty.

    Attributes
    ----------
    frames : sequence of SegmentFrame
        In the order of the file.
    size : tuple of 3 int
        Number of voxels along i, j, k.
    world_from_index : ndarray, shape (4, 4)
        Affine from index (i, j, k) to world (mm, LPS).
    """

    frames: Sequence[SegmentFrame]
    size: tuple[int, int, int]
    world_from_index: npt.NDArray[np.float64]


def segment_grid(subject: str, dataset: Any) -> SegmentGrid:
    """Find the grid of a segmentation.

    Parameters
    ----------
    subject : str
        Names the file in errors.
    dataset : pydicom.Dataset
        The segmentation; its pixels may be missing.

    Raises
    ------
    FormatError
        For frames that are turned against each other, or do not lie on one even grid.
    """
    groups = _Groups(subject, dataset)
    count = groups.count
    segments = [groups.segment(frame) for frame in range(count)]
    positions = np.array(
        [groups.numbers(f, "PlanePosition", "ImagePositionPatient", 3) for f in range(count)]
    )
    turns = np.array(
        [groups.numbers(f, "PlaneOrientation", "ImageOrientationPatient", 6) for f in range(count)]
    )
    if np.abs(turns - turns[0]).max() > _PARALLEL:
        raise FormatError(subject, "frames that are turned against each other", "parallel frames", _AGAIN)
    spacing = groups.numbers(0, "PixelMeasures", "PixelSpacing", 2)
    depths = positions @ np.cross(turns[0, :3], turns[0, 3:])
    first, last = int(depths.argmin()), int(depths.argmax())
    step = _step(subject, depths, groups.spacing_of_slices())
    places = (depths - depths[first]) / step
    k = np.rint(places).astype(np.int64)
    if k[last] >= _MOST_SLICES:
        raise FormatError(subject, f"a grid of {k[last] + 1} slices", f"at most {_MOST_SLICES}", _AGAIN)
    row, column = _directions(subject, turns[0], positions[last] - positions[first])
    along_k = np.cross(row, column) * step
    if k[last]:
        along_k = (positions[last] - positions[first]) / k[last]
    off = positions - positions[first] - k[:, None] * along_k
    if np.abs(off).max() > _EVEN * max(step, float(spacing.max())):
        raise FormatError(subject, "frames side by side", "frames of one straight stack", _AGAIN)
    affine = np.eye(4)
    affine[:3] = np.stack([row * spacing[1], column * spacing[0], along_k, positions[first]], axis=1)
    frames = [SegmentFrame(n, segment, int(k[n])) for n, segment in enumerate(segments)]
    return SegmentGrid(frames, (int(dataset.Columns), int(dataset.Rows), int(k[last]) + 1), affine)


def _directions(
    subject: str, cosines: npt.NDArray[np.float64], line: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    """The directions of rows and columns, as those of the slices of a scan."""
    made = dicom_directions(tuple(cosines), tuple(line))
    if made is None:
        found = f"ImageOrientationPatient {cosines.tolist()}"
        raise FormatError(subject, found, "two orthogonal unit vectors", _AGAIN)
    return np.array(made).reshape(2, 3)


def _step(subject: str, depths: npt.NDArray[np.float64], stated: float) -> float:
    """The distance of slices (mm): the stated one if all places are its multiples, else the smallest."""
    offsets = np.sort(depths) - depths.min()
    gaps = np.diff(offsets)
    gaps = gaps[gaps > _ONE_PLACE]
    if not gaps.size:
        return stated or 1.0
    least = float(gaps.min())
    # The least gap is rounded, which would add up over many slices.
    for step in (stated, float(offsets[-1] / np.rint(offsets[-1] / least))):
        if step > 0 and np.abs(offsets / step - np.rint(offsets / step)).max() <= _EVEN:
            return step
    found = f"frames {gaps.min():.4g} to {gaps.max():.4g} mm apart, of no common distance"
    raise FormatError(subject, found, "slices of one distance", "write it on the grid of its scan")


class _Groups:
    """The attributes of each frame of a segmentation, or of all together."""

    def __init__(self, subject: str, dataset: Any) -> None:
        self._subject = subject
        self._frames = list(dataset.get("PerFrameFunctionalGroupsSequence") or ())
        shared = dataset.get("SharedFunctionalGroupsSequence") or ()
        self._shared = shared[0] if shared else {}
        self.count = int(dataset.get("NumberOfFrames") or 1)
        self._is_map = dataset.get("SegmentationType") == "LABELMAP"
        if len(self._frames) != self.count:
            found = f"{len(self._frames)} places for {self.count} frames"
            raise FormatError(subject, found, "one for each", "copy the file again")

    def segment(self, frame: int) -> int:
        """The number of a frame's segment."""
        if self._is_map:
            return 0
        return int(self._of(frame, "SegmentIdentificationSequence", "ReferencedSegmentNumber"))

    def numbers(self, frame: int, group: str, keyword: str, count: int) -> npt.NDArray[np.float64]:
        """Finite numbers of a frame."""
        stated = self._of(frame, f"{group}Sequence", keyword)
        values = np.array([float(one) for one in stated or ()], np.float64)
        if len(values) != count or not np.isfinite(values).all():
            found, expected = f"frame {frame + 1} with a damaged {keyword}", f"{count} numbers"
            raise FormatError(self._subject, found, expected, _AGAIN)
        return values

    def spacing_of_slices(self) -> float:
        """The stated distance of slices (mm), or their thickness; 0 where neither is stated."""
        item = self._item(0, "PixelMeasuresSequence")
        stated = item.get("SpacingBetweenSlices") or item.get("SliceThickness") if item else None
        return abs(float(stated)) if stated else 0.0

    def _of(self, frame: int, sequence: str, keyword: str) -> Any:
        item = self._item(frame, sequence)
        value = None if item is None else item.get(keyword)
        if value is None:
            found = f"frame {frame + 1} without {keyword}"
            raise FormatError(self._subject, found, "a place and a segment for each frame", _AGAIN)
        return value

    def _item(self, frame: int, sequence: str) -> Any:
        for groups in (self._frames[frame], self._shared):
            if items := groups.get(sequence):
                return items[0]
        return None
