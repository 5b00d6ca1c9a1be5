"""DICOM files of a folder, an archive or a single file, with their headers."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from lumencut.base.foreign_errors import Progress, refusing
from lumencut.dicom.reading.headers import Image, read_header
from lumencut.dicom.reading.records import Record, header_record
from lumencut.dicom.reading.sources import Source, not_dicom, sources


@dataclass(frozen=True, eq=False)
class File:
    """A file that was examined: its header if it is DICOM, and the record of the header for the core."""

    source: Source
    image: Image | None
    record: Record


def read_files(path: Path, notes: list[str], progress: Progress | None = None) -> list[File]:
    """Read the headers of all files below a folder, in a zip archive, or of a single file.

    `progress` is called with (files looked into, files in all).
    """
    found = sources(path)
    files = []
    for number, source in enumerate(found, 1):
        with refusing(source, "DICOM", notes):
            files.append(recorded(source, read_header(source)))
        if progress is not None:
            progress(number, len(found))
    return files


def recorded(source: Source, image: Image | None) -> File:
    """Add the record of the header to a file; this reads every value."""
    if image is None:
        return File(source, None, {"name": source.name, "kind": not_dicom(source)})
    return File(source, image, {"name": source.name, "header": header_record(image)})
