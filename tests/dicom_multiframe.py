"""Cases with many images in one file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydicom.dataset import Dataset

import dicom_enhanced as multi
from dicom_codecs import LOSSLESS, Encoder, pydicom_does
from dicom_phantom import Image, images, oblique, tilted
from dicom_series import COUNT, LATE_STACK, PLAIN_STACK, Case, Made, quantised, shuffled
from dicom_values import slopes_of_slices


def frames(
    stack: list[Image], wanted: str | None = "only", encoder: Encoder | None = None, **options: Any
) -> Callable[[Path], Made]:
    """Return a function that writes one enhanced CT."""

    def write(folder: Path) -> Made:
        multi.write_enhanced(folder, multi.enhanced(stack, **options), encoder)
        return Made(folder, stack, wanted)

    return write


def by(
    writer: Callable[[Path, list[Image]], None],
    stack: list[Image] = PLAIN_STACK,
    wanted: str | None = "only",
) -> Callable[[Path], Made]:
    """Return a function that writes a given stack."""

    def write(folder: Path) -> Made:
        writer(folder, stack)
        return Made(folder, stack, wanted)

    return write


def one_object(make: Callable[[list[Image]], Dataset]) -> Callable[[Path, list[Image]], None]:
    """Write the object that a function makes from a stack."""
    return lambda folder, stack: multi.write_enhanced(folder, make(stack))


SEVERAL = "enhanced multi-frame in several files"
ENHANCED = "enhanced multi-frame: plain, any order, slopes, compressed"
BOTH = [
    *(replace(one, part="early") for one in PLAIN_STACK),
    *(replace(one, part="late") for one in LATE_STACK),
]
MULTIFRAME = [
    Case("enhanced", ENHANCED, frames(PLAIN_STACK)),
    Case("enhanced, frames shuffled", ENHANCED, frames(PLAIN_STACK, order=shuffled(COUNT))),
    Case(
        "enhanced, a slope for every frame",
        ENHANCED,
        frames(quantised(PLAIN_STACK, slopes_of_slices), scale=slopes_of_slices, order=shuffled(COUNT)),
    ),
    Case("enhanced, RLE", ENHANCED, frames(PLAIN_STACK, encoder=LOSSLESS["RLE"])),
    Case("enhanced, JPEG 2000", ENHANCED, frames(PLAIN_STACK, encoder=LOSSLESS["JPEG 2000 .90"])),
    Case("enhanced, JPEG lossless", ENHANCED, frames(PLAIN_STACK, encoder=LOSSLESS["JPEG lossless .70"])),
    Case(
        "enhanced, RLE with an extended offset table",
        ENHANCED,
        frames(PLAIN_STACK, encoder=pydicom_does("1.2.840.10008.1.2.5", encapsulate_ext=True)),
    ),
    Case("enhanced, oblique", ENHANCED, frames(images(oblique()))),
    Case("enhanced MR", ENHANCED, by(one_object(multi.magnetic))),
    Case("enhanced, nothing shared", ENHANCED, by(one_object(multi.nothing_shared))),
    Case("enhanced, split into two files", SEVERAL, by(multi.write_split)),
    Case("enhanced, one frame in each file", SEVERAL, by(multi.write_singles)),
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
