"""A segmentation of DICOM on the grid of its scan, of which it may hold a part of the slices alone."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import numpy.typing as npt

from lumencut.dicom_objects.patients import Patient
from lumencut.errors import VolumeError
from lumencut.volume import Volume

_OFF_GRID = 0.1
"""Voxels may lie beside those of the scan by this part of a voxel."""
_ANOTHER = "take the segmentation that was made on this scan, or write it on the grid of this scan"


class Grid(Protocol):
    """What a volume, or a file of one, tells of its grid."""

    @property
    def size(self) -> tuple[int, int, int]:
        """Number of voxels along i, j, k."""

    @property
    def world_from_index(self) -> npt.NDArray[np.float64]:
        """Affine (4, 4) from index to world (mm, LPS)."""

    @property
    def frame_of_reference(self) -> str:
        """The UID of the space of DICOM; empty where none is stated."""


def on_grid_of(mask: Volume, volume: Grid) -> Volume:
    """Return a mask on the grid of its scan; one that is no segmentation of DICOM is returned as it is.

    Parameters
    ----------
    mask : Volume
        The mask.
    volume : Volume, or what has its grid
        The scan; its voxels beside the mask become 0.

    Raises
    ------
    VolumeError
        As :func:`place_within` does.
    """
    if not mask._is_segmentation:
        return mask
    axes, signs, low = place_within(mask, volume)
    # Arrays have their axes in the order k, j, i.
    turned = mask.array.transpose([2 - axes.index(axis) for axis in (2, 1, 0)])
    turned = turned[tuple(slice(None, None, signs[axis]) for axis in (2, 1, 0))]
    whole = np.zeros(volume.size[::-1], turned.dtype)
    starts = zip(reversed(low), turned.shape, strict=True)
    whole[tuple(slice(start, start + length) for start, length in starts)] = turned
    placed = Volume(whole, world_from_index=volume.world_from_index)
    placed._frame_of_reference, placed._is_segmentation = mask.frame_of_reference, True
    placed._label_names = mask._label_names
    return placed


def other_patient(mask: Patient, scan: Patient) -> str | None:
    """Say in a sentence that a mask is of another patient than its scan; None where both do not say so."""
    return f"the mask is of {mask}, the scan of {scan}" if mask.differs_from(scan) else None


def place_within(mask: Grid, volume: Grid) -> tuple[list[int], list[int], list[int]]:
    """Find the voxels of a mask among those of its scan.

    Parameters
    ----------
    mask, volume : Volume or VolumeFile
        The mask and the scan.

    Returns
    -------
    axes : list of 3 int
        For each axis i, j, k of the mask that of the scan.
    signs : list of 3 int
        For each axis of the scan 1, or -1 where that of the mask runs against it.
    low : list of 3 int
        The least index of the mask along each axis of the scan.

    Raises
    ------
    VolumeError
        Where the frames of reference of both are stated and are not the same, and where voxels of the mask
        are none of the scan.
    """
    stated, expected = mask.frame_of_reference, volume.frame_of_reference
    if stated and expected and stated != expected:
        found = f"a segmentation in the frame of reference {stated}"
        raise VolumeError("mask", found, f"that of the volume, {expected}", _ANOTHER)
    step = np.linalg.inv(volume.world_from_index) @ mask.world_from_index
    whole = np.rint(step)
    drift = np.abs(step - whole)
    drift[:3, :3] *= np.maximum(np.asarray(mask.size) - 1, 1)
    turns = whole[:3, :3].astype(np.int64)
    if drift[:3].max() > _OFF_GRID or not np.array_equal(np.abs(turns) @ np.abs(turns).T, np.eye(3)):
        found = f"a segmentation whose voxels of {_millimetres(mask)} mm are none of the volume"
        raise VolumeError("mask", found, f"voxels of the volume, {_millimetres(volume)} mm", _ANOTHER)
    axes = [int(np.abs(turns[:, axis]).argmax()) for axis in range(3)]
    signs = [int(turns[axis].sum()) for axis in range(3)]
    lengths = [mask.size[axes.index(axis)] for axis in range(3)]
    first = whole[:3, 3].astype(np.int64).tolist()
    low = [f if sign > 0 else f - n + 1 for f, sign, n in zip(first, signs, lengths, strict=True)]
    ends = [start + length for start, length in zip(low, lengths, strict=True)]
    if min(low) < 0 or any(end > most for end, most in zip(ends, volume.size, strict=True)):
        found = f"a segmentation of {_times(mask)} voxels that reaches beyond the volume"
        raise VolumeError("mask", found, f"voxels among the {_times(volume)} of the volume", _ANOTHER)
    return axes, signs, low


def _times(grid: Grid) -> str:
    return " × ".join(map(str, grid.size))


def _millimetres(grid: Grid) -> str:
    return " × ".join(f"{length:.4g}" for length in np.linalg.norm(grid.world_from_index[:3, :3], axis=0))
