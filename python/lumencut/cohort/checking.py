"""Predicts which studies of a manifest will fail, from headers and sizes of their files."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lumencut import _lumencut
from lumencut.base.memory import available_memory, in_words
from lumencut.cohort.manifest import Study
from lumencut.cohort.recipe import Reading
from lumencut.cohort.sources import mask_of, places_of, reading_of
from lumencut.errors import FormatError, LumencutError
from lumencut.files.centerline_file import CenterlineFile
from lumencut.files.mask_grid import place_within
from lumencut.files.volumes import open_volume
from lumencut.scene.volume_file import VolumeFile

#: Smallest address space of the process of a study before it reads a voxel (bytes).
_PROCESS = 256 << 20
#: Memory that is enough for any study: the first number plus the second times the voxels; not measured.
_AMPLE, _TIMES = 4 << 30, 12


@dataclass(frozen=True)
class Verdict:
    """The prediction for a study from headers and sizes.

    Attributes
    ----------
    trouble : str
        Why it will fail; empty if no failure is predicted.
    unsure : tuple of str
        What only the run can show, a sentence each; empty if the study will fail anyway.
    """

    trouble: str = ""
    unsure: tuple[str, ...] = ()


def trouble_of(study: Study, how: Reading) -> str:
    """Return why a study will fail, predicted from headers and sizes; empty if no failure is predicted."""
    return verdict_of(study, how).trouble


def verdict_of(study: Study, how: Reading, memory: int | None = None) -> Verdict:
    """Predict from headers and sizes whether a study will fail.

    The voxels of volumes and masks are not read; files of centerlines and points are.

    Parameters
    ----------
    study, how
        The study, and the part of the recipe that defines how to read its scan.
    memory : int, optional
        Memory limit of the study (bytes of address space); by default the memory of the machine.
    """
    try:
        return Verdict(unsure=tuple(_judged(study, how, memory)))
    except LumencutError as error:
        return Verdict(str(error))
    except Exception as error:
        # An unexpected error fails this study, not the check of all others.
        return Verdict(f"unexpected {type(error).__name__}: {error}")


def _judged(study: Study, how: Reading, memory: int | None) -> Iterator[str]:
    """Yield what only the run can show.

    Raises
    ------
    LumencutError
        If the study will fail.
    """
    volume = open_volume(study.volume, **reading_of(study, how))
    files = [volume]
    match study.source:
        case "mask":
            mask = mask_of(study).file
            place_within(mask, volume, always=mask.is_segmentation)
            files.append(mask)
        case "centerlines":
            _check_lines(study, volume)
        case "points" | "seeds":
            _check_places(study, volume)
    for file in files:
        if not file.check_length():
            yield f"{file.path}: only reading can show whether all voxels are there"
    needed = sum(_bytes(file) for file in files)
    _check_memory(study, needed, memory)
    if _AMPLE + _TIMES * needed > (memory or available_memory()):
        yield f"{in_words(needed)} of voxels: only measuring can show whether the memory is enough"


def _bytes(file: VolumeFile) -> int:
    """Return the smallest size that the voxels of a file have in memory (bytes)."""
    return math.prod(file.size) * (file.settled_type or file.dtype).itemsize


def _check_memory(study: Study, needed: int, memory: int | None) -> None:
    """Reject voxels that do not fit into the memory."""
    room = available_memory() if memory is None else max(memory - _PROCESS, 0)
    if needed > room:
        expected = f"at most {in_words(room)}, " + (
            "the available memory" if memory is None else "the memory that --memory leaves for voxels"
        )
        raise FormatError(
            str(study.volume), f"{in_words(needed)} of voxels", expected, "make more memory available"
        )


@dataclass(frozen=True)
class _Grid:
    """A grid in the form that the core accepts."""

    size: tuple[int, int, int]
    _affine_rows: tuple[tuple[float, ...], ...]


def _check_lines(study: Study, volume: VolumeFile) -> None:
    """Reject a file of centerlines that cannot be read, or that misses the volume in every space and unit."""
    points = CenterlineFile(study.given).placed()[0].points
    rows = tuple(map(tuple, volume.world_from_index[:3].tolist()))
    if _lumencut.fits_nowhere(points, _Grid(volume.size, rows)):
        found = "no point in the volume, in any space and unit"
        raise FormatError(study.given, found, "centerlines of this scan")


def _check_places(study: Study, volume: VolumeFile) -> None:
    """Reject points outside the volume, or too few points."""
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
