"""NIfTI, NRRD and MetaImage files: opened here; compiled code reads the headers and converts the voxels."""

from __future__ import annotations

import os
from collections.abc import Collection
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.memory import require_memory
from lumencut.base.paths import checked_path
from lumencut.dicom.reading.straightened_notes import note_sides
from lumencut.scene.volume_file import Filled, VolumeFile

_HEADER = "a file with a header"
_VOXELS = "a file of voxels"
_NOTHING = np.empty(0, np.uint8)


def open_grid(path: Path, chosen: Collection[int] | None = None) -> VolumeFile | None:
    """Return the header of a volume file; None for any other format.

    `chosen` are the numbers of the segments that are read of a segmentation of 3D Slicer.
    """
    plan = _plan(path, chosen)
    if plan is None:
        return None
    notes: list[str] = []
    remarks: list[str] = []
    note_sides(plan.description, notes, remarks)
    labels, details = dict(plan.label_names), {}
    if plan.segmentation is not None:
        details = dict(zip(("segmentation", "segments"), plan.segmentation, strict=True))
    elif labels:
        details = {"labels": "; ".join(f"{value} {name}" for value, name in labels.items())}
    kind, is_big = plan.stored
    dtype = np.dtype(kind).newbyteorder(">" if is_big else "<")
    ni, nj, nk = plan.size
    affine = np.eye(4)
    affine[:3] = plan.world_from_index
    return VolumeFile(
        path, plan.format, (ni, nj, nk), dtype, plan.space, affine,
        lambda progress, filled: _load(path, plan, filled), [*notes, *plan.notes],
        remarks=[*remarks, *plan.remarks], details=details, label_names=labels,
        states_spacing=plan.states_spacing, states_orientation=plan.states_orientation,
        settled_type=None if plan.settled is None else np.dtype(plan.settled),
        is_segmentation=plan.segmentation is not None, check_length=lambda: _check_length(path, plan),
    )  # fmt: skip


def _plan(path: Path, chosen: Collection[int] | None) -> _lumencut.VolumePlan | None:
    opening = _lumencut.VolumeOpening(path, path.name, None if chosen is None else list(chosen))
    home = path.parent.resolve()
    while not isinstance(need := opening.next(), (_lumencut.VolumePlan, type(None))):
        if isinstance(need, list):
            for name in need:
                place = path if name == path.name else path.parent / name
                is_outside = name != path.name and not place.resolve().is_relative_to(home)
                size = checked_path(place, _HEADER).stat().st_size if place.exists() else None
                opening.add_size(name, size, is_outside)
        else:
            name, start, end = need
            with checked_path(path.parent / name, _HEADER).open("rb") as file:
                file.seek(start)
                opening.add_bytes(name, start, file.read(end - start))
    return need


def _voxels_of(path: Path, plan: _lumencut.VolumePlan) -> Path:
    place = checked_path(path.parent / plan.voxels, _VOXELS)
    if not place.exists():
        raise plan.missing()
    return place


def _check_length(path: Path, plan: _lumencut.VolumePlan) -> bool:
    """Return whether the length of a file proves that it holds all voxels."""
    place = _voxels_of(path, plan)
    with place.open("rb") as file:
        fill = _Fill(plan, file)
        while (state := fill.step(_NOTHING))[0] != "sound":
            pass
    return bool(state[1])


def _load(path: Path, plan: _lumencut.VolumePlan, filled: Filled) -> npt.NDArray[Any]:
    """Return the voxels [k, j, i]; `filled` receives them and the number of complete slices."""
    place = _voxels_of(path, plan)
    data, voxels, known = _NOTHING, np.empty((0, 0, 0)), 0
    with place.open("rb") as file:
        fill, step = _Fill(plan, file), ""
        while step != "done":
            step, *details = fill.step(data)
            if step == "sound":
                require_memory(place, details[1])
            elif step == "room":
                require_memory(place, details[1])
                data = np.empty(details[1], np.uint8)
                voxels = data.view(details[0]).reshape(plan.size[::-1])
            elif len(data) and (complete := fill.written // (len(data) // len(voxels))) > known:
                known = complete
                filled(voxels, known)
    return voxels


class _Fill:
    """Reads the necessary parts of the file, and converts them to voxels."""

    def __init__(self, plan: _lumencut.VolumePlan, file: BinaryIO) -> None:
        self._fill = plan.fill(os.fstat(file.fileno()).st_size)
        self._file, self._start, self._bytes = file, 0, b""
        self.written = 0

    def step(self, data: npt.NDArray[np.uint8]) -> tuple[Any, ...]:
        """Perform and return a step of `VolumeFill`; if the step requests a part of the file, read it."""
        written, state = self._fill.step(self._start, self._bytes, data[self.written :])
        self.written += written
        if state[0] == "read":
            self._start, end = state[1], state[2]
            self._file.seek(self._start)
            self._bytes = self._file.read(end - self._start)
        return state
