"""The result of every reader of this package, and the conversion of foreign errors."""

from __future__ import annotations

import logging
import re
import textwrap
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path, PureWindowsPath
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.dicom_objects.patients import Patient
from lumencut.dicom_objects.study import Study
from lumencut.errors import FileError, FormatError, LumencutError, VolumeError
from lumencut.scan_details import ScanDetails
from lumencut.volume import Volume

Progress = Callable[[int, int], None]
"""Called with (slices read, slices in all)."""

Filled = Callable[[npt.NDArray[Any], int], None]
"""Called with (the voxels [k, j, i] that are being read, how many of their first slices are final)."""


def unfollowed(voxels: npt.NDArray[Any], count: int) -> None:
    """Ignore final slices."""


def unproven() -> bool:
    """Return no proof: only reading the voxels shows whether the file is complete."""
    return False


@dataclass(frozen=True, eq=False)
class VolumeFile:
    """A volume whose headers are read and checked and whose voxels are still on disk."""

    path: Path
    format: str
    size: tuple[int, int, int]
    dtype: np.dtype[Any]
    space: str
    world_from_index: npt.NDArray[np.float64]
    load: Callable[[Progress, Filled], npt.NDArray[Any]]
    notes: list[str] = field(default_factory=list)
    filled: tuple[int, ...] = ()
    details: dict[str, str] = field(default_factory=dict)
    scan: ScanDetails = field(default_factory=ScanDetails)
    remarks: list[str] = field(default_factory=list)
    """Notes on the file for reports, without a warning to every reader."""
    states_spacing: bool = True
    states_orientation: bool = True
    study: Study | None = None
    settled_type: np.dtype[Any] | None = None
    """The type of the voxels, if the headers decide it."""
    frame_of_reference: str = ""
    """The DICOM frame of reference UID; empty if none is stated."""
    patient: Patient = field(default_factory=Patient)
    """The patient, from DICOM."""
    label_names: dict[int, str] = field(default_factory=dict)
    """The names of the labels, if the file has them."""
    is_segmentation: bool = False
    """Whether it is a segmentation: its segments can be chosen, and it may cover a part of its scan."""
    check_length: Callable[[], bool] = unproven
    """Rejects files that are too short for their voxels; returns whether lengths prove completeness."""
    holds: object = None
    """Object to keep alive until the voxels are read."""

    def volume(self, progress: Progress, filled: Filled = unfollowed) -> Volume:
        """Read the voxels; exceptions of `progress` pass through.

        `filled` is called with voxels that others may use while the rest is read; not every reader calls it.
        """
        with heeding(progress) as report, refusing(self.path, self.format, self.notes):
            voxels = self.load(report, filled)
        volume = _placed(self, voxels)
        volume._frame_of_reference, volume._is_segmentation = self.frame_of_reference, self.is_segmentation
        volume._label_names = self.label_names
        volume._filled_slices, volume._scan, volume._study = self.filled, self.scan, self.study
        volume._patient = self.patient
        return volume

    def checked(self) -> VolumeFile:
        """Reject a grid that no volume can have before any voxel is read, and note a doubtful size."""
        _placed(self, np.zeros((1, 1, 1), np.uint8))
        doubt = _lumencut.doubted_size(self.size, self.world_from_index[:3].tolist())
        if doubt and doubt not in self.notes:
            self.notes.append(doubt)
        return self


def held_in_memory(volume: Volume, name: str) -> VolumeFile:
    """Return a named volume as a file whose voxels are already read."""
    return VolumeFile(
        Path(name), "memory", volume.size, volume.dtype, "LPS", volume.world_from_index,
        lambda progress, filled: volume.array,
        states_spacing=volume.states_spacing, states_orientation=volume.states_orientation,
        settled_type=volume.dtype, scan=volume.scan,
    )  # fmt: skip


def _placed(file: VolumeFile, voxels: npt.NDArray[Any]) -> Volume:
    try:
        return Volume(
            voxels,
            world_from_index=file.world_from_index,
            states_spacing=file.states_spacing,
            states_orientation=file.states_orientation,
        )
    except VolumeError as error:
        found = " ".join(f"{error.subject} {error.found}".split())
        raise FormatError(str(file.path), found, error.expected, error.mend) from error


@contextmanager
def heeding(progress: Progress) -> Iterator[Progress]:
    """Yield a progress function whose own errors pass through `refusing`."""
    raised: list[Exception] = []

    def report(done: int, total: int) -> None:
        try:
            progress(done, total)
        except Exception as error:
            raised.append(error)
            raise

    try:
        yield report
    except Exception:
        if raised:
            raise raised[0] from None
        raise


_reading = ContextVar("reading", default=False)
# pydicom logs its warnings as well, values and all; here they become notes.
logging.getLogger("pydicom").addFilter(lambda record: not _reading.get())


