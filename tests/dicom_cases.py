"""The list of all DICOM cases; `dicom_series.py` says what a case is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from pydicom.dataset import Dataset
from pydicom.uid import MediaStorageDirectoryStorage

import dicom_enhanced as multi
from dicom_codecs import BASELINE, LOSSLESS, LOSSY, pydicom_does
from dicom_phantom import (
    CENTER,
    HOUNSFIELD,
    SIZE,
    SPACING,
    Image,
    Stored,
    axial,
    grid,
    images,
    instance,
    pixels,
    save,
    textured,
    tilted,
)
from dicom_series import (
    Case,
    Made,
    Stack,
    acquisition,
    doubled,
    localiser,
    quantised,
    sets,
    shuffled,
    together,
    trigger,
    truncated,
    two_phases,
    zipped,
)

COUNT = SIZE[2]
PLAIN_STACK = images(axial())
LATE_STACK = images(axial(), contrast=120.0)
CORONAL = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]).astype(float)
SAGITTAL = np.array([[0, 0, -1], [1, 0, 0], [0, -1, 0]]).astype(float)


def oblique() -> np.ndarray:
    """Directions turned about two axes."""
    (a, b), rotation = (0.4, -0.7), np.eye(3)
    rotation[:2, :2] = [[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]
    return rotation @ [[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]]


def helical(k: int, data: Dataset) -> None:
    """Every slice of its own moment, as spiral scans are."""
    data.AcquisitionTime = data.ContentTime = f"1200{k:02}.5"


def two_stops(k: int, data: Dataset) -> None:
    """One stack scanned at two places of the table."""
    data.AcquisitionNumber = 1 + (k >= COUNT // 2)
    data.AcquisitionTime = data.ContentTime = f"1200{30 * (k >= COUNT // 2):02}"


def moved(gaps: dict[int, float]) -> list[Image]:
    """The axial stack with larger or smaller steps before some slices."""
    stack, shift = [], 0.0
    for k in range(COUNT):
        shift += gaps.get(k, 0.0)
        plane = PLAIN_STACK[k].plane.copy()
        plane[2, 3] += shift
        stack += images(plane, (*SIZE[:2], 1))
    return stack


def half_a_slice_up() -> list[Image]:
    """The late phase between the slices of the early one."""
    affine = axial()
    affine[2, 3] += 1.0
    return images(affine, contrast=120.0)


PLAIN = "plain stacks: axial, coronal, sagittal, oblique, any order"
_STACKS = {
    "axial": Stack(PLAIN_STACK, change=helical),
    "oblique": Stack(images(grid(SIZE, oblique(), SPACING))),
    "coronal": Stack(images(grid(SIZE, CORONAL, SPACING))),
    "sagittal": Stack(images(grid(SIZE, SAGITTAL, SPACING))),
    "from above downwards": Stack(PLAIN_STACK, number=lambda k: COUNT - k),
    "shuffled names": Stack(PLAIN_STACK, name=lambda k: f"{shuffled(COUNT)[k]:08x}"),
    "rows and columns of unequal spacing": Stack(images(axial(spacing=(0.6, 0.9, 2.0)))),
    "two stops of the table": Stack(PLAIN_STACK, change=two_stops),
}


def leaning(degrees: float) -> Stack:
    """A series of a tilted gantry, which states the tilt as scanners do."""
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
    Case("three slices twice", "doubled slices", doubled(PLAIN_STACK), ("copies of one image",)),
    Case(
        "slices 2 to 3 mm apart",
        "unevenly spaced slices",
        Stack(moved({k: 1.0 * (k > 12) for k in range(COUNT)}), wanted=None),
        ("uneven|missing",),
    ),
    Case(
        "one slice 0.5 mm off",
        "unevenly spaced slices",
        Stack(moved({9: 0.5, 10: -0.5}), wanted=None),
        ("uneven",),
    ),
    Case(
        "phases of the heart",
        "two phases in one series",
        two_phases(PLAIN_STACK, LATE_STACK, trigger),
        ("phases",),
    ),
    Case(
        "phases of contrast, by acquisition alone",
        "two phases in one series",
        two_phases(PLAIN_STACK, LATE_STACK, acquisition),
        ("phases", "Acquisition"),
    ),
    Case(
        "two phases half a slice apart",
        "two phases in one series",
        two_phases(PLAIN_STACK, half_a_slice_up(), trigger),
        ("phases",),
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


def junk(folder: Path) -> list[Image]:
    """What else lies in folders of images."""
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
        "junk among the files", "files that are no images", together(Stack(PLAIN_STACK), junk, wanted="only")
    ),
]


def whole_slopes(k: int) -> Stored:
    """Another slope for every slice."""
    return Stored("i2", 16, 1.0 + k % 3, -100.0 - k)


def fractions(k: int) -> Stored:
    """Slopes that make fractions, as in PET."""
    return Stored("i2", 16, 0.01 + 0.001 * k, 0.0)


def spoilt(bits: int) -> Stack:
    """Numbers of 12 bits whose other bits hold something else: an overlay, or no sign."""
    signed = not bits
    low, high = (-2048, 2047) if signed else (0, 4095)
    stack = textured(PLAIN_STACK, low, high)

    def change(k: int, data: Dataset) -> None:
        numbers = stack[k].values.astype("i2").view("u2") & 0x0FFF
        data.PixelData = (numbers | np.uint16(bits) * (numbers % 3 == 0).astype("u2")).tobytes()

    return Stack(stack, Stored("i2" if signed else "u2", 12), change)


def padded() -> Stack:
    """A round field of view with a number for outside."""
    j, i = np.indices((SIZE[1], SIZE[0]))
    outside = np.hypot(i - 31.5, j - 23.5) > 30
    stack = [replace(one, values=np.where(outside, -2000, one.values)) for one in PLAIN_STACK]
    return Stack(stack, change=sets(PixelPaddingValue=-2000))


_VALUES = {
    "a slope for every slice": Stack(quantised(PLAIN_STACK, whole_slopes), whole_slopes),
    "slopes that make fractions": Stack(quantised(PLAIN_STACK, fractions), fractions),
    "16 bits signed": Stack(textured(PLAIN_STACK, -32768, 32767)),
    "16 bits unsigned": Stack(textured(PLAIN_STACK, -1024, 64511), Stored("u2", 16, 1.0, -1024.0)),
    "12 bits unsigned": Stack(textured(PLAIN_STACK, -1024, 3071), HOUNSFIELD),
    "12 bits signed": Stack(textured(PLAIN_STACK, -2048, 2047), Stored("i2", 12)),
    "12 bits signed, upper bits without sign": spoilt(0),
    "12 bits unsigned, an overlay in the upper bits": spoilt(0x1000),
    "8 bits": Stack(textured(PLAIN_STACK, 0, 255), Stored("u1", 8)),
    "MONOCHROME1": Stack(PLAIN_STACK, change=sets(PhotometricInterpretation="MONOCHROME1")),
    "pixel padding": padded(),
}
_SMALL = textured(PLAIN_STACK[:5], -2000, 2000)
BYTES = Stored("u1", 8, 2.0, -100.0)


def _needs(name: str) -> str:
    return "imagecodecs" if name.startswith("HTJ2K") else ""


_CODECS = [
    *(
        Case(name, "transfer syntaxes without loss", Stack(_SMALL, encoder=encoder), needs=_needs(name))
        for name, encoder in LOSSLESS.items()
    ),
    *(
        Case(
            name,
            "transfer syntaxes with loss",
            Stack(PLAIN_STACK[:5], HOUNSFIELD, encoder=encoder),
            notes=("loss",),
            loss=3.0,
            needs=_needs(name),
        )
        for name, encoder in LOSSY.items()
    ),
    Case(
        "JPEG baseline, 8 bits",
        "transfer syntaxes with loss",
        Stack(quantised(PLAIN_STACK[:5], lambda k: BYTES), BYTES, encoder=BASELINE),
        notes=("loss",),
        loss=6.0,
    ),
]


def frames(stack: list[Image], wanted: str | None = "only", encoder=None, **options) -> object:
    """A writer of one enhanced CT."""

    def write(folder: Path) -> Made:
        multi.write_enhanced(folder, multi.enhanced(stack, **options), encoder)
        return Made(folder, stack, wanted)

    return write


def by(writer, stack: list[Image] = PLAIN_STACK, wanted: str | None = "only") -> object:
    """A writer that is told the stack."""

    def write(folder: Path) -> Made:
        writer(folder, stack)
        return Made(folder, stack, wanted)

    return write


ENHANCED = "enhanced multi-frame: plain, any order, slopes, compressed"
BOTH = [
    *(replace(one, part="early") for one in PLAIN_STACK),
    *(replace(one, part="late") for one in LATE_STACK),
]
_MULTI = [
    Case("enhanced", ENHANCED, frames(PLAIN_STACK)),
    Case("enhanced, frames shuffled", ENHANCED, frames(PLAIN_STACK, order=shuffled(COUNT))),
    Case(
        "enhanced, a slope for every frame",
        ENHANCED,
        frames(quantised(PLAIN_STACK, whole_slopes), scale=whole_slopes, order=shuffled(COUNT)),
    ),
    Case("enhanced, RLE", ENHANCED, frames(PLAIN_STACK, encoder=LOSSLESS["RLE"])),
    Case("enhanced, JPEG 2000", ENHANCED, frames(PLAIN_STACK, encoder=LOSSLESS["JPEG 2000 .90"])),
    Case("enhanced, JPEG lossless", ENHANCED, frames(PLAIN_STACK, encoder=LOSSLESS["JPEG lossless .70"])),
    Case(
        "enhanced, RLE with an extended offset table",
        ENHANCED,
        frames(PLAIN_STACK, encoder=pydicom_does("1.2.840.10008.1.2.5", encapsulate_ext=True)),
    ),
    Case("enhanced, oblique", ENHANCED, frames(images(grid(SIZE, oblique(), SPACING)))),
    Case("enhanced, split into two files", "enhanced multi-frame in two files", by(multi.write_split)),
    Case("enhanced, tilted", "enhanced multi-frame, tilted", frames(images(tilted(18))), notes=("tilt",)),
    Case(
        "enhanced, two phases",
        "enhanced multi-frame, two phases",
        frames(BOTH, None, phases=[1] * COUNT + [2] * COUNT),
        ("phases",),
    ),
    Case(
        "enhanced, 3 of 24 frames missing",
        "enhanced multi-frame, missing frames",
        frames([PLAIN_STACK[k] for k in range(COUNT) if k not in (6, 13, 14)], None),
        ("3 missing",),
    ),
    Case("legacy converted", "legacy-converted enhanced CT", by(multi.write_legacy)),
    Case(
        "legacy converted by highdicom",
        "legacy-converted enhanced CT",
        by(multi.write_legacy_by_highdicom),
        needs="highdicom",
    ),
    Case(
        "frames without a place",
        "old multi-frame without positions",
        by(multi.write_old_multiframe, wanted=None),
        ("10 frames",),
    ),
]

CASES = [
    *_GEOMETRY,
    *_FOLDERS,
    *(Case(name, "rescaling, bits, MONOCHROME1, padding", stack) for name, stack in _VALUES.items()),
    *_CODECS,
    *_MULTI,
]
assert len({case.name for case in CASES}) == len(CASES)
assert CENTER.shape == (3,)
