"""The study that images belong to, with what objects made from them repeat of it."""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from lumencut.base.foreign_errors import refusing
from lumencut.base.paths import checked_path
from lumencut.dicom.reading.files import read_files
from lumencut.dicom.reading.headers import Image, header_tags
from lumencut.dicom.reading.records import header_record
from lumencut.dicom.reading.sources import Source
from lumencut.errors import FileError, FormatError
from lumencut.scene.extents import Box, box_of_slices
from lumencut.scene.study import READ, Study

_EXPECTED = "a DICOM folder, file or zip archive"
_IMAGE_COMMENTS = 0x00204000
#: Largest number of series whose headers are read again.
_MOST_SERIES = 64


def study_of(images: Sequence[Image]) -> Study:
    """Return the study of images; the first one gives the repeated attributes.

    An unreadable attribute is omitted. Unusual values, such as an overlong name, do not matter to readers of
    the scan.
    """
    seen: dict[str, str] = {}
    studies: dict[str, None] = {}
    series: dict[tuple[str, str], Image] = {}
    for image in images:
        kind, uid, study, part = (
            str(image.header.get(f"{what}UID") or "")
            for what in ("SOPClass", "SOPInstance", "StudyInstance", "SeriesInstance")
        )
        seen.setdefault(uid, kind)
        studies[study] = None
        series.setdefault((study, part), image)
    instances = tuple((kind, uid) for uid, kind in seen.items() if uid and kind)
    header, *further = (_repeated(image.source) for image in _few(list(series.values())))
    return Study(header, instances, len(studies), tuple(further))


def _few(firsts: list[Image]) -> list[Image]:
    """The first images of some series: if each image is its own series, reading all would take too long."""
    return firsts[:: -(-len(firsts) // _MOST_SERIES)]


def _repeated(source: Source) -> Any:
    """The repeated attributes of the header of a file."""
    with refusing(source, "DICOM", []):
        return _readable(source.attributes(_tags()))


def comments_of(image: Image) -> str:
    """Return the comments of an image, which may name a patient; empty if unreadable."""
    try:
        return str(image.source.attributes([_IMAGE_COMMENTS]).get("ImageComments") or "")
    except Exception:  # pydicom raises almost any exception for damaged values
        return ""


def study_below(path: str | os.PathLike[str]) -> Study:
    """Return the one study of all DICOM files below a folder, in a zip archive, or of a single file.

    Its images are those of the scan if all belong to one series, else none, since the series of the scan is
    unknown.

    Raises
    ------
    FormatError
        Without a DICOM file.
    FileError
        For a path that is missing or cannot be read.
    """
    place = checked_path(path, _EXPECTED)
    if not place.exists():
        raise FileError(str(place), "no such file or folder", _EXPECTED)
    files = [file for file in read_files(place, []) if file.image is not None]
    if not files:
        raise FormatError(str(place), "no DICOM file", _EXPECTED)
    images = [file.image for file in files if file.image is not None]
    series = {str(image.header.get("SeriesInstanceUID") or "") for image in images}
    box = box_of_slices(file.record["header"] for file in files)
    study = replace(study_of(images), box=box)
    return study if len(series) == 1 else replace(study, instances=())


def study_in(header: bytes, instances: Sequence[str] = ()) -> Study:
    """Return the study that the header of one image names.

    Parameters
    ----------
    header : bytes
        A DICOM file, or its part before the pixels.
    instances : sequence of str, default ()
        The UIDs of all images of the scan, which are of the class of this one; without them only this one.

    Raises
    ------
    FormatError
        For bytes that are no DICOM.
    """
    import pydicom

    subject, of_image = "the DICOM file", ("SOPClassUID", "SOPInstanceUID")
    wanted = [*_tags(), *header_tags()]
    with refusing(subject, "DICOM", []):
        # Files without the preamble may be DICOM too: the content decides.
        read = pydicom.dcmread(io.BytesIO(header), stop_before_pixels=True, specific_tags=wanted, force=True)
        kind, own = (str(read.get(keyword) or "") for keyword in of_image)
        box = _box_in(read, len(header))
    if not kind:
        mend = "choose another file of the scan's folder"
        raise FormatError(subject, "a file that is not a DICOM image", "an image of the study", mend)
    uids = instances or ([own] if own else [])
    return Study(_readable(read), tuple((kind, uid) for uid in uids), box=box)


def _box_in(header: Any, size: int) -> Box | None:
    """The bounding box of the frames of one header; None if their places are unknown."""
    image = Image(Source(Path("header"), size), header, 0, "", "")
    try:
        return box_of_slices([header_record(image)])
    except Exception:  # pydicom raises almost any exception for damaged values
        return None


def _tags() -> list[int]:
    from pydicom.datadict import tag_for_keyword

    return [tag for keyword in READ if (tag := tag_for_keyword(keyword)) is not None]


def _readable(header: Any) -> Any:
    """The attributes whose values can be read, each as it was written."""
    from pydicom.dataset import Dataset

    kept = Dataset()
    for tag in sorted(set(_tags()) & set(header.keys())):
        try:
            kept[tag] = header[tag]
        except Exception:  # pydicom raises almost any exception for damaged values
            continue
    return kept