@contextmanager
def refusing(subject: object, kind: str, notes: list[str]) -> Iterator[None]:
    """Convert any exception of a foreign reader into an error that names the file, and its warnings to notes.

    Damaged files make the readers below raise nearly every built-in exception; none of them names the file,
    and many quote it: neither the error nor a printed traceback shows a value out of the file.
    """
    before = _reading.set(True)
    try:
        with _heard() as caught:
            yield
    except LumencutError:
        raise
    except MemoryError:
        found, expected = "more than the free memory holds", "a volume that fits into it"
        raise FormatError(str(subject), found, expected) from None
    except Exception as error:
        if isinstance(error, OSError) and error.errno is not None:
            found = error.strerror or type(error).__name__
            raise FileError(str(error.filename or subject), found, "a readable file") from None
        raise FormatError(str(subject), impersonal(error), f"a sound {kind} file") from None
    finally:
        _reading.reset(before)
    for warning in caught:
        if (text := impersonal(warning)) not in notes:
            notes.append(text)


_caught: ContextVar[list[Warning] | None] = ContextVar("caught", default=None)
_NOT_OF_FILES = (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning)


class _Hearing:
    """Routes warnings to the reader in the same thread.

    Python has one handler for all threads: the first reader replaces it, the last one restores it.
    """

    def __init__(self) -> None:
        self._lock, self._readers = threading.Lock(), 0
        self._catcher, self._usual = warnings.catch_warnings(), warnings.showwarning

    def start(self) -> None:
        with self._lock:
            if self._readers == 0:
                self._usual, self._catcher = warnings.showwarning, warnings.catch_warnings()
                self._catcher.__enter__()
                warnings.simplefilter("always")
                warnings.showwarning = self._received
            self._readers += 1

    def end(self) -> None:
        with self._lock:
            self._readers -= 1
            if self._readers == 0:
                self._catcher.__exit__(None, None, None)
                warnings.showwarning = self._usual

    def _received(self, message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
        caught = _caught.get()
        if caught is None:
            self._usual(message, category, *where, **more)
        elif not issubclass(category, _NOT_OF_FILES):
            caught.append(message if isinstance(message, Warning) else category(message))


_hearing = _Hearing()


@contextmanager
def _heard() -> Iterator[list[Warning]]:
    """Collect the warnings of this thread that are about a file."""
    caught: list[Warning] = []
    before = _caught.set(caught)
    _hearing.start()
    try:
        yield caught
    finally:
        _hearing.end()
        _caught.reset(before)


_VALUE = re.compile(r"""[^ -~]|[\d"'`:=<>^(\[{\\]""")
_LONG_ENOUGH = 3


def impersonal(message: BaseException | str) -> str:
    """The part of a foreign message before any quoted value, which may be a patient's name.

    Values follow a colon, a quotation mark or a bracket; words with digits are values.
    """
    words = _VALUE.split(str(message), maxsplit=1)[0]
    words = textwrap.shorten(words.rstrip(" -,.;"), 100, placeholder=" …")
    words = words if len(words.split()) >= _LONG_ENOUGH else "damaged or unknown content"
    return words if isinstance(message, (str, Warning)) else f"{words} ({type(message).__name__})"


def shown(value: object) -> str:
    """A value of a header's field that is no free text, as one short printable line."""
    text = printable(str(value))
    return textwrap.shorten(text, 60, placeholder=" …") if len(text) <= 60 else text[:59] + "…"


def printable(text: str) -> str:
    """A text without line breaks and control characters."""
    return "".join(letter if letter.isprintable() else "�" for letter in text)


def decoded(line: bytes) -> str:
    """A line of a header as UTF-8, or as Latin-1 if it is invalid, since file names may use either."""
    try:
        return line.decode()
    except UnicodeDecodeError:
        return line.decode("latin-1")


def inside(header: Path, name: str, field: str) -> Path:
    """Return the file that a header names, which must lie in the header's folder or a folder below it.

    Parameters
    ----------
    header : Path
        The file that names the other.
    name : str
        The name in the header; Windows separators are accepted.
    field : str
        The header's field, for the error.

    Raises
    ------
    FormatError
        For absolute paths, drives, ``..`` and links that lead out: opening a volume must not read a file
        that its sender chose.
    """
    windows = PureWindowsPath(name)
    parts = windows.parts
    if not parts or not name.isprintable():
        raise FormatError(str(header), f"no file name in {field}", "the name of a file next to the header")
    leaves = windows.drive or windows.root or ".." in parts or name.startswith("~")
    home = header.parent.resolve()
    place = header.parent.joinpath(*parts)
    if leaves or not place.resolve().is_relative_to(home):
        raise FormatError(
            str(header),
            f"{field}: a path that leaves the folder ({shown(name)})",
            "a file in the folder of the header or below",
            "copy it there and name it without a path",
        )
    return place
