"""Volume files: which reader opens a file; the headers are read, the voxels stay on disk."""

from __future__ import annotations

import logging
import os
from dataclasses import fields, replace
from pathlib import Path
from typing import Unpack

from lumencut._lumencut import VOLUME_FILES as KNOWN
from lumencut.base.checks import callback
from lumencut.base.file_kinds import kind_of
from lumencut.base.foreign_errors import Progress, heeding, refusing
from lumencut.base.paths import checked_path
from lumencut.dicom.reading import DicomChoice, is_dicom, is_zip, open_dicom, opened
from lumencut.dicom.reading.files import read_files
from lumencut.dicom.web.address import is_address
from lumencut.errors import FileError, FormatError
from lumencut.files.grids import open_grid
from lumencut.files.ome_zarr.stores import is_ome_zarr, is_served
from lumencut.files.volume_choice import VolumeChoice, VolumeOptions, checked_choice
from lumencut.scene.volume_file import VolumeFile

_log = logging.getLogger("lumencut")
_HEAD = 352


def open_volume(
    path: str | os.PathLike[str],
    *,
    progress: Progress | None = None,
    **options: Unpack[VolumeOptions],
) -> VolumeFile:
    """Read the headers that `read_volume` reads, and leave the voxels on disk; parameters are the same."""
    callback(FormatError, "progress", progress)
    return open_chosen(path, checked_choice(options), progress if progress is not None else silent)


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


def _is_pyramid(given: str | os.PathLike[str], chosen: VolumeChoice) -> bool:
    """Return whether a path names an OME-Zarr image; reject options of the other kind of files."""
    is_pyramid = is_served(given) or (not is_address(given) and is_ome_zarr(checked_path(given, KNOWN)))
    needless = chosen.dicom if is_pyramid else chosen.zarr
    for field in fields(needless):
        if getattr(needless, field.name) is not field.default:
            kind = "DICOM or a segmentation" if is_pyramid else "OME-Zarr"
            raise FormatError(
                str(given), f"{field.name} for a file of another kind", kind, f"leave {field.name} out"
            )
    return is_pyramid


def open_chosen(given: str | os.PathLike[str], chosen: VolumeChoice, progress: Progress) -> VolumeFile:
    """Choose the reader by content, or by name if the content is ambiguous."""
    if _is_pyramid(given, chosen):
        from lumencut.files.ome_zarr.opening import pyramid_file

        return pyramid_file(given, chosen.zarr).checked()
    if is_address(given):
        return _fetched(given, chosen.dicom, progress)
    path = existing(given)
    notes: list[str] = []
    with heeding(progress) as counted, refusing(path, "volume", notes):
        if path.is_dir() or _is_archive(path):
            return open_dicom(path, chosen.dicom, counted).checked()
        with path.open("rb") as opened_file:
            head = opened_file.read(_HEAD)
        if not head:
            raise FormatError(str(path), "an empty file", KNOWN, "copy or export it again")
        if is_dicom(head) and not head.startswith(b"NRRD"):
            file = open_dicom(path, chosen.dicom, counted)
        elif (grid := open_grid(path, chosen.dicom.segments)) is not None:
            file = grid
        else:
            raise _unknown(path)
        if chosen.dicom.segments is not None and not file.is_segmentation:
            raise _no_segmentation(path)
    file.notes.extend(note for note in notes if note not in file.notes)
    return file.checked()


def _fetched(given: str | os.PathLike[str], chosen: DicomChoice, progress: Progress) -> VolumeFile:
    """Return a volume of a PACS, whose files stay in a temporary folder as long as it exists."""
    from lumencut.dicom.web.source import fetched

    with heeding(progress) as counted:
        folder = fetched(given, chosen.series, counted)
        file = opened(Path(given), chosen, lambda notes: read_files(folder.path, notes, counted)).checked()
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
