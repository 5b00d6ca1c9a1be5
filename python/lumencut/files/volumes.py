"""Volume files: one reader per format, and one entry point for all of them."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Unpack

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.foreign_errors import Progress
from lumencut.base.overlaps import OverlapError
from lumencut.base.rescale import slabs
from lumencut.base.series_report import SeriesReport
from lumencut.dicom.reading import (
    list_dicom_series,
)
from lumencut.dicom.web.address import is_address
from lumencut.files.volume_choice import VolumeOptions
from lumencut.files.volume_opening import (
    existing,
    log_oddities,
    open_volume,
    silent,
)
from lumencut.scene.images import as_volume
from lumencut.scene.volume import Volume
from lumencut.scene.volume_file import VolumeFile

__all__ = [
    "SeriesReport",
    "VolumeReport",
    "as_volume",
    "inspect_volume",
    "list_series",
    "log_oddities",
    "open_volume",
    "read_volume",
]

_log = logging.getLogger("lumencut")


@dataclass(frozen=True, eq=False)
class VolumeReport:
    """The content of a volume file.

    Attributes
    ----------
    path : Path
        The file or folder.
    format : str
        Such as ``NIfTI-1`` or ``DICOM``.
    size : tuple of 3 int
        Number of voxels along i, j, k.
    spacing : ndarray, shape (3,)
        Distance between neighbouring voxels along i, j, k (mm).
    dtype : numpy.dtype
        Type of the voxels as read; as stored if the values were not requested.
    space : str
        The patient space as the file states it.
    world_from_index : ndarray, shape (4, 4)
        Affine from index (i, j, k) to world (mm, LPS).
    value_range : tuple of 2 float, or None
        Smallest and largest finite value; None without finite values, or if values were not requested.
    details : dict of str
        Further facts: for DICOM the series, its modality, files and codec.
    filled_slices : tuple of int
        The indices k of slices that are missing and were interpolated.
    notes : tuple of str
        Anything unusual or assumed.
    """

    path: Path
    format: str
    size: tuple[int, int, int]
    spacing: npt.NDArray[np.float64]
    dtype: np.dtype[Any]
    space: str
    world_from_index: npt.NDArray[np.float64]
    value_range: tuple[float, float] | None
    details: dict[str, str]
    filled_slices: tuple[int, ...]
    notes: tuple[str, ...]


def read_volume(
    path: str | os.PathLike[str],
    *,
    series: str | int | None = None,
    phase: str | float | None = None,
    fill_gaps: bool = False,
    resample_slices: bool = False,
    segments: Iterable[int] | None = None,
    memory: int | None = None,
    channel: str | int | None = None,
    time_point: int | None = None,
    progress: Progress | None = None,
) -> Volume:
    """Read a volume; nothing is resampled unless requested, shear and flips are kept.

    Parameters
    ----------
    path : str or path
        A DICOM folder, file or zip archive, NIfTI, NRRD or MetaImage file; the address of a series or study
        in a PACS, ``dicomweb:https://HOST/ROOT/studies/UID/series/UID``; or an OME-Zarr folder, zip archive
        or address on this machine, whose axes x, y and z are taken as LPS.
    series : str or int, optional
        Number or UID of the DICOM series to read where a folder holds several. By default the only one
        that can be an angiography volume.
    phase : str or number, optional
        Which phase (or echo, or kernel) of a DICOM series that mixes several: the value of the attribute that
        distinguishes them, as listed by the error without this argument.
    fill_gaps : bool, default False
        Interpolate missing DICOM slices linearly between their neighbours instead of refusing the series;
        `Volume.filled_slices` lists them.
    resample_slices : bool, default False
        Put a DICOM series of uneven slice distances on a regular grid, linearly between neighbouring slices,
        instead of rejecting it. The grid has the largest distance of which all distances are multiples, where
        that makes at most four times as many slices as there are; else the smallest distance, or what makes
        four times as many. `Volume.filled_slices` lists the interpolated slices.
    segments : iterable of int, optional
        The numbers of the segments of a segmentation (DICOM SEG, or .seg.nrrd of 3D Slicer) that are read; by
        default all, which must not overlap then.
    memory : int, optional
        Most bytes of voxels of an OME-Zarr image in memory, 1 GB by default; other formats are read whole.
    channel : str or int, optional
        Name or number of the channel of an OME-Zarr image with several.
    time_point : int, optional
        Number of the time point of an OME-Zarr image with several.
    progress : callable, optional
        Called with (slices read, slices in all); for DICOM with (files looked into, files in all) before.

    Returns
    -------
    Volume
        For OME-Zarr a :class:`VolumePyramid`, whose voxels are read when they are needed. Otherwise:
        The voxels on their grid in world space (mm, LPS), integers wherever scaling leaves them exact, else
        float32 (float64 where they are stored so). A segmentation becomes a label map: each voxel has
        the number of its segment, or 0; fractional ones count from one half on. What was assumed is logged as
        a warning.

    Raises
    ------
    SeriesError
        A FormatError for several DICOM series without a choice; its `series` describes them.
    FormatError
        For an unknown format, damaged files, and data that is not one regular volume.
    FileError
        For a file that is missing or cannot be read.
    PacsError
        For a PACS that cannot be reached, rejects the request, or does not send the complete series.
    """
    counted = progress if progress is not None else silent
    file = open_volume(
        path,
        series=series,
        phase=phase,
        fill_gaps=fill_gaps,
        resample_slices=resample_slices,
        segments=segments,
        memory=memory,
        channel=channel,
        time_point=time_point,
        progress=progress,
    )
    volume = file.volume(counted)
    if not file.format.startswith("DICOM"):
        counted(volume.size[2], volume.size[2])
    log_oddities(file)
    return volume


def inspect_volume(
    path: str | os.PathLike[str],
    *,
    series: str | int | None = None,
    phase: str | float | None = None,
    fill_gaps: bool = False,
    resample_slices: bool = False,
    values: bool = True,
    memory: int | None = None,
    channel: str | int | None = None,
    time_point: int | None = None,
    progress: Progress | None = None,
) -> VolumeReport:
    """Report what a volume file holds, and anything unusual.

    Parameters
    ----------
    path : str or path
        A DICOM folder, file or zip archive, NIfTI, NRRD or MetaImage file.
    series : str or int, optional
        Number or UID of the DICOM series where a folder holds several.
    phase, fill_gaps, resample_slices, memory, channel, time_point
        As for `read_volume`.
    values : bool, default True
        Read the voxels too, to check them and find their range; False reads headers only.
    progress : callable, optional
        Called with (slices read, slices in all); for DICOM with (files looked into, files in all) before.

    Returns
    -------
    VolumeReport
        Format, grid, values and oddities.
    """
    file = open_volume(
        path,
        series=series,
        phase=phase,
        fill_gaps=fill_gaps,
        resample_slices=resample_slices,
        memory=memory,
        channel=channel,
        time_point=time_point,
        progress=progress,
    )
    return _report(file, _values(file, progress) if values else None)


def inspected_volume(
    path: str | os.PathLike[str],
    *,
    progress: Progress | None = None,
    **options: Unpack[VolumeOptions],
) -> tuple[VolumeReport, Volume]:
    """Return the report of `inspect_volume` and the volume, with the same parameters and errors."""
    file = open_volume(path, progress=progress, **options)
    volume = _values(file, progress)
    report = _report(file, volume)
    if volume is None:
        # A label map cannot hold overlapping segments, but the grid is known.
        volume = Volume(np.zeros(file.size[::-1], np.uint8), world_from_index=file.world_from_index)
    return report, volume


def _values(file: VolumeFile, progress: Progress | None) -> Volume | None:
    """Return the volume; if segments overlap, None and a note."""
    try:
        return file.volume(progress if progress is not None else silent)
    except OverlapError as error:
        file.notes.append(f"{error.found}; {error.mend}")
        return None


def _report(file: VolumeFile, volume: Volume | None) -> VolumeReport:
    """Return the content of a file; without its volume, only what the headers state."""
    dtype, value_range = file.dtype.newbyteorder("="), None
    if volume is not None:
        dtype, value_range = volume.array.dtype, _finite_range(volume.array, file.notes)
        cut_off = None if file.is_segmentation else _lumencut.cut_off_note(volume)
        file.notes.extend([cut_off] if cut_off else [])
    spacing = np.linalg.norm(file.world_from_index[:3, :3], axis=0)
    return VolumeReport(
        path=file.path,
        format=file.format,
        size=file.size,
        spacing=np.asarray(spacing, dtype=np.float64),
        dtype=dtype,
        space=file.space,
        world_from_index=file.world_from_index,
        value_range=value_range,
        details=file.details | file.slow_details(),
        filled_slices=file.filled,
        notes=(*file.notes, *file.remarks),
    )


def list_series(path: str | os.PathLike[str]) -> list[SeriesReport]:
    """Describe all DICOM series below a folder, in a zip archive, of a single file, or of a study in a PACS.

    Raises
    ------
    FormatError
        If no image is found, or a file is damaged.
    FileError
        For a path that is missing or cannot be read.
    PacsError
        For a PACS that cannot be reached, rejects the request, or does not send the complete study.
    """
    if is_address(path):
        from lumencut.dicom.web.source import fetched

        # Keep a reference while reading: the temporary folder is removed together with the last one.
        folder = fetched(path)
        return list_dicom_series(folder.path)
    return list_dicom_series(existing(path))


def _finite_range(array: npt.NDArray[Any], notes: list[str]) -> tuple[float, float] | None:
    low, high, odd = np.inf, -np.inf, 0
    for slab in slabs(array):
        finite = slab[np.isfinite(slab)] if array.dtype.kind == "f" else slab
        odd += slab.size - finite.size
        if finite.size:
            low, high = min(low, float(finite.min())), max(high, float(finite.max()))
    if odd:
        notes.append(f"{odd} of {array.size} voxels are not finite (NaN or infinite)")
    return (low, high) if low <= high else None
