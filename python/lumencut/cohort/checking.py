"""Which studies of a manifest will fail, told from headers and sizes of their files before anything runs."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.centerline_file import CenterlineFile
from lumencut.cohort.manifest import Study
from lumencut.cohort.recipe import Reading
from lumencut.cohort.sources import mask_of, places_of, reading_of
from lumencut.errors import FormatError, LumencutError
from lumencut.mask_grid import place_within
from lumencut.volume_files import open_volume
from lumencut.volume_files.opened import VolumeFile

#: Address space that the process of a study has before it reads a voxel, at least (bytes).
_PROCESS = 256 << 20
#: A study with so much beside this multiple of its voxels has enough: all that is computed of them is less.
_AMPLE, _TIMES = 4 << 30, 12


@dataclass(frozen=True)
class Verdict:
    """What headers and sizes tell of a study.

    Attributes
    ----------
    trouble : str
        Why it will fail; empty where nothing tells so.
    unsure : tuple of str
        What nothing but the run can tell, a sentence each; empty where a study will fail anyway.
    """

    trouble: str = ""
    unsure: tuple[str, ...] = ()


def trouble_of(study: Study, how: Reading) -> str:
    """Return why a study will fail, as far as headers and sizes tell; empty where they tell nothing."""
    return verdict_of(study, how).trouble


def verdict_of(study: Study, how: Reading, memory: int | None = None) -> Verdict:
    """Judge a study by headers and sizes.

    The voxels of volumes and masks are not read; files of centerlines and points are.

    Parameters
    ----------
    study, how
        The study, and how its scan is read.
    memory : int, optional
        The most memory that it may have (bytes of address space); that of the machine where not given.
    """
    try:
        return Verdict(unsure=tuple(_judged(study, how, memory)))
    except LumencutError as error:
        return Verdict(str(error))
    except Exception as error:
        # A file that its reader does not expect at all fails the study, not the check of all others.
        return Verdict(f"unexpected {type(error).__name__}: {error}")


def _judged(study: Study, how: Reading, memory: int | None) -> Iterator[str]:
    """Yield what only the run can tell.

    Raises
    ------
    LumencutError
        Where the study will fail.
    """
    volume = open_volume(study.volume, **reading_of(study, how))
    files = [volume]
    match study.source:
        case "mask":
            files.append(mask_of(study).file)
            _check_grid(volume, files[1])
        case "centerlines":
            _check_lines(study, volume)
        case "points" | "seeds":
            _check_places(study, volume)
    for file in files:
        if not file.check_length():
            yield f"{file.path}: whether all voxels are there is known once they are read"
    needed = sum(_bytes(file) for file in files)
    _check_memory(study, needed, memory)
    if _AMPLE + _TIMES * needed > (memory or _machine()):
        yield f"{_megabytes(needed)} of voxels: whether the memory is enough is known once they are measured"


def _bytes(file: VolumeFile) -> int:
    """The bytes of the voxels of a file in memory, at least."""
    return math.prod(file.size) * (file.settled_type or file.dtype).itemsize


def _check_memory(study: Study, needed: int, memory: int | None) -> None:
    """Refuse voxels that do not fit into the memory."""
    room = _machine() if memory is None else max(memory - _PROCESS, 0)
    if needed > room:
        expected = f"at most {_megabytes(room)}, " + (
            "the memory of this machine" if memory is None else "what --memory leaves for them"
        )
        raise FormatError(str(study.volume), f"{_megabytes(needed)} of voxels", expected, "give it more")


def _machine() -> int:
    """The memory of this machine (bytes); more than any volume has where the system does not tell."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):
        return 1 << 48


def _megabytes(count: int) -> str:
    return f"{count / 1e6:.0f} MB"


def _check_grid(volume: VolumeFile, mask: VolumeFile) -> None:
    """Refuse a mask whose corners are not those of its volume, to a tenth of a voxel."""
    if mask.is_segmentation:
        place_within(mask, volume)
        return
    apart = max(float(np.linalg.norm(_corners(volume) - corner, axis=1).min()) for corner in _corners(mask))
    steps = np.linalg.norm(volume.world_from_index[:3, :3], axis=0)
    if apart > 0.1 * float(steps.max()):
        found = f"corners up to {apart:.4g} mm beside those of the volume"
        raise FormatError(str(mask.path), found, "its grid")


def _corners(file: VolumeFile) -> npt.NDArray[np.float64]:
    """The middles of the corner voxels, shape (8, 3), mm, LPS."""
    last = np.array(file.size) - 1
    index = np.stack(np.meshgrid(*((0, end) for end in last), indexing="ij"), axis=-1).reshape(-1, 3)
    return np.asarray(index @ file.world_from_index[:3, :3].T + file.world_from_index[:3, 3])


@dataclass(frozen=True)
class _Grid:
    """A grid as the core takes it."""

    size: tuple[int, int, int]
    _affine_rows: tuple[tuple[float, ...], ...]


def _check_lines(study: Study, volume: VolumeFile) -> None:
    """Refuse a file of centerlines that cannot be read, or that misses the volume however it is meant."""
    points = CenterlineFile(study.given).placed()[0].points
    rows = tuple(map(tuple, volume.world_from_index[:3].tolist()))
    if _lumencut.fits_nowhere(points, _Grid(volume.size, rows)):
        found = "no point in the volume, in whatever space and unit"
        raise FormatError(study.given, found, "centerlines of this scan")


def _check_places(study: Study, volume: VolumeFile) -> None:
    """Refuse points that lie outside of the volume, or are too few."""
    if not study.given_as_text:
        CenterlineFile(study.given)
        return
    points = places_of(study)
    if study.source == "points" and len(points) < 2:
        raise FormatError("points", f"{len(points)}", "two or more along the vessel")
    inverse = np.linalg.inv(volume.world_from_index)
    index = points @ inverse[:3, :3].T + inverse[:3, 3]
    beyond = ((index < -0.5) | (index > np.array(volume.size) - 0.5)).any(axis=1)
    if beyond.any():
        place = ", ".join(f"{x:g}" for x in points[beyond][0])
        found = f"{place} (mm, LPS), outside of the volume"
        raise FormatError(study.source, found, "points within it")
