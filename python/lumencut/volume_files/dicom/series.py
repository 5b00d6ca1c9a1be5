"""The series of a folder, archive or file: listed with what they are, and the one that is read."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lumencut._wording import counted, listed
from lumencut.errors import FormatError, SeriesError
from lumencut.series_report import SeriesReport
from lumencut.volume_files.dicom.geometry import stacked
from lumencut.volume_files.dicom.headers import Header, Image, read_header
from lumencut.volume_files.dicom.slices import (
    Slice,
    has_positions,
    is_localizer,
    missing_positions,
    require_grey,
    slices_of,
)
from lumencut.volume_files.dicom.sources import Source, not_dicom, sources
from lumencut.volume_files.opened import Progress, refusing

_MODALITIES = ("CT", "MR", "XA")
"""Of which a stack can be an angiography volume."""
_FEWEST_SLICES = 3
_DIRECTORY = "Media Storage Directory"


@dataclass(frozen=True, eq=False)
class Series:
    """The images of one series."""

    uid: str
    images: Sequence[Image]

    @property
    def number(self) -> str:
        """Its number, empty where it is not stated."""
        return _plain(text(self.images[0].header, "SeriesNumber"))

    @property
    def description(self) -> str:
        """Its description, empty where it is not stated."""
        return text(self.images[0].header, "SeriesDescription")

    @property
    def modality(self) -> str:
        """Its modality, empty where it is not stated."""
        return text(self.images[0].header, "Modality")

    def slices(self, subject: str, notes: list[str]) -> list[Slice]:
        """All slices of the series; localisers among them are left out where others are there."""
        images = self.images
        scouts = [image for image in images if image.frame_count == 1 and is_localizer(image, 0)]
        if scouts and len(scouts) < len(images):
            images = [image for image in images if image not in scouts]
            notes.append(f"left out, localisers: {listed([image.source.name for image in scouts])}")
        for image in images:
            with refusing(image.source, "DICOM", notes):
                require_grey(image)
        if missing := missing_positions(images):
            total = sum(image.frame_count for image in images)
            without = f"{len(missing)} of {counted(total, 'image')}"
            found = f"no ImagePositionPatient in {without}: {listed(missing)}"
            raise FormatError(subject, found, "a position for each slice", "leave those images out")
        placed: list[Slice] = []
        for image in images:
            with refusing(image.source, "DICOM", notes):
                placed += slices_of(image)
        return placed

    def report(self) -> SeriesReport:
        """Describe the series, and tell whether it may be an angiography volume."""
        count = sum(image.frame_count for image in self.images)
        size = spacing = None
        trouble = odd = _why_no_angiography(self, count)
        try:
            # A stack with holes is a volume that one slice is missing from: it is to be named, not passed by.
            stack = stacked("", self.slices("", []), [], fill_gaps=True)
            size = stack.size
            steps = np.linalg.norm(stack.world_from_index[:3, :3], axis=0)
            spacing = (float(steps[0]), float(steps[1]), float(steps[2]))
            if not odd and stack.missing:
                trouble = counted(len(stack.missing), "missing slice")
        except (FormatError, ValueError, TypeError) as error:
            trouble = odd or (error.found if isinstance(error, FormatError) else "damaged attributes")
        return SeriesReport(
            number=self.number,
            uid=self.uid,
            description=self.description,
            modality=self.modality,
            images=count,
            size=size,
            spacing=spacing,
            can_be_volume=not odd,
            trouble=trouble,
        )


def text(header: Header, keyword: str) -> str:
    """An attribute as one printable line."""
    value = header.get(keyword)
    shown = "" if value is None else " ".join(str(value).split())
    return "".join(letter for letter in shown if letter.isprintable())[:64]


def _plain(number: str) -> str:
    """A number without the zeros or the sign before it."""
    return str(int(number)) if re.fullmatch(r"[+-]?[0-9]{1,64}", number) else number


def _why_no_angiography(series: Series, count: int) -> str:
    """Why a series is surely none; empty if it may be one, even one that cannot be read as it is."""
    header = series.images[0].header
    if series.modality not in _MODALITIES:
        return f"modality {series.modality or 'not stated'}"
    if "Segmentation" in kind(header):
        return "a segmentation"
    if "Secondary Capture" in kind(header) or int(header.get("SamplesPerPixel") or 1) != 1:
        return "screenshots"
    if all(is_localizer(image, 0) for image in series.images):
        return "a localiser"
    if count < _FEWEST_SLICES:
        return f"fewer than {_FEWEST_SLICES} images"
    if not any(map(has_positions, series.images)):
        return "no positions"
    return ""


def read_images(path: Path, notes: list[str], progress: Progress | None = None) -> list[Image]:
    """Read the headers of all images below a folder, in a zip archive, or of a single file.

    `progress` is called with (files looked into, files in all).
    """
    found = sources(path)

    def headers() -> Iterator[tuple[Source, Image | None]]:
        for number, source in enumerate(found, 1):
            image = read_header(source, notes)
            if progress is not None:
                progress(number, len(found))
            yield source, image

    return with_pixels_alone(path, headers(), notes)


def with_pixels_alone(
    path: Path, found: Iterable[tuple[Source, Image | None]], notes: list[str]
) -> list[Image]:
    """The images among what was found, None for what is no DICOM; the others are noted."""
    images: list[Image] = []
    foreign: list[str] = []
    for source, image in found:
        if image is not None and image.header.get("Rows") and image.header.get("Columns"):
            images.append(image)
        elif image is not None and kind(image.header).endswith("Image Storage"):
            raise FormatError(
                str(source), "an image without rows and columns", "a whole file", "copy the file again"
            )
        else:
            what = kind(image.header) if image is not None else not_dicom(source)
            foreign.append(f"{source.name} ({what})")
    if not images:
        held = f"no image: {listed(foreign)}" if foreign else "nothing in it"
        mend = "give the folder that it is in" if foreign and _DIRECTORY in foreign[0] else ""
        raise FormatError(str(path), held, "DICOM images", mend)
    if foreign:
        notes.append(f"left out, no images: {listed(foreign)}")
    return images


def kind(header: Header) -> str:
    """The name of what the instance is, such as ``CT Image Storage``."""
    uid = header.get("SOPClassUID") or header.file_meta.get("MediaStorageSOPClassUID")
    name = str(getattr(uid, "name", ""))
    return name if uid and name != uid else "DICOM of no known kind"


def grouped(images: Iterable[Image]) -> list[Series]:
    """Put images of one series together, in the order in which the series appear."""
    groups: dict[str, list[Image]] = defaultdict(list)
    for image in images:
        groups[text(image.header, "SeriesInstanceUID")].append(image)
    return [Series(uid, group) for uid, group in groups.items()]


def chosen(path: Path, every: Sequence[Series], wanted: str | None, notes: list[str]) -> Series:
    """The series that is asked for, the only one, or the only one that can be an angiography volume."""
    if wanted is not None:
        meant = [one for one in every if wanted in (one.uid, one.number) or _plain(wanted) == one.number]
        if len(meant) != 1:
            raise _not_one(path, meant or every, f"one series with the number or UID {wanted!r}")
        return meant[0]
    if len(every) == 1:
        return every[0]
    reports = [one.report() for one in every]
    candidates = [n for n, report in enumerate(reports) if report.can_be_volume]
    if len(candidates) != 1:
        raise _not_one(path, every, "one series")
    others = [str(report) for n, report in enumerate(reports) if n not in candidates]
    notes.append(f"of {len(every)} series the only angiography volume is read: {reports[candidates[0]]}")
    notes.append(f"other series: {listed(others)}")
    return every[candidates[0]]


def _not_one(path: Path, every: Sequence[Series], expected: str) -> SeriesError:
    reports = tuple(one.report() for one in every)
    found = f"{len(reports)} series: {'; '.join(map(str, reports))}"
    mend = "give the folder of one series, or its number or UID as `series`"
    error = SeriesError(str(path), found, expected, mend)
    error.series = reports
    return error
