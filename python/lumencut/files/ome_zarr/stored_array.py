"""One level of an OME-Zarr image as voxels [k, j, i]."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from lumencut.base.foreign_errors import refusing
from lumencut.errors import FormatError
from lumencut.files.ome_zarr.stores import answering
from lumencut.scene.chunk_cache import Triple

if TYPE_CHECKING:
    import zarr


class StoredArray:
    """The voxels of one channel and time point of a level.

    Parameters
    ----------
    array : zarr.Array
        The stored array.
    space : tuple of 3 int
        Numbers of its axes x, y and z.
    picked : sequence of int
        The index along every axis; that of a spatial axis is not used.
    subject : str
        Names the array in errors.

    Raises
    ------
    FormatError
        For voxels that are not integers or floats.
    """

    def __init__(self, array: zarr.Array[Any], space: Triple, picked: Sequence[int], subject: str) -> None:
        self._array, self._space, self._picked, self._subject = array, space, tuple(picked), subject
        stored = np.dtype(array.dtype)
        if stored.kind not in "iufb":
            raise FormatError(subject, f"voxels of type {stored}", "integers or floats")
        self.dtype: np.dtype[Any] = _read_as(stored)
        self.shape: Triple = self._of_space(array.shape)
        self.chunks: Triple = self._of_space(array.chunks)

    @property
    def stored(self) -> tuple[int, int] | None:
        """Number of stored chunks, and of all; None if they are not listed. Missing ones have one value."""
        try:
            return int(self._array.nchunks_initialized), int(self._array.nchunks)
        except (NotImplementedError, OSError):
            return None

    def read(self, low: Triple, high: Triple) -> npt.NDArray[Any]:
        """Return the voxels [k, j, i] from `low` to before `high`."""
        selection: list[int | slice] = list(self._picked)
        for axis, start, end in zip(self._space[::-1], low, high, strict=True):
            selection[axis] = slice(start, end)
        chunk = " × ".join(f"{a} to {b - 1}" for a, b in zip(low, high, strict=True))
        subject = f"{self._subject}, voxels {chunk}"
        with answering(subject), refusing(subject, "OME-Zarr", []):
            found = np.asarray(self._array[tuple(selection)])
        # The remaining axes keep their order in the array.
        order = np.argsort(np.argsort(self._space[::-1]))
        return np.ascontiguousarray(found.transpose(order), self.dtype)

    def _of_space(self, of_axes: Sequence[int]) -> Triple:
        """Return the numbers of the axes z, y and x."""
        x, y, z = self._space
        return of_axes[z], of_axes[y], of_axes[x]


def _read_as(stored: np.dtype[Any]) -> np.dtype[Any]:
    """Return the type of the voxels in memory, as `Volume` has it."""
    if stored.kind == "b":
        return np.dtype(np.uint8)
    if stored.kind == "f" and stored.itemsize == np.dtype(np.float16).itemsize:
        return np.dtype(np.float32)
    return stored.newbyteorder("=")
