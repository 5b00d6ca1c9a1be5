"""OME-Zarr images → volumes of which only the needed parts are read."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from lumencut.base.checks import integers
from lumencut.base.foreign_errors import refusing
from lumencut.base.memory import PYRAMID_MEMORY, in_words
from lumencut.errors import FormatError
from lumencut.files.ome_zarr.multiscales import Axis, Multiscale, StoredLevel, multiscale_of
from lumencut.files.ome_zarr.stored_array import StoredArray
from lumencut.files.ome_zarr.stores import answering, open_group
from lumencut.files.volume_choice import ZarrChoice
from lumencut.scene.volume_file import VolumeFile
from lumencut.scene.volume_pyramid import PyramidLevel, VolumePyramid

if TYPE_CHECKING:
    import zarr

#: A smaller budget holds no chunk of usual size.
_LEAST_MEMORY = 1_000_000


def pyramid_file(given: str | os.PathLike[str], wanted: ZarrChoice) -> VolumeFile:
    """Open an OME-Zarr image; no voxel is read.

    Parameters
    ----------
    given : str or path
        A folder, a zip archive, or the address of a server on this machine.
    wanted : ZarrChoice
        The memory, and the channel and the time point where there are several.

    Raises
    ------
    FormatError
        For what is not one 3D image, or levels that do not fit each other.
    VolumeError
        If the memory is too small for the coarsest level.
    """
    subject = os.fspath(given)
    budget = PYRAMID_MEMORY if wanted.memory is None else wanted.memory
    (budget,) = integers(FormatError, "memory", [budget], _LEAST_MEMORY, 1 << 50, 1)
    group = open_group(given)
    with answering(subject), refusing(subject, "OME-Zarr", []):
        attributes = group.attrs.asdict()
    multiscale = multiscale_of(attributes, lambda: _groups_of(group), subject)
    picked: list[int] = []
    levels = []
    for stored in multiscale.levels:
        array = _array(group, stored, subject)
        picked = picked or _picked(multiscale, array, wanted, subject)
        levels.append(_level(multiscale, stored, array, picked, subject))
    _check_extents(levels, subject)
    pyramid = VolumePyramid(levels, budget, states_spacing=multiscale.millimetres is not None)
    return VolumeFile(
        Path(given), f"OME-Zarr {multiscale.version}", pyramid.size, pyramid.dtype, "LPS (assumed)",
        pyramid.world_from_index, lambda progress, filled: pyramid, notes=_notes(multiscale, pyramid),
        details=_details(multiscale, pyramid), slow_details=lambda: _gaps(pyramid),
        states_spacing=pyramid.states_spacing, states_orientation=False, settled_type=pyramid.dtype,
    )  # fmt: skip


def _groups_of(group: zarr.Group) -> list[str]:
    """Return the names of the groups within a group; none where they cannot be listed."""
    try:
        return [name for name, _ in group.groups()]
    except Exception:
        # A server lists nothing, and damaged members raise any error. The names are only a hint.
        return []


def _array(group: zarr.Group, stored: StoredLevel, subject: str) -> zarr.Array[Any]:
    import zarr
    from zarr.errors import UnknownCodecError

    place = f"{subject}, level {stored.path}"
    with answering(subject), refusing(place, "OME-Zarr", []):
        try:
            found = group[stored.path]
        except UnknownCodecError as error:
            # The name of a codec is no value of a patient.
            codec = f"a codec that is not installed: {str(error)[:80]}"
            mend = "install its package, or write the image with another codec"
            raise FormatError(place, codec, "a known codec", mend) from error
        except KeyError as error:
            expected = "every level of its metadata"
            raise FormatError(
                subject, f"no level {stored.path!r}", expected, "copy the image again"
            ) from error
    if not isinstance(found, zarr.Array):
        raise FormatError(subject, f"a group at level {stored.path!r}", "an array")
    return found


def _picked(multiscale: Multiscale, array: zarr.Array[Any], wanted: ZarrChoice, subject: str) -> list[int]:
    """Return the index of the channel, the time point and any other axis; 0 for spatial axes."""
    asked = {"channel": wanted.channel, "time": wanted.time_point}
    picked = []
    for number, axis in enumerate(multiscale.axes):
        count = 1 if number in multiscale.space else array.shape[number]
        names = multiscale.channels if axis.kind == "channel" else ()
        picked.append(_index(axis, count, names, asked.pop(axis.kind, None), subject))
    for kind, value in asked.items():
        if value is not None:
            raise FormatError(subject, f"no axis of type {kind}", f"one, for {value!r:.40}", "leave it out")
    return picked


def _index(axis: Axis, count: int, names: tuple[str, ...], asked: str | int | None, subject: str) -> int:
    """Return the index along an axis that is not spatial."""
    known = [names[n] if n < len(names) and names[n] else str(n) for n in range(count)]
    option, listed = {"time": "time_point"}.get(axis.kind, axis.kind), ", ".join(known[:12])
    if asked is None:
        if count == 1:
            return 0
        mend = f"choose one with {option}={known[0]!r}" if axis.kind in ("channel", "time") else ""
        raise FormatError(subject, f"{count} values along {axis.name}: {listed}", "one of them", mend)
    if str(asked) in known:
        return known.index(str(asked))
    if str(asked).isdecimal() and int(asked) < count:
        return int(asked)
    raise FormatError(subject, f"the {option} {asked!r:.40}", f"one of {listed}")


def _level(
    multiscale: Multiscale, stored: StoredLevel, array: zarr.Array[Any], picked: list[int], subject: str
) -> PyramidLevel:
    if array.ndim != len(multiscale.axes):
        found = f"{array.ndim} axes of level {stored.path}"
        raise FormatError(subject, found, f"the {len(multiscale.axes)} axes of the metadata")
    space = multiscale.space
    voxels = StoredArray(array, space, picked, f"{subject}, level {stored.path}")
    unit = np.ones(3) if multiscale.millimetres is None else multiscale.millimetres
    affine = np.diag([*(stored.scale[list(space)] * unit), 1.0])
    affine[:3, 3] = stored.translation[list(space)] * unit
    nk, nj, ni = voxels.shape
    return PyramidLevel((ni, nj, nk), affine, voxels)


def _check_extents(levels: list[PyramidLevel], subject: str) -> None:
    """Reject levels that do not cover the same place, up to one voxel of the coarser level."""

    def extent(level: PyramidLevel) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        low = level.world_from_index[:3, 3] - level.spacing / 2
        return low, low + level.spacing * np.asarray(level.size)

    finest = extent(levels[0])
    for number, level in enumerate(levels[1:], 1):
        if level.array.dtype != levels[0].array.dtype:
            found = f"{level.array.dtype} at level {number} and {levels[0].array.dtype} at level 0"
            raise FormatError(subject, found, "one type of voxels")
        if (level.spacing < levels[number - 1].spacing * (1 - 1e-6)).any():
            raise FormatError(subject, f"level {number} finer than the level before it", "coarser levels")
        for own, other in zip(extent(level), finest, strict=True):
            if (np.abs(own - other) > level.spacing * (1 + 1e-6)).any():
                found = f"level {number} from {own.tolist()} mm, level 0 from {other.tolist()} mm"
                raise FormatError(subject, found, "levels of one place", "make its pyramid again")


def _notes(multiscale: Multiscale, pyramid: VolumePyramid) -> list[str]:
    """Return what is assumed about an image."""
    notes = []
    if multiscale.millimetres is None:
        notes.append("it states no unit of length: 1 mm per unit is assumed")
    if not multiscale.states_translation and len(pyramid.levels) > 1:
        notes.append("its levels state no translation: coarser levels may lie half a voxel off")
    if pyramid.whole_level:
        finest, whole = pyramid.levels[0], pyramid.levels[pyramid.whole_level]
        notes.append(
            f"level {pyramid.whole_level} ({in_words(whole.bytes)}) stands for the whole volume: "
            f"level 0 takes {in_words(finest.bytes)}, more than half of {in_words(pyramid.memory)}"
        )
    return notes


def _details(multiscale: Multiscale, pyramid: VolumePyramid) -> dict[str, str]:
    details = {}
    for number, level in enumerate(pyramid.levels):
        size = " × ".join(map(str, level.size))
        spacing = " × ".join(f"{side:.4g}" for side in level.spacing)
        details[f"level {number}"] = f"{size} voxels of {spacing} mm, {in_words(level.bytes)}"
    if multiscale.channels:
        details["channels"] = ", ".join(multiscale.channels)
    return details


def _gaps(pyramid: VolumePyramid) -> dict[str, str]:
    """Return how many chunks of a level are stored, where some are missing; a server does not list them."""
    gaps = {}
    for number, level in enumerate(pyramid.levels):
        assert isinstance(level.array, StoredArray)
        stored = level.array.stored
        if stored is not None and stored[0] < stored[1]:
            words = f"{stored[0]} of {stored[1]} chunks are stored, the others have one value"
            gaps[f"chunks of level {number}"] = words
    return gaps
