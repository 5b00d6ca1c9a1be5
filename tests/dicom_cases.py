"""The list of all DICOM cases; `dicom_series.py` defines what a case is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from pydicom.dataset import Dataset
from pydicom.pixels import pack_bits
from pydicom.uid import MediaStorageDirectoryStorage, SegmentationStorage

import dicom_enhanced as multi
from dicom_multiframe import MULTIFRAME
from dicom_phantom import (
    ROOT,
    SIZE,
    SPACING,
    Image,
    Stored,
    axial,
    grid,
    images,
    instance,
    oblique,
    pixels,
    save,
    save_bare,
    single,
    tilted,
)
from dicom_series import (
    COUNT,
    LATE_STACK,
    PLAIN_STACK,
    Case,
    Made,
    Stack,
    acquisition,
    doubled,
    kernel,
    localiser,
    resampled,
    sets,
    shuffled,
    together,
    trigger,
    truncated,
    two_phases,
    zipped,
)
from dicom_values import VALUES

CORONAL = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]).astype(float)
SAGITTAL = np.array([[0, 0, -1], [1, 0, 0], [0, -1, 0]]).astype(float)


def helical(k: int, data: Dataset) -> None:
    """Give every slice its own acquisition time, as in spiral scans."""
    data.AcquisitionTime = data.ContentTime = f"1200{k:02}.5"


def rounded(k: int, data: Dataset) -> None:
    """Change the last digits of the direction cosines from slice to slice."""
    if k % 3:
        data.ImageOrientationPatient = ["1", "0", "0", "0", "0.9999999999", f"{k * 1e-7:.10f}"]


def two_stops(k: int, data: Dataset) -> None:
    """Scan one stack in two acquisitions, 30 s apart."""
    data.AcquisitionNumber = 1 + (k >= COUNT // 2)
    data.AcquisitionTime = data.ContentTime = f"1200{30 * (k >= COUNT // 2):02}"


def moved(gaps: dict[int, float]) -> list[Image]:
    """Return the axial stack with larger or smaller steps before some slices."""
    stack, shift = [], 0.0
    for k in range(COUNT):
        shift += gaps.get(k, 0.0)
        plane = PLAIN_STACK[k].plane.copy()
        plane[2, 3] += shift
        stack += images(plane, (*SIZE[:2], 1))
    return stack


def half_a_slice_up() -> list[Image]:
    """Put the slices of the late phase halfway between those of the early phase."""
    affine = axial()
    affine[2, 3] += 1.0
    return images(affine, contrast=120.0)


TWO_DISTANCES = moved({k: 1.0 * (k > 12) for k in range(COUNT)})
ONE_OFF = moved({9: 0.5, 10: -0.5})
ON_A_GRID = "unevenly spaced slices, with `--resample-slices`"
PLAIN = "plain stacks: axial, coronal, sagittal, oblique, any order"
_STACKS = {
    "axial": Stack(PLAIN_STACK, change=helical),
    "oblique": Stack(images(oblique())),
    "coronal": Stack(images(grid(SIZE, CORONAL, SPACING))),
    "sagittal": Stack(images(grid(SIZE, SAGITTAL, SPACING))),
    "from above downwards": Stack(PLAIN_STACK, number=lambda k: COUNT - k),
    "shuffled names": Stack(PLAIN_STACK, name=lambda k: f"{shuffled(COUNT)[k]:08x}"),
    "rows and columns of unequal spacing": Stack(images(axial(spacing=(0.6, 0.9, 2.0)))),
    "cosines that differ in the 6th digit": Stack(PLAIN_STACK, change=rounded),
    "two stops of the table": Stack(PLAIN_STACK, change=two_stops),
}


def leaning(degrees: float) -> Stack:
    """Write a series of a tilted gantry that states the tilt, as scanners do."""
    return Stack(images(tilted(degrees)), change=sets(GantryDetectorTilt=f"{degrees:g}"))


_GEOMETRY = [
    *(Case(name, PLAIN, stack) for name, stack in _STACKS.items()),
    *(Case(f"gantry tilt of {d:+}°", "gantry tilt", leaning(d), notes=("tilt",)) for d in (18, -18)),
    Case(
        "3 of 24 slices missing",
        "missing slices",
        Stack([PLAIN_STACK[k] for k in range(COUNT) if k not in (6, 13, 14)], wanted=None),
        ("3 missing slices",),
    ),
    Case("three slices twice", "doubled slices", doubled(PLAIN_STACK), notes=("left out, 3 files",)),
    Case(
        "slices 2 to 3 mm apart",
        "unevenly spaced slices",
        Stack(TWO_DISTANCES, wanted=None),
        ("uneven|missing",),
    ),
    Case(
        "one slice 0.5 mm off",
        "unevenly spaced slices",
        Stack(ONE_OFF, wanted=None),
        ("uneven",),
    ),
    Case(
        "slices 2 to 3 mm apart, on a grid",
        ON_A_GRID,
        resampled(TWO_DISTANCES, 1.0),
        resample_slices=True,
    ),
    Case("one slice 0.5 mm off, on a grid", ON_A_GRID, resampled(ONE_OFF, 0.5), resample_slices=True),
    Case(
        "phases of the heart",
        "two phases or kernels in one series",
        two_phases(PLAIN_STACK, LATE_STACK, trigger),
        ("phases",),
    ),
    Case(
        "phases of contrast, by acquisition alone",
        "two phases or kernels in one series",
        two_phases(PLAIN_STACK, LATE_STACK, acquisition),
        ("phases", "Acquisition"),
    ),
    Case(
        "two phases half a slice apart",
        "two phases or kernels in one series",
        two_phases(PLAIN_STACK, half_a_slice_up(), trigger),
        ("phases",),
    ),
    Case(
        "two kernels",
        "two phases or kernels in one series",
        two_phases(PLAIN_STACK, LATE_STACK, kernel),
        ("places|kernel",),
    ),
    Case(
        "no ImagePositionPatient",
        "no stated positions",
        Stack(PLAIN_STACK, change=sets(ImagePositionPatient=None), wanted=None),
        ("no ImagePositionPatient",),
    ),
    Case("last file cut off", "a truncated file", truncated(PLAIN_STACK), ("IM0024.dcm",)),
    Case("ZIP file", "DICOM in a ZIP file", zipped(PLAIN_STACK)),
]


def screenshot(folder: Path) -> list[Image]:
    """A secondary capture in colour."""
    data = instance(1, 21, "1.2.840.10008.5.1.4.1.1.7", "OT")
    data.ImageType, data.ConversionType = ["DERIVED", "SECONDARY"], "WSD"
    pixels(data, np.zeros((40, 50), np.uint8), Stored("u1", 8))
    data.SamplesPerPixel, data.PhotometricInterpretation, data.PlanarConfiguration = 3, "RGB", 0
    data.PixelData = np.random.default_rng(1).integers(0, 256, (40, 50, 3), np.uint8).tobytes()
    save(data, folder / "SCREEN.dcm")
    return []


def dose_report(folder: Path) -> list[Image]:
    """A structured report, which has no pixels."""
    data = instance(1, 22, "1.2.840.10008.5.1.4.1.1.88.67", "SR")
    data.SeriesDescription, data.CompletionFlag, data.VerificationFlag = (
        "Dose Report",
        "COMPLETE",
        "UNVERIFIED",
    )
    data.ValueType = "CONTAINER"
    save(data, folder / "DOSE.dcm")
    return []


def segmentation(folder: Path) -> list[Image]:
    """Write a mask of the vessel, which forms a stack but is not an angiography."""
    masks = [replace(one, values=(one.values > 150).astype(int)) for one in PLAIN_STACK]
    data = multi.enhanced(masks, lambda k: Stored("u1", 8))
    for keyword, value in (("SOPInstanceUID", ".24.1"), ("SeriesInstanceUID", ".1.24")):
        setattr(data, keyword, ROOT + value)
    data.SOPClassUID, data.Modality, data.SeriesNumber = SegmentationStorage, "SEG", 24
    data.ImageType, data.SegmentationType, data.SeriesDescription = ["DERIVED", "PRIMARY"], "BINARY", "vessel"
    data.file_meta.MediaStorageSOPClassUID = data.SOPClassUID
    data.file_meta.MediaStorageSOPInstanceUID = data.SOPInstanceUID
    data.BitsAllocated = data.BitsStored = 1
    data.HighBit = 0
    data.PixelData = pack_bits(np.stack([one.values for one in masks]).astype("u1"))
    save(data, folder / "SEG.dcm")
    return [replace(one, part="mask") for one in masks]


def bare(folder: Path) -> Made:
    """Write files without preamble, which start with their first element."""
    for k, image in enumerate(PLAIN_STACK):
        save_bare(single(image, k + 1), folder / f"IM{k + 1:04}")
    return Made(folder, PLAIN_STACK)


def junk(folder: Path) -> list[Image]:
    """Write other files that are often found in folders of images."""
    (folder / "README.txt").write_text("Thank you for choosing our hospital.")
    (folder / ".DS_Store").write_bytes(b"\0\0\0\1Bud1" + bytes(100))
    (folder / "._IM0001.dcm").write_bytes(b"\0\5\x16\7\0\2\0\0Mac OS X" + bytes(120))
    (folder / "EMPTY.dcm").touch()
    data = instance(1, 23, MediaStorageDirectoryStorage)
    data.FileSetID, data.DirectoryRecordSequence = "DISC", []
    save(data, folder / "DICOMDIR")
    return []


def named(stack: list[Image], part: str, series: int, thickness: float = 2.0) -> Stack:
    """One of several series in a folder."""
    return Stack(
        [replace(one, part=part) for one in stack],
        series=series,
        description=part,
        name=lambda k: f"S{series}I{k:03}.dcm",
        thickness=thickness,
    )


THICK = images(grid((64, 48, 5), CORONAL, (0.8, 0.8, 8.0)))
_STUDY = (
    localiser(1),
    named(PLAIN_STACK, "arterial", 11),
    named(LATE_STACK, "venous", 12),
    named(THICK, "MPR thick", 13, 8.0),
    screenshot,
    dose_report,
)
_FOLDERS = [
    Case(
        "localiser as a series of its own",
        "a localiser beside the stack",
        together(localiser(1), Stack(PLAIN_STACK), wanted="only"),
    ),
    Case(
        "localiser inside the series",
        "a localiser beside the stack",
        together(localiser(3, 101, same_series=True), Stack(PLAIN_STACK), wanted="only"),
        notes=("locali",),
    ),
    Case(
        "one volume, a screenshot, a dose report, a localiser",
        "several series in a folder",
        together(Stack(PLAIN_STACK), screenshot, dose_report, localiser(1), wanted="only"),
    ),
    Case(
        "several volumes",
        "several series in a folder",
        together(*_STUDY, wanted=None),
        ("series", "arterial", "venous"),
    ),
    Case(
        "several volumes, one asked for",
        "several series in a folder",
        together(*_STUDY, wanted="venous"),
        series="12",
    ),
    Case(
        "a segmentation beside the stack",
        "a segmentation beside the stack",
        together(Stack(PLAIN_STACK), segmentation, wanted="only"),
    ),
    Case("no preamble", "files without preamble and meta information", bare),
    Case(
        "junk among the files", "files that are no images", together(Stack(PLAIN_STACK), junk, wanted="only")
    ),
]


CASES = [
    *_GEOMETRY,
    *_FOLDERS,
    *VALUES,
    *MULTIFRAME,
]
assert len({case.name for case in CASES}) == len(CASES)
