"""Volumes that may be larger than memory: one scan at several resolutions, of which only parts are read."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.memory import in_words
from lumencut.errors import VolumeError
from lumencut.scene.chunk_cache import ChunkCache, ChunkedArray, Triple
from lumencut.scene.scan_details import ScanDetails
from lumencut.scene.study import Origin
from lumencut.scene.volume import Volume

#: Bytes of the level from which windows are found: 256³ voxels of 16 bits.
_MOST_OVERVIEW = 40_000_000
#: Voxels beyond the outermost sampled positions: one for interpolation and one for gradients.
_RIM = 2


@dataclass(frozen=True, eq=False)
class PyramidLevel:
    """One resolution of a scan.

    Attributes
    ----------
    size : tuple of 3 int
        Number of voxels along i, j, k.
    world_from_index : ndarray, shape (4, 4)
        Affine from index (i, j, k) to world (mm, LPS).
    array : ChunkedArray
        Its stored voxels [k, j, i].
    """

    size: Triple
    world_from_index: npt.NDArray[np.float64]
    array: ChunkedArray

    @property
    def spacing(self) -> npt.NDArray[np.float64]:
        """Distance between neighbouring voxels along i, j, k (mm), shape (3,)."""
        return np.asarray(np.linalg.norm(self.world_from_index[:3, :3], axis=0), np.float64)

    @property
    def bytes(self) -> int:
        """Memory of all its voxels (bytes)."""
        ni, nj, nk = self.size
        return ni * nj * nk * self.array.dtype.itemsize


class VolumePyramid(Volume):
    """A scan at several resolutions, of which functions read only the parts that they need.

    It is a :class:`Volume`: its array, size and spacing are those of the finest level that takes at most
    half of the memory. Views, sections, reformations and measurements read only a part: of the level that
    fits the spacing of their pixels, or of a coarser one if that does not fit into the memory. Other
    functions read the array. A pickle holds the array alone.

    Parameters
    ----------
    levels : sequence of PyramidLevel
        The levels, the finest first.
    memory : int
        Most bytes of voxels in memory.
    states_spacing, states_orientation : bool
        As for :class:`Volume`.

    Raises
    ------
    VolumeError
        If not even the coarsest level fits into the memory.
    """

    def __init__(
        self,
        levels: Sequence[PyramidLevel],
        memory: int,
        *,
        states_spacing: bool = True,
        states_orientation: bool = False,
    ) -> None:
        self._levels, self._memory = tuple(levels), memory
        self._states_spacing, self._states_orientation = states_spacing, states_orientation
        fitting = [n for n, level in enumerate(self._levels) if level.bytes <= memory // 2]
        if not fitting:
            needed = 2 * self._levels[-1].bytes
            found = f"{in_words(memory)}, and a coarsest level of {in_words(self._levels[-1].bytes)}"
            raise VolumeError("memory", found, f"at least {in_words(needed)}", f"set memory={needed}")
        self._whole_level = fitting[0]
        self._scan = _scan_of(fitting[0])
        self._world_from_index = self._levels[fitting[0]].world_from_index
        self._cache = ChunkCache([level.array for level in self._levels])
        self._part: tuple[int, Triple, Triple, Volume] | None = None

    @property
    def levels(self) -> tuple[PyramidLevel, ...]:
        """The levels, the finest first."""
        return self._levels

    @property
    def memory(self) -> int:
        """Most bytes of voxels in memory."""
        return self._memory

    @property
    def whole_level(self) -> int:
        """Number of the level that :attr:`array` holds."""
        return self._whole_level

    @property
    def bytes_read(self) -> int:
        """Bytes of voxels that were read until now, after decoding."""
        return self._cache.bytes_read

    @property
    def array(self) -> npt.NDArray[Any]:
        """The voxels of the level :attr:`whole_level`, shape (nk, nj, ni), read on first use."""
        return self._whole

    @functools.cached_property
    def _whole(self) -> npt.NDArray[Any]:
        ni, nj, nk = self.size
        return self._read(self._whole_level, (0, 0, 0), (nk, nj, ni))

    @property
    def size(self) -> Triple:
        """Number of voxels along i, j, k."""
        return self._levels[self._whole_level].size

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the voxels."""
        return self._levels[0].array.dtype

    def __reduce_ex__(self, protocol: Any) -> Any:
        volume = Volume(
            self.array,
            world_from_index=self.world_from_index,
            states_spacing=self._states_spacing,
            states_orientation=self._states_orientation,
        )
        return volume.__reduce_ex__(protocol)

    @functools.cached_property
    def _origin(self) -> Origin:
        """The origin of objects made from the volume: the coarsest level identifies it."""
        ni, nj, nk = self._levels[-1].size
        return self._volume(len(self._levels) - 1, (0, 0, 0), (nk, nj, ni))._origin

    def level_for(self, spacing: float | None) -> int:
        """Return the coarsest level whose voxels are no larger than a spacing (mm); the finest if none is."""
        if spacing is None:
            return 0
        fine = [n for n, level in enumerate(self._levels) if level.spacing.max() <= spacing * (1 + 1e-6)]
        return max(fine, default=0)

    def part(self, points: npt.ArrayLike, margin: float = 0.0, spacing: float | None = None) -> Volume:
        """Return the box of voxels around some points, at the level that fits a spacing and the memory.

        Parameters
        ----------
        points : array_like, shape (n, 3)
            World points (mm, LPS).
        margin : float, default 0
            Distance around the points that is needed (mm).
        spacing : float, optional
            Distance between the positions at which the part is sampled (mm); by default the finest level.

        Raises
        ------
        VolumeError
            If the part takes more than half of the memory even at the coarsest level.
        """
        places = np.asarray(points, np.float64).reshape(-1, 3)
        if not len(places):
            places = self._world_from_index[:3, 3][None]
        for number in range(self.level_for(spacing), len(self._levels)):
            low, high = self._box(number, places, margin)
            needed = int(np.prod(np.subtract(high, low))) * self.dtype.itemsize
            if needed <= self._memory // 2:
                return self._kept_part(number, low, high)
        found = f"{in_words(self._memory)}, and a part of {in_words(needed)} at the coarsest level"
        raise VolumeError("memory", found, f"at least {in_words(2 * needed)}", f"set memory={2 * needed}")

    def _around(self, points: npt.ArrayLike, margin: float = 0.0, spacing: float | None = None) -> Volume:
        return self.part(points, margin, spacing)

    @functools.cached_property
    def _overview(self) -> Volume:
        fitting = [n for n, level in enumerate(self._levels) if level.bytes <= _MOST_OVERVIEW]
        number = max(self._whole_level, min(fitting, default=len(self._levels) - 1))
        ni, nj, nk = self._levels[number].size
        return self._volume(number, (0, 0, 0), (nk, nj, ni))

    def _box(self, number: int, points: npt.NDArray[np.float64], margin: float) -> tuple[Triple, Triple]:
        """Return the first voxel [k, j, i] of a level that is needed, and the voxel after the last one."""
        level = self._levels[number]
        index_from_world = np.linalg.inv(level.world_from_index)
        index = points @ index_from_world[:3, :3].T + index_from_world[:3, 3]
        reach = margin * np.linalg.norm(index_from_world[:3, :3], axis=1)
        last = np.asarray(level.size) - 1
        low = np.clip(np.floor(index.min(axis=0) - reach) - _RIM, 0, last).astype(int)
        high = np.clip(np.ceil(index.max(axis=0) + reach) + _RIM, 0, last).astype(int) + 1
        return tuple(low[::-1].tolist()), tuple(high[::-1].tolist())

    def _kept_part(self, number: int, low: Triple, high: Triple) -> Volume:
        """Return a part of a level; the last one is used again if it holds the voxels."""
        if self._part is not None:
            known, first, last, volume = self._part
            starts = all(a <= b for a, b in zip(first, low, strict=True))
            if known == number and starts and all(a >= b for a, b in zip(last, high, strict=True)):
                return volume
        self._part = None
        volume = self._volume(number, low, high)
        self._part = number, low, high, volume
        return volume

    def _volume(self, number: int, low: Triple, high: Triple) -> Volume:
        volume = Volume(
            self._read(number, low, high),
            world_from_index=self._moved(number, low),
            states_spacing=self._states_spacing,
            states_orientation=self._states_orientation,
        )
        volume._scan = _scan_of(number)
        return volume

    def _moved(self, number: int, low: Triple) -> npt.NDArray[np.float64]:
        """Return the affine of a part that begins at a voxel [k, j, i]."""
        shift = np.eye(4)
        shift[:3, 3] = low[::-1]
        return np.asarray(self._levels[number].world_from_index @ shift, np.float64)

    def _read(self, number: int, low: Triple, high: Triple) -> npt.NDArray[Any]:
        wanted = int(np.prod(np.subtract(high, low))) * self.dtype.itemsize
        kept = [self.__dict__.get("_whole"), getattr(self.__dict__.get("_overview"), "array", None)]
        room = self._memory - wanted - sum(array.nbytes for array in kept if array is not None)
        return self._cache.block(number, low, high, max(room, 0))

    def __repr__(self) -> str:
        sizes = ", ".join("{} × {} × {}".format(*level.size) for level in self._levels)
        return f"VolumePyramid({sizes} {self.dtype}, memory {in_words(self._memory)})"


def _scan_of(number: int) -> ScanDetails:
    """Return the details by which tables, JSON and reports state the measured level."""
    return ScanDetails(series_description=f"level {number}")
