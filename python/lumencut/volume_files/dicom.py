"""DICOM: one series of single-frame grey images, in a folder or a single file, becomes one volume.

Pixels are decoded by pydicom and its plugins; geometry and rescaling are ours.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError
from lumencut.volume_files.dicom_geometry import Slice, placed, require_alike, stacked
from lumencut.volume_files.dicom_headers import Header, image_headers
from lumencut.volume_files.dicom_pixels import PixelReader
from lumencut.volume_files.opened import Progress, VolumeFile, refusing
from lumencut.volume_files.rescale import holding, is_integral, rescaled


def open_dicom(path: Path, series: str | None = None) -> VolumeFile:
    """Read the headers of a DICOM series."""
    notes: list[str] = []
    slices = []
    for file, header in image_headers(path, series, notes):
        with refusing(file, "DICOM", notes):
            _require_grey(file, header)
            slices.append(placed(file, header))
    require_alike(path, slices)
    ordered, affine = stacked(path, slices, notes)
    _note_oddities(ordered, notes)
    first = ordered[0].header
    size = (int(first.Columns), int(first.Rows), len(ordered))

    def load(progress: Progress) -> npt.NDArray[Any]:
        return _load(ordered, notes, progress)

    return VolumeFile(path, "DICOM", size, _stored_type(first), "LPS (as every DICOM)", affine, load, notes)


def _require_grey(path: Path, header: Header) -> None:
    """Refuse every kind of image that is not one slice of single numbers."""
    if not all(isinstance(length, int) for length in (header.Rows, header.Columns)):
        raise FormatError(str(path), f"Rows {header.Rows}, Columns {header.Columns}", "a number each")
    frames = int(header.get("NumberOfFrames") or 1)
    if frames != 1 or "SharedFunctionalGroupsSequence" in header:
        found = f"a multi-frame image of {frames} frames"
        raise FormatError(
            str(path), found, "one slice per file", "convert it to single-frame DICOM, NIfTI or NRRD"
        )
    photometric = str(header.get("PhotometricInterpretation", ""))
    if int(header.get("SamplesPerPixel") or 1) != 1 or not photometric.startswith("MONOCHROME"):
        kind = "a palette" if "PALETTE" in photometric else "a colour"
        found = f"{kind} image (PhotometricInterpretation {photometric or 'not stated'})"
        raise FormatError(str(path), found, "MONOCHROME2")
    if header.get("ModalityLUTSequence"):
        raise FormatError(
            str(path), "values behind a modality look-up table", "RescaleSlope and RescaleIntercept"
        )
    if int(header.get("BitsAllocated") or 0) not in (8, 16, 32, 64):
        raise FormatError(str(path), f"BitsAllocated {header.get('BitsAllocated')}", "8, 16, 32 or 64")
    if not np.isfinite(_scaling(header)).all():
        raise FormatError(str(path), f"slope and intercept {_scaling(header)}", "finite numbers")


def _scaling(header: Header) -> tuple[float, float]:
    slope, intercept = header.get("RescaleSlope"), header.get("RescaleIntercept")
    return (
        1.0 if slope in (None, "") else float(slope),
        0.0 if intercept in (None, "") else float(intercept),
    )


def _stored_type(header: Header) -> np.dtype[Any]:
    sign = "i" if header.get("PixelRepresentation") else "u"
    return np.dtype(f"{sign}{int(header.BitsAllocated) // 8}")


def _note_oddities(ordered: list[Slice], notes: list[str]) -> None:
    headers = [s.header for s in ordered]
    scalings = {_scaling(header) for header in headers}
    if len(scalings) > 1:
        notes.append(f"{len(scalings)} different rescale slopes and intercepts: applied slice by slice")
    if not all(is_integral(*scaling) for scaling in scalings):
        notes.append("rescaling makes fractions: read as float32")
    if any(str(header.get("LossyImageCompression", "")) == "01" for header in headers):
        notes.append("the images were compressed with loss")
    if any(header.PhotometricInterpretation == "MONOCHROME1" for header in headers):
        notes.append("MONOCHROME1 (meant to be shown inverted): values are read as they are")
    padding = sorted({str(header.PixelPaddingValue) for header in headers if "PixelPaddingValue" in header})
    if padding:
        notes.append(f"stored value {', '.join(padding)} marks pixels outside the scan: read as they are")


def _load(ordered: list[Slice], notes: list[str], progress: Progress) -> npt.NDArray[Any]:
    """Read slice after slice into the narrowest type that has held all values so far."""
    exact = all(is_integral(*_scaling(s.header)) for s in ordered)
    volume: npt.NDArray[Any] | None = None
    with PixelReader() as reader:
        for number, one in enumerate(ordered):
            with refusing(one.path, "DICOM", notes):
                values = rescaled(reader.read(one.path, one.header), *_scaling(one.header))
            if volume is None:
                start = np.int16 if exact and values.dtype.kind in "iu" else np.float32
                volume = np.empty((len(ordered), *values.shape), start)
            volume = _widened(volume, number, values)
            volume[number] = values
            progress(number + 1, len(ordered))
    assert volume is not None, "a series has at least one slice"
    return volume


def _widened(volume: npt.NDArray[Any], filled: int, values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """The volume, of a wider type if it cannot hold the values exactly; the filled slices are kept."""
    if volume.dtype.kind == "f" or values.dtype.kind == "f":
        wide = np.dtype(np.float32)
    else:
        limits = np.iinfo(volume.dtype)
        low, high = int(values.min()), int(values.max())
        if limits.min <= low and high <= limits.max:
            return volume
        ends = (volume[:filled].min(), volume[:filled].max()) if filled else (low, high)
        wide = holding(min(low, int(ends[0])), max(high, int(ends[1]))) or np.dtype(np.float32)
    if wide == volume.dtype:
        return volume
    wider = np.empty(volume.shape, wide)
    wider[:filled] = volume[:filled]
    return wider
