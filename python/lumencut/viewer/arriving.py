"""A scene that is read while the server already answers; the page gets slices as they are read."""

from __future__ import annotations

import logging
import os
import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError, LumencutError
from lumencut.files.centerline_writers import centerline_content
from lumencut.files.volumes import log_oddities
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.scene.volume_file import VolumeFile
from lumencut.viewer import volume_stream

_log = logging.getLogger("lumencut")

#: How long the closing server waits for the reader, which stops only between two slices (s).
_PATIENCE = 5.0


class _StoppedError(BaseException):
    """The server ends; not an Exception, so that no reader catches it."""


class ArrivingScene:
    """A volume that a separate thread reads, and the centerlines that it then reads for it.

    Only that thread writes; each attribute that others read changes atomically.

    Parameters
    ----------
    file : VolumeFile
        The volume, with its headers read.
    tree_in : callable, optional
        Returns the vessel tree for the volume; None without centerlines.
    """

    def __init__(self, file: VolumeFile, tree_in: Callable[[Volume], VesselTree] | None = None) -> None:
        self._file, self._tree_in = file, tree_in
        self._is_stopped = False
        self._thread = threading.Thread(target=self._read, name="lumencut volume", daemon=True)
        self.read_type: np.dtype[Any] | None = file.settled_type
        self.voxels: tuple[npt.NDArray[Any] | None, int] = (None, 0)
        self.volume: Volume | None = None
        self.problem: LumencutError | None = None
        self.centerline_problem: LumencutError | None = None
        self.centerlines: bytes | None = None

    @property
    def has_centerlines(self) -> bool:
        """Whether there are centerlines, read or not."""
        return self._tree_in is not None

    @property
    def is_whole(self) -> bool:
        """Whether all voxels are read."""
        return self.voxels[1] == self.slices

    @property
    def slices(self) -> int:
        """The number of slices."""
        return self._file.size[2]

    def header(self, read_type: np.dtype[Any]) -> bytes:
        """Return the first bytes of the volume's stream."""
        return volume_stream.header(self._file, read_type)

    def length(self, read_type: np.dtype[Any]) -> int:
        """Return how many bytes follow the header."""
        return volume_stream.length(self._file, read_type)

    def has_news(self, count: int) -> bool:
        """Return whether more slices than these are read, or reading has ended."""
        return self.voxels[1] > count or self.problem is not None

    def start(self) -> None:
        """Start reading."""
        self._thread.start()

    def stop(self) -> None:
        """Stop reading."""
        self._is_stopped = True
        if self._thread.is_alive():
            self._thread.join(_PATIENCE)

    def _read(self) -> None:
        try:
            self._read_volume()
        except _StoppedError:
            return
        except Exception as error:
            self.problem = self._told(error)
            self.centerline_problem = self.problem
            _log.warning("%s", self.problem)

    def _read_volume(self) -> None:
        volume = self._file.volume(self._heed, self._fill)
        promised, self.read_type = self.read_type, volume.dtype
        self.voxels, self.volume = (volume.array, self.slices), volume
        log_oddities(self._file)
        if promised not in (None, volume.dtype):
            # These voxels do not match the header already sent; the next request gets the right header.
            found, expected = f"voxels of type {volume.dtype}", f"{promised} as its headers say"
            self.problem = FormatError(self._file.path.name, found, expected, "load the page again")
        if self._tree_in is not None:
            self._place(self._tree_in, volume)

    def _place(self, tree_in: Callable[[Volume], VesselTree], volume: Volume) -> None:
        try:
            self.centerlines = centerline_content(tree_in(volume), "vtp")
        except Exception as error:
            self.centerline_problem = self._told(error)
            _log.warning("%s", self.centerline_problem)

    def _heed(self, done: int, total: int) -> None:
        if self._is_stopped:
            raise _StoppedError

    def _fill(self, voxels: npt.NDArray[Any], count: int) -> None:
        """Publish slices that will not change any more, in an array that will not be replaced."""
        self._heed(count, self.slices)
        if voxels.dtype == self.read_type and voxels.shape[0] == self.slices:
            self.voxels = voxels, count

    def _told(self, error: Exception) -> LumencutError:
        """Return the error for the page, with names of files but without folders."""
        if isinstance(error, MemoryError):
            found, expected = "more than the free memory holds", "a scene that fits into it"
            return FormatError(self._file.path.name, found, expected)
        if not isinstance(error, LumencutError):
            found = f"an unexpected {type(error).__name__}"
            return FormatError(self._file.path.name, found, "a scene that can be read")
        folder = f"{self._file.path.parent}{os.sep}"
        subject, *rest = error.subject, error.found, error.expected, error.mend
        return type(error)(subject.removeprefix(folder), *rest)
