"""DICOM: one series of grey images, in a folder, a zip archive or a single file, becomes one volume.

Pixels are decoded by pydicom and its plugins; geometry and rescaling are ours.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut._wording import counted, listed
from lumencut.series_report import SeriesReport
from lumencut.volume_files.dicom.faults import of_phase
from lumencut.volume_files.dicom.geometry import Stack, stacked
from lumencut.volume_files.dicom.headers import Image, is_dicom
from lumencut.volume_files.dicom.series import Series, chosen, grouped, read_images
from lumencut.volume_files.dicom.sources import is_zip
from lumencut.volume_files.dicom.values import load, settled_type
from lumencut.volume_files.opened import Filled, Progress, VolumeFile, refusing, shown
from lumencut.volume_files.rescale import is_integral

__all__ = ["Wanted", "is_dicom", "is_zip", "list_dicom_series", "open_dicom", "opened"]


@dataclass(frozen=True)
class Wanted:
    """What of a DICOM folder is to be read: which series and phase, and what is mended of it."""

    series: str | None = None
    phase: str | None = None
    fill_gaps: bool = False
    resample_slices: bool = False


def open_dicom(path: Path, wanted: Wanted, progress: Progress) -> VolumeFile:
    """Read the headers of a DICOM series; `progress` counts the files looked into."""
    return opened(path, wanted, lambda notes: read_images(path, notes, progress))


def opened(path: Path, wanted: Wanted, read: Callable[[list[str]], list[Image]]) -> VolumeFile:
    """Make one volume of the images that `read` gives, which takes the notes; `path` names them."""
    notes: list[str] = []
    with refusing(path, "DICOM", notes):
        one = chosen(path, grouped(read(notes)), wanted.series, notes)
        slices = one.slices(str(path), notes)
        if wanted.phase is not None:
            slices = of_phase(str(path), slices, wanted.phase)
        stack = stacked(str(path), slices, notes, fill_gaps=wanted.fill_gaps, resample=wanted.resample_slices)
        _note_oddities(stack, notes)
        stored = _stored_type(stack.slices[0].image)
        details = _details(one, stack)

    def voxels(progress: Progress, filled: Filled) -> npt.NDArray[Any]:
        return load(stack, notes, progress, filled)

    return VolumeFile(
        path, "DICOM", stack.size, stored, "LPS (as every DICOM)", stack.world_from_index, voxels, notes,
        filled=stack.missing, details=details, settled_type=settled_type(stack),
    )  # fmt: skip


def list_dicom_series(path: Path) -> list[SeriesReport]:
    """Describe all series below a folder, in a zip archive, or of a single file."""
    with refusing(path, "DICOM", []):
        return [one.report() for one in grouped(read_images(path, []))]


def _details(series: Series, stack: Stack) -> dict[str, str]:
    images = list({id(s.image): s.image for s in stack.slices}.values())
    return {
        "series": f"number {series.number or 'not stated'}, {series.description or 'no description'}",
        "series_uid": series.uid,
        "modality": series.modality,
        "files": str(len(images)),
        "pixels": listed(sorted({shown(image.transfer_syntax.name) for image in images})),
    }


def _stored_type(image: Image) -> np.dtype[Any]:
    signed = "i" if image.header.get("PixelRepresentation") else "u"
    kind = signed if image.pixel_keyword == "PixelData" else "f"
    return np.dtype(f"{kind}{int(image.header.BitsAllocated) // 8}")


def _note_oddities(stack: Stack, notes: list[str]) -> None:
    headers = {id(s.image): s.image.header for s in stack.slices}.values()
    scalings = {s.scaling for s in stack.slices}
    if stack.missing and not stack.is_resampled:
        names = listed([str(k) for k in stack.missing])
        notes.append(f"{counted(len(stack.missing), 'missing slice')} interpolated: k = {names}")
    if len(scalings) > 1:
        notes.append(f"{len(scalings)} different rescale slopes and intercepts: applied slice by slice")
    if not all(is_integral(*scaling) for scaling in scalings):
        notes.append("rescaling makes fractions: read as float32")
    if any("HighBit" in header and header.HighBit != header.get("BitsStored", 0) - 1 for header in headers):
        notes.append("HighBit is not BitsStored - 1: the lowest BitsStored bits are read")
    if any(str(header.get("LossyImageCompression", "")) == "01" for header in headers):
        notes.append("the images were compressed with loss")
    if any(header.PhotometricInterpretation == "MONOCHROME1" for header in headers):
        notes.append("MONOCHROME1 (meant to be shown inverted): values are read as they are")
    padding = sorted({shown(header.PixelPaddingValue) for header in headers if "PixelPaddingValue" in header})
    if padding:
        notes.append(f"stored value {', '.join(padding)} marks pixels outside the scan: read as they are")
