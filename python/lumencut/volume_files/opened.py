"""What every room of this package hands back, and how foreign failures become ours."""

from __future__ import annotations

import textwrap
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FileError, FormatError, LumencutError, VolumeError
from lumencut.volume import Volume

Progress = Callable[[int, int], None]
"""Called with (slices read, slices in all)."""


@dataclass(frozen=True, eq=False)
class VolumeFile:
    """A volume whose headers are read and checked and whose voxels are still on disk."""

    path: Path
    format: str
    size: tuple[int, int, int]
    dtype: np.dtype[Any]
    space: str
    world_from_index: npt.NDArray[np.float64]
    load: Callable[[Progress], npt.NDArray[Any]]
    notes: list[str] = field(default_factory=list)
    filled: tuple[int, ...] = ()
    details: dict[str, str] = field(default_factory=dict)

    def volume(self, progress: Progress) -> Volume:
        """Read the voxels."""
        with refusing(self.path, self.format, self.notes):
            voxels = self.load(progress)
        volume = _placed(self, voxels)
        volume._filled_slices = self.filled
        return volume

    def checked(self) -> VolumeFile:
        """Refuse a grid that no volume can have before any voxel is read."""
        _placed(self, np.zeros((1, 1, 1), np.uint8))
        return self


def _placed(file: VolumeFile, voxels: npt.NDArray[Any]) -> Volume:
    try:
        return Volume(voxels, world_from_index=file.world_from_index)
    except VolumeError as error:
        raise FormatError(
            str(file.path), f"{error.subject} {error.found}", error.expected, error.mend
        ) from error


@contextmanager
def refusing(subject: object, kind: str, notes: list[str]) -> Iterator[None]:
    """Turn whatever a foreign reader raises into an error that names the file, and its warnings into notes.

    Damaged files make the readers below raise nearly every built-in exception; none of them names the file.
    """
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            yield
    except LumencutError:
        raise
    except Exception as error:
        if isinstance(error, OSError) and error.errno is not None:
            found = error.strerror or type(error).__name__
            raise FileError(str(error.filename or subject), found, "a readable file") from error
        raise FormatError(str(subject), _brief(error), f"a sound {kind} file") from error
    for warning in caught:
        if (text := _brief(warning.message)) not in notes:
            notes.append(text)


def _brief(message: object) -> str:
    """One line, printable and not too long, of a message that may quote the file's bytes."""
    text = "".join(letter if letter.isprintable() else " " for letter in str(message))
    return textwrap.shorten(text, 200, placeholder=" …") or type(message).__name__
