"""DICOM series with overlapping parts, copied files, one series per slice, or two patients."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from pydicom.dataset import Dataset

from dicom_codecs import gdcm_does
from dicom_enhanced import enhanced
from dicom_phantom import ROOT, Stored, save, single
from dicom_series import COUNT, LATE_STACK, PLAIN_STACK, Case, Made, Stack

Part = tuple[int, int]
GROUP = "repeated places, images and series"
SCALES = (Stored("u2", 16, 1.0, -1024.0), Stored("i2", 16, 1.0, 0.0))
"""Stored numbers of two kinds that stand for the same values."""


def acquired(
    parts: Sequence[Part], late: Sequence[int] = (), scales: Sequence[Stored] = SCALES[1:], **more: object
) -> Callable[[Path], Made]:
    """Put acquisitions of these ranges into one series; the acquisitions in `late` have other values."""

    def write(folder: Path) -> Made:
        number, read = 0, {}
        for n, (low, high) in enumerate(parts):
            for k in range(low, high):
                number += 1
                image = (LATE_STACK if n in late else PLAIN_STACK)[k]
                data = single(image, number, stored=scales[n % len(scales)])
                data.AcquisitionNumber = n + 2
                for keyword, value in more.items():
                    setattr(data, keyword, value)
                save(data, folder / f"IM{number:04}.dcm")
                read.setdefault(k, image)
        return Made(folder, [read[k] for k in sorted(read)])

    return write


def frames(folder: Path) -> Made:
    """A multi-frame image of two overlapping acquisitions whose values differ at the shared place."""
    data = enhanced([*PLAIN_STACK[:13], *LATE_STACK[12:]])
    for n, groups in enumerate(data.PerFrameFunctionalGroupsSequence):
        groups.FrameContentSequence[0].FrameAcquisitionNumber = 1 + (n >= 13)
    save(data, folder / "all.dcm")
    return Made(folder, PLAIN_STACK, None)


def part(parts: Sequence[Part], number: int, late: Sequence[int] = ()) -> Callable[[Path], Made]:
    """Several acquisitions; the one with this number is requested."""

    def write(folder: Path) -> Made:
        acquired(parts, late)(folder)
        low, high = parts[number]
        return Made(folder, list((LATE_STACK if number in late else PLAIN_STACK)[low:high]))

    return write


def own_series(k: int, data: Dataset) -> None:
    """Put each slice into its own series."""
    data.SeriesInstanceUID = f"{ROOT}.55.{k + 1}"


def own_frame(k: int, data: Dataset) -> None:
    """Put each slice into its own series and frame of reference, so that they form no scan."""
    own_series(k, data)
    data.FrameOfReferenceUID = f"{ROOT}.56.{k + 1}"


def own_numbers(k: int, data: Dataset) -> None:
    """Number each slice as another series of the study."""
    own_series(k, data)
    data.SeriesNumber = k + 1


def in_folders(folder: Path) -> Made:
    """Write a stack, and a copy of every file in a subfolder."""
    made = Stack(PLAIN_STACK)(folder)
    names = [path.name for path in folder.iterdir()]
    (folder / "copy").mkdir()
    for name in names:
        shutil.copy(folder / name, folder / "copy" / name)
    return made


def in_archive(folder: Path) -> Made:
    """A stack with copies in a zip archive."""
    (folder / "inside").mkdir()
    in_folders(folder / "inside")
    archive = shutil.make_archive(str(folder / "copies"), "zip", folder / "inside")
    shutil.rmtree(folder / "inside")
    return Made(Path(archive), PLAIN_STACK)


def compressed(folder: Path) -> Made:
    """A stack with copies of some images in another transfer syntax."""
    made = Stack(PLAIN_STACK)(folder)
    for k in (3, 4):
        path = folder / f"packed{k}.dcm"
        shutil.copy(folder / f"IM{k:04}.dcm", path)
        gdcm_does("JPEG2000Lossless")(path)
    return made


def changed(**values: object) -> Callable[[Path], Made]:
    """Write a stack, and a file with the UID of one of its images but other content."""

    def write(folder: Path) -> Made:
        made = Stack(PLAIN_STACK)(folder)
        data = single(LATE_STACK[5] if not values else PLAIN_STACK[5], 6)
        for keyword, value in values.items():
            setattr(data, keyword, value)
        save(data, folder / "other.dcm")
        return replace(made, wanted=None)

    return write


def of_patients(change: Callable[[int, Dataset], None]) -> Stack:
    """A stack whose slices may name several patients."""
    return Stack(PLAIN_STACK, change=change)


def two_ids(k: int, data: Dataset) -> None:
    """The last slices are another patient's."""
    data.PatientID = "P1" if k < 16 else "P2"


