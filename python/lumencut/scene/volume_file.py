"""A volume whose headers are read: the result of every reader of this package."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.foreign_errors import Progress, heeding, refusing
from lumencut.errors import FormatError, VolumeError
from lumencut.scene.patients import Patient
from lumencut.scene.scan_details import ScanDetails
from lumencut.scene.study import Study
from lumencut.scene.volume import Volume

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
    load: Callable[[Progress, Filled], npt.NDArray[Any] | Volume]
    """Reads the voxels, or returns a volume that reads them when they are needed."""
    notes: list[str] = field(default_factory=list)
    filled: tuple[int, ...] = ()
    details: dict[str, str] = field(default_factory=dict)
    scan: ScanDetails = field(default_factory=ScanDetails)
    slow_details: Callable[[], dict[str, str]] = dict
    """Further details, which take long to find."""
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
        if isinstance(voxels, Volume):
            return voxels
        volume = _placed(self, voxels)
        volume._frame_of_reference, volume._is_segmentation = self.frame_of_reference, self.is_segmentation
        volume._label_names = self.label_names
        volume._filled_slices, volume._scan, volume._study = self.filled, self.scan, self.study
        volume._patient = self.patient
        return volume

    def checked(self) -> VolumeFile:
        """Reject a grid that no volume can have before any voxel is read, and note a doubtful size."""
        _placed(self, np.zeros((1, 1, 1), np.uint8))
        doubt = _lumencut.doubted_grid(self.size, self.world_from_index[:3].tolist())
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
