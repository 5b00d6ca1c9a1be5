"""DICOM files of a folder → the headers of the images of one series."""

from __future__ import annotations

import io
from collections import defaultdict
from pathlib import Path
from typing import Any

from lumencut.errors import FormatError
from lumencut.volume_files.opened import refusing

Header = Any
"""A pydicom Dataset that holds the attributes below, without pixels."""

# fmt: off
_KEYWORDS = (
    "SOPClassUID", "SOPInstanceUID", "ImageType", "Modality", "SeriesDescription", "SeriesInstanceUID",
    "SeriesNumber", "InstanceNumber", "Rows", "Columns", "NumberOfFrames", "SamplesPerPixel",
    "PhotometricInterpretation", "BitsAllocated", "BitsStored", "PixelRepresentation",
    "PixelPaddingValue", "RescaleSlope", "RescaleIntercept", "ModalityLUTSequence",
    "LossyImageCompression", "PixelSpacing", "ImagePositionPatient", "ImageOrientationPatient",
    "SliceThickness", "SpacingBetweenSlices", "GantryDetectorTilt", "SharedFunctionalGroupsSequence",
    "AcquisitionNumber", "AcquisitionTime", "ContentTime", "TriggerTime",
    "NominalPercentageOfCardiacPhase", "TemporalPositionIdentifier", "EchoNumbers", "EchoTime",
)
# fmt: on
_MENTIONED = 4


class BoundedFile(io.BufferedReader):
    """A file that never sets aside more memory than it has bytes left, whatever length an element claims."""

    def __init__(self, path: Path) -> None:
        super().__init__(io.FileIO(path))
        self._size = path.stat().st_size

    def read(self, size: int | None = -1, /) -> bytes:
        """Read up to size bytes, or all that is left."""
        left = max(self._size - self.tell(), 0)
        return super().read(left if size is None or size < 0 else min(size, left))


def is_dicom(head: bytes) -> bool:
    """Tell DICOM by the first bytes (at least 132) of a file: the preamble, or a bare identifying group."""
    return head[128:132] == b"DICM" or (head[:2] in (b"\x08\x00", b"\x02\x00") and head[3:4] == b"\x00")


def image_headers(path: Path, series: str | None, notes: list[str]) -> list[tuple[Path, Header]]:
    """Read the headers of all images of the one series below a folder, or of a single file."""
    files = [path] if path.is_file() else sorted(file for file in path.rglob("*") if file.is_file())
    images: list[tuple[Path, Header]] = []
    foreign: list[str] = []
    for file in files:
        header = _header(file, notes)
        if header is not None and header.get("Rows") and header.get("Columns"):
            images.append((file, header))
        elif header is not None and _kind(header).endswith("Image Storage"):
            raise FormatError(
                str(file), "an image without rows and columns", "a whole file", "copy the file again"
            )
        else:
            foreign.append(f"{file.name} ({_kind(header) if header is not None else 'no DICOM'})")
    if not images:
        found = f"no image: {listed(foreign)}" if files else "an empty folder"
        raise FormatError(str(path), found, "a folder of DICOM images")
    if foreign:
        notes.append(f"left out, no images: {listed(foreign)}")
    return _one_series(path, images, series)


def listed(names: list[str]) -> str:
    """Give the first few names and how many more there are."""
    tail = f" and {len(names) - _MENTIONED} more" if len(names) > _MENTIONED else ""
    return ", ".join(names[:_MENTIONED]) + tail


def _header(file: Path, notes: list[str]) -> Header | None:
    import pydicom

    with refusing(file, "DICOM", notes):
        with BoundedFile(file) as stream:
            if not is_dicom(stream.read(132)):
                return None
            stream.seek(0)
            header = pydicom.dcmread(
                stream, stop_before_pixels=True, force=True, specific_tags=list(_KEYWORDS)
            )
        for keyword in _KEYWORDS:
            header.get(keyword)
        return header


def _kind(header: Header) -> str:
    """The name of what the instance is, such as ``CT Image Storage``."""
    uid = header.get("SOPClassUID") or header.file_meta.get("MediaStorageSOPClassUID")
    return str(getattr(uid, "name", None) or "DICOM of no stated kind")


def _one_series(
    path: Path, images: list[tuple[Path, Header]], wanted: str | None
) -> list[tuple[Path, Header]]:
    groups: dict[str, list[tuple[Path, Header]]] = defaultdict(list)
    for file, header in images:
        groups[str(header.get("SeriesInstanceUID", ""))].append((file, header))
    if wanted is not None:
        meant = {
            uid: group
            for uid, group in groups.items()
            if wanted in (uid, str(group[0][1].get("SeriesNumber", "")))
        }
        if len(meant) != 1:
            raise _not_one(path, meant or groups, f"one series with the number or UID {wanted!r}")
        groups = meant
    if len(groups) > 1:
        raise _not_one(path, groups, "one series")
    return next(iter(groups.values()))


def _not_one(path: Path, groups: dict[str, list[tuple[Path, Header]]], expected: str) -> FormatError:
    lines = []
    for uid, group in groups.items():
        header = group[0][1]
        number, about, modality = (
            str(header.get(keyword) or "not stated")
            for keyword in ("SeriesNumber", "SeriesDescription", "Modality")
        )
        count = f"{len(group)} image{'s' if len(group) > 1 else ''}"
        lines.append(f"number {number} ({about}, {modality}, {count}, UID {uid or 'not stated'})")
    mend = "give the folder of one series, or its number or UID as `series`"
    return FormatError(str(path), f"{len(groups)} series: {'; '.join(lines)}", expected, mend)
