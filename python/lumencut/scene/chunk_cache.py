"""Chunks of arrays that are too large for memory: read when needed, kept as long as there is room."""

from __future__ import annotations

import itertools
import threading
from collections import OrderedDict
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from lumencut.base.cores import usable_cores

Triple = tuple[int, int, int]


class ChunkedArray(Protocol):
    """Voxels [k, j, i] whose chunks are stored one by one."""

    @property
    def shape(self) -> Triple:
        """Number of voxels along k, j, i."""

    @property
    def chunks(self) -> Triple:
        """Number of voxels of a chunk along k, j, i."""

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the voxels."""

    def read(self, low: Triple, high: Triple) -> npt.NDArray[Any]:
        """Return the voxels from `low` to before `high`."""


class ChunkCache:
    """The decoded chunks of some arrays; the least recently used ones make room.

    Parameters
    ----------
    arrays : sequence of ChunkedArray
        The arrays, which are named by their number.
    """

    def __init__(self, arrays: Sequence[ChunkedArray]) -> None:
        self._arrays = arrays
        self._kept: OrderedDict[tuple[int, Triple], npt.NDArray[Any]] = OrderedDict()
        self._lock = threading.Lock()
        self.held = 0
        """Bytes of the chunks in memory."""
        self.chunks_read = 0
        """Number of chunks that were read, in all."""
        self.bytes_read = 0
        """Bytes of these chunks after decoding."""

    def block(self, number: int, low: Triple, high: Triple, room: int) -> npt.NDArray[Any]:
        """Return the voxels from `low` to before `high`, and keep at most `room` bytes of chunks."""
        array = self._arrays[number]
        self._make_room(room)
        voxels = np.empty([b - a for a, b in zip(low, high, strict=True)], array.dtype)

        def fill(chunk: Triple) -> None:
            start, end = _extent(array, chunk)
            part = self._chunk(number, chunk, start, end, room)
            first = [max(a, s) for a, s in zip(low, start, strict=True)]
            last = [min(b, e) for b, e in zip(high, end, strict=True)]
            into = tuple(slice(f - a, e - a) for f, e, a in zip(first, last, low, strict=True))
            of = tuple(slice(f - s, e - s) for f, e, s in zip(first, last, start, strict=True))
            voxels[into] = part[of]

        with ThreadPoolExecutor(usable_cores()) as pool:
            for _ in pool.map(fill, chunks_between(array, low, high)):
                pass
        self._make_room(room)
        return voxels

    def _chunk(self, number: int, chunk: Triple, start: Triple, end: Triple, room: int) -> npt.NDArray[Any]:
        with self._lock:
            kept = self._kept.get((number, chunk))
            if kept is not None:
                self._kept.move_to_end((number, chunk))
                return kept
        part = self._arrays[number].read(start, end)
        with self._lock:
            self.chunks_read += 1
            self.bytes_read += part.nbytes
            if (number, chunk) not in self._kept:
                self._kept[number, chunk] = part
                self.held += part.nbytes
        self._make_room(room)
        return part

    def _make_room(self, room: int) -> None:
        """Drop the least recently used chunks beyond `room` bytes."""
        with self._lock:
            while self.held > room and self._kept:
                self.held -= self._kept.popitem(last=False)[1].nbytes


def chunks_between(array: ChunkedArray, low: Triple, high: Triple) -> Iterator[Triple]:
    """Return the chunks that hold voxels from `low` to before `high`, counted along each axis."""
    ranges = [range(a // c, -(-b // c)) for a, b, c in zip(low, high, array.chunks, strict=True)]
    return itertools.product(*ranges)  # type: ignore[return-value]


def _extent(array: ChunkedArray, chunk: Triple) -> tuple[Triple, Triple]:
    """Return the first voxel of a chunk, and the voxel after its last one."""
    start = tuple(n * c for n, c in zip(chunk, array.chunks, strict=True))
    end = tuple(min(s + c, n) for s, c, n in zip(start, array.chunks, array.shape, strict=True))
    return start, end  # type: ignore[return-value]
