"""A mask on the grid of its scan; it may cover only a part of the voxels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.memory import require_memory
from lumencut.errors import VolumeError
from lumencut.scene.patients import Patient
from lumencut.scene.volume import Volume

_ANOTHER = "take the segmentation that was made on this scan, or write it on the grid of this scan"


class Grid(Protocol):
    """The grid of a volume, or of a volume file."""

    @property
    def size(self) -> tuple[int, int, int]:
        """Number of voxels along i, j, k."""

    @property
    def world_from_index(self) -> npt.NDArray[np.float64]:
        """Affine (4, 4) from index to world (mm, LPS)."""

    @property
    def frame_of_reference(self) -> str:
        """The DICOM frame of reference UID; empty if none is stated."""


@dataclass(frozen=True)
class MaskPlace:
    """Where the voxels of a mask lie among those of its scan.

    Attributes
    ----------
    axes : tuple of 3 int
        The axis of the scan for each axis i, j, k of the mask.
    forward : tuple of 3 bool
        For each axis of the scan, whether the mask runs in the same direction.
    low : tuple of 3 int
        The smallest index that the mask has along each axis of the scan.
    note : str
        The note on a mask that covers a part of the scan.
    """

    axes: tuple[int, int, int]
    forward: tuple[bool, bool, bool]
    low: tuple[int, int, int]
    note: str


def on_grid_of(mask: Volume, volume: Grid) -> Volume:
    """Return a mask on the grid of its scan.

    Parameters
    ----------
    mask : Volume
        The mask.
    volume : Volume, or what has its grid
        The scan; voxels outside the mask become 0.

    Returns
    -------
    Volume
        The mask itself if it has the grid of the scan and is not a segmentation.

    Raises
    ------
    VolumeError
        As :func:`place_within` does.
    FormatError
        If the memory is too small.
    """
    place = place_within(mask, volume, always=mask._is_segmentation)
    return mask if place is None else placed(mask, volume, place)


def placed(mask: Volume, volume: Grid, place: MaskPlace) -> Volume:
    """Return a mask on the grid of its scan, at its position; all other voxels are 0."""
    require_memory("mask", int(np.prod(volume.size)) * mask.dtype.itemsize)
    # Arrays have their axes in the order k, j, i.
    turned = mask.array.transpose([2 - place.axes.index(axis) for axis in (2, 1, 0)])
    turned = turned[tuple(slice(None, None, 1 if place.forward[axis] else -1) for axis in (2, 1, 0))]
    whole = np.zeros(volume.size[::-1], turned.dtype)
    starts = zip(reversed(place.low), turned.shape, strict=True)
    whole[tuple(slice(start, start + length) for start, length in starts)] = turned
    made = Volume(whole, world_from_index=volume.world_from_index)
    made._frame_of_reference, made._is_segmentation = mask.frame_of_reference, mask._is_segmentation
    made._label_names = mask._label_names
    return made


def other_patient(mask: Patient, scan: Patient) -> str | None:
    """Return a sentence if mask and scan have different patients; None if not, or if unknown."""
    return f"the mask is of {mask}, the scan of {scan}" if mask.differs_from(scan) else None


def place_within(mask: Grid, volume: Grid, *, always: bool) -> MaskPlace | None:
    """Find the voxels of a mask among those of its scan.

    Parameters
    ----------
    mask, volume : Volume or VolumeFile
        The mask and the scan.
    always : bool
        Whether to find them even if the mask has the grid of the scan.

    Returns
    -------
    MaskPlace or None
        None if the mask has the grid of the scan, whose axes may be stored in another order or direction.

    Raises
    ------
    VolumeError
        If both state different frames of reference, or if voxels of the mask are not voxels of the scan.
    """
    stated, expected = mask.frame_of_reference, volume.frame_of_reference
    if stated and expected and stated != expected:
        found = f"a segmentation in the frame of reference {stated}"
        raise VolumeError("mask", found, f"that of the volume, {expected}", _ANOTHER)
    found_place = _lumencut.place_mask(_parts(mask), _parts(volume), always)
    return None if found_place is None else MaskPlace(*map(_tupled, found_place))


def _parts(grid: Grid) -> Any:
    return list(grid.size), grid.world_from_index[:3].tolist()


def _tupled(part: Any) -> Any:
    return tuple(part) if isinstance(part, list) else part
