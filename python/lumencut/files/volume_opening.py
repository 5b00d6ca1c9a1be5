"""Volume files: which reader opens a file; the headers are read, the voxels stay on disk."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterable
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from lumencut._lumencut import VOLUME_FILES as KNOWN
from lumencut.base.checks import integers
from lumencut.base.file_kinds import kind_of
from lumencut.base.foreign_errors import Progress, heeding, refusing
from lumencut.base.paths import checked_path
from lumencut.dicom.reading import Wanted, is_dicom, is_zip, open_dicom, opened
from lumencut.dicom.reading.files import read_files
from lumencut.dicom.web.address import is_address
from lumencut.errors import FileError, FormatError
from lumencut.files.grids import open_grid
from lumencut.files.ome_zarr.stores import is_ome_zarr, is_served
from lumencut.scene.volume_file import VolumeFile

_log = logging.getLogger("lumencut")
_HEAD = 352


def open_volume(
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
) -> VolumeFile:
    """Read the headers that `read_volume` reads, and leave the voxels on disk; parameters are the same."""
    counted = progress if progress is not None else silent
    wanted = wanted_of(series, phase, fill_gaps, resample_slices, segments, memory, channel, time_point)
    return open_wanted(path, wanted, counted)


def log_oddities(file: VolumeFile) -> None:
    """Log the assumptions about a file."""
    for note in file.notes:
        _log.warning("%s: %s", file.path, note)
    for remark in file.remarks:
        _log.info("%s: %s", file.path, remark)


def existing(given: str | os.PathLike[str]) -> Path:
    """Return a path that exists."""
    path = checked_path(given, KNOWN)
    if not path.exists():
        raise FileError(str(path), "no such file or folder", KNOWN)
    return path


def wanted_of(
    series: object,
    phase: object,
    fill_gaps: bool,
    resample_slices: bool,
    segments: Iterable[int] | None,
    *of_zarr: Any,
) -> Wanted:
    """Return the checked options of a reader."""
    chosen = None if segments is None else _numbers_of(segments)
    return Wanted(_text(series), _text(phase), fill_gaps, resample_slices, chosen, *of_zarr)


def _numbers_of(segments: Any) -> tuple[int, ...]:
    """Return the checked numbers of segments."""
    try:
        listed = list(segments)
    except TypeError as error:
        raise FormatError("segments", f"{segments!r:.80}", "numbers of segments") from error
    return integers(FormatError, "segments", listed, 1, 65535, len(listed))


def _text(value: object) -> str | None:
    return None if value is None else str(value)


def _is_pyramid(given: str | os.PathLike[str], wanted: Wanted) -> bool:
    """Return whether a path names an OME-Zarr image; reject options of the other kind of files."""
    is_pyramid = is_served(given) or (not is_address(given) and is_ome_zarr(checked_path(given, KNOWN)))
    for field in fields(Wanted):
        is_of_zarr = field.name in ("memory", "channel", "time_point")
        if is_of_zarr != is_pyramid and getattr(wanted, field.name) != field.default:
            kind = "DICOM or a segmentation" if is_pyramid else "OME-Zarr"
            raise FormatError(
                str(given), f"{field.name} for a file of another kind", kind, f"leave {field.name} out"
            )
    return is_pyramid


def open_wanted(given: str | os.PathLike[str], wanted: Wanted, progress: Progress) -> VolumeFile:
    """Choose the reader by content, or by name if the content is ambiguous."""
    if is_address(given):
        return _fetched(given, wanted, progress)
    if _is_pyramid(given, wanted):
        from lumencut.files.ome_zarr.opening import pyramid_file

        return pyramid_file(given, wanted).checked()
    path = existing(given)
    notes: list[str] = []
    with heeding(progress) as counted, refusing(path, "volume", notes):
        if path.is_dir() or _is_archive(path):
            return open_dicom(path, wanted, counted).checked()
        with path.open("rb") as opened_file:
            head = opened_file.read(_HEAD)
        if not head:
            raise FormatError(str(path), "an empty file", KNOWN, "copy or export it again")
        if is_dicom(head) and not head.startswith(b"NRRD"):
            file = open_dicom(path, wanted, counted)
        elif (grid := open_grid(path, wanted.segments)) is not None:
            file = grid
        else:
            raise _unknown(path)
        if wanted.segments is not None and not file.is_segmentation:
            raise _no_segmentation(path)
    file.notes.extend(note for note in notes if note not in file.notes)
    return file.checked()


def _fetched(given: str | os.PathLike[str], wanted: Wanted, progress: Progress) -> VolumeFile:
    """Return a volume of a PACS, whose files stay in a temporary folder as long as it exists."""
    from lumencut.dicom.web.source import fetched

    with heeding(progress) as counted:
        folder = fetched(given, wanted.series, counted)
        file = opened(Path(given), wanted, lambda notes: read_files(folder.path, notes, counted)).checked()
    return replace(file, holds=folder)


def _unknown(path: Path) -> FormatError:
    kind = kind_of(path)
    if kind is None:
        return FormatError(str(path), "a file of unknown format", KNOWN)
    is_readable = kind.role == "centerlines" and not kind.mend
    mend = "read centerlines with read_centerlines" if is_readable else kind.mend
    return FormatError(str(path), kind.name, KNOWN, mend)


def _no_segmentation(path: Path) -> FormatError:
    expected = "a segmentation (DICOM SEG, or .seg.nrrd of 3D Slicer), to choose segments"
    return FormatError(str(path), "no segmentation", expected, "leave out segments")


def _is_archive(path: Path) -> bool:
    with path.open("rb") as file:
        return is_zip(file.read(4))


def silent(done: int, total: int) -> None:
    """Ignore progress."""