def padded(k: int, data: Dataset) -> None:
    """Write one patient in several spellings."""
    data.PatientID = ("P1", "P1 ", " P1", "P1  ")[k % 4]
    data.PatientName = ("Doe^Jane", "Doe^Jane^^^", "DOE^JANE", "Doe^Jane ")[k % 4]
    data.IssuerOfPatientID = ("", "Here")[k % 2]


OVERLAPS: dict[str, Sequence[Part]] = {
    "one place": [(0, 13), (12, 24)],
    "three places": [(0, 14), (11, 24)],
    "three acquisitions": [(0, 9), (8, 17), (14, 24)],
    "the upper part first": [(12, 24), (0, 13)],
    "the middle part last": [(0, 9), (15, 24), (8, 16)],
    "a stretch again": [(0, 24), (10, 14)],
}
REPEATED = [
    *(
        Case(f"overlap: {name}", GROUP, acquired(parts), notes=("overlapping parts are read as one scan",))
        for name, parts in OVERLAPS.items()
    ),
    Case("overlap: two ways of storing", GROUP, acquired([(0, 13), (12, 24)], scales=SCALES)),
    Case(
        "overlap: other values",
        GROUP,
        acquired([(0, 13), (12, 24)], late=[1]),
        ("25 slices at 24 positions, with different values: IM0013.dcm and IM0014.dcm", "overlapping parts"),
    ),
    Case(
        "overlap: frames of other values",
        GROUP,
        frames,
        ("all.dcm frame 13 and all.dcm frame 14; FrameAcquisitionNumber",),
    ),
    Case(
        "overlap: other values, one part asked for",
        GROUP,
        part([(0, 13), (12, 24)], 1, late=[1]),
        notes=("phase 3 lacks 12 of 24 positions",),
        phase="3",
    ),
    Case(
        "overlap: one part asked for",
        GROUP,
        part(OVERLAPS["three acquisitions"], 2),
        notes=("phase 4 lacks 14 of 24 positions",),
        phase="4",
    ),
    Case(
        "overlap: a gap between parts",
        GROUP,
        acquired([(0, 9), (8, 14), (16, 24)]),
        ("2 missing slices",),
    ),
    Case(
        "nothing tells slices of one place apart",
        GROUP,
        acquired([(0, 24), (0, 24)], AcquisitionNumber=1),
        notes=("one slice of each position is read",),
    ),
    Case(
        "nothing tells slices of one place and other values apart",
        GROUP,
        acquired([(0, 24), (4, 7)], late=[1], AcquisitionNumber=1),
        ("3 places|27 slices", "remove all but one slice at each position"),
    ),
    Case(
        "a series for each slice", GROUP, Stack(PLAIN_STACK, change=own_series), notes=("24 series of one",)
    ),
    Case(
        "a series and a space for each slice",
        GROUP,
        Stack(PLAIN_STACK, change=own_frame),
        ("24 series", "and 20 more"),
    ),
    Case(
        "a series and a number for each slice",
        GROUP,
        Stack(PLAIN_STACK, change=own_numbers),
        ("24 series", "and 20 more"),
    ),
    Case(
        "a series for each slice, of which one is missing",
        GROUP,
        Stack([PLAIN_STACK[k] for k in range(COUNT) if k != 6], change=own_series),
        ("1 missing slice",),
    ),
    Case("copies in a folder below", GROUP, in_folders, notes=("left out, 24 files",)),
    Case("copies in an archive", GROUP, in_archive, notes=("left out, 24 files",)),
    Case("copies in another transfer syntax", GROUP, compressed, notes=("left out, 2 files",)),
    Case("a copy with other pixels", GROUP, changed(), ("other.dcm", "SOPInstanceUID of IM0006", "values")),
    Case(
        "a copy at another place",
        GROUP,
        changed(ImagePositionPatient=["0", "0", "500"]),
        ("other.dcm", "different ImagePositionPatient"),
    ),
    Case("two patients", GROUP, of_patients(two_ids), ("'P1' in 16 images", "'P2' in 8", "one patient")),
    Case("one patient in several ways of writing", GROUP, of_patients(padded)),
]
