"""Values as derived CT or MR images, which a PACS shows in any window.

They have their own frame of reference. With that of the scan, viewers would place the plane of a view inside
the scan, and would show marks of the scan on it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.dicom.writing.objects import (
    CURVED_REFORMATION,
    LT,
    Kind,
    add_laterality,
    add_sources,
    cut,
    new_object,
    sealed,
    write,
)
from lumencut.dicom.writing.uids import uid_of
from lumencut.errors import FormatError
from lumencut.scene.study import ACQUISITION, Study
from lumencut.scene.window import Window

_CLASSES = {"CT": "1.2.840.10008.5.1.4.1.1.2", "MR": "1.2.840.10008.5.1.4.1.1.4"}
#: Attributes that the classes require, here empty or with a value without meaning.
_ASKED: dict[str, dict[str, Any]] = {
    "CT": {"KVP": None, "AcquisitionNumber": None},
    "MR": {
        "ScanningSequence": "RM",
        "SequenceVariant": "NONE",
        "ScanOptions": None,
        "MRAcquisitionType": None,
        "EchoTime": None,
        "EchoTrainLength": None,
        "RepetitionTime": None,
    },
}
#: Largest number of slices of the scan that a plane names as its sources.
_NAMED_BY_PLANE = 64
#: The stored number for missing values, and the smallest and largest stored number of all others.
_NOTHING, _LOWEST, _HIGHEST = -32768, -32767, 32767


@dataclass(frozen=True, eq=False)
class Plane:
    """An image of values on a plane.

    Attributes
    ----------
    values : numpy.ndarray, shape (H, W)
        Values in the unit of the scan, NaN if missing.
    right, down : numpy.ndarray, shape (3,)
        Unit vectors along rows and columns (LPS).
    first : numpy.ndarray, shape (3,)
        Centre of the first pixel (mm, LPS), in a frame of reference of its own.
    spacing : float
        Side of a pixel (mm).
    thickness : float or None
        Distance to the next plane (mm); None for a single plane.
    """

    values: npt.NDArray[np.float32]
    right: npt.NDArray[np.float64]
    down: npt.NDArray[np.float64]
    first: npt.NDArray[np.float64]
    spacing: float
    thickness: float | None = None


@dataclass(frozen=True)
class About:
    """What the planes of a series have in common.

    Attributes
    ----------
    method : str
        A short title, such as ``"CSR"``.
    words : str
        The description of the planes.
    settings : str
        Planes of the same method with the same text are put into one series.
    comments : str
        The text that a viewer shows.
    window : Window or None
        The window that viewers show first.
    scaling : (float, float)
        Slope and intercept from stored numbers to values.
    """

    method: str
    words: str
    settings: str
    comments: str
    window: Window | None
    scaling: tuple[float, float]


def scaling_of(values: npt.NDArray[Any], *, is_whole: bool) -> tuple[float, float]:
    """Return slope and intercept for storing values in 16 bits; 1 and 0 if the values are integers in range.

    Parameters
    ----------
    values : numpy.ndarray
        All values of a series; missing values are NaN.
    is_whole : bool
        Whether the voxels of the scan are integers, such as HU; interpolated values are then rounded.
    """
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)
    if is_whole and low >= _LOWEST and high <= _HIGHEST:
        return 1.0, 0.0
    slope = float(f"{max(high - low, 1e-6) / (_HIGHEST - _LOWEST) * (1 + 1e-6):.9g}")
    return slope, float(f"{(low + high) / 2:.9g}")


def write_plane(path: Path, plane: Plane, about: About, study: Study, *, number: int = 1) -> None:
    """Write values as an image of the class of the scan.

    Raises
    ------
    FormatError
        For a scan that is neither CT nor MR.
    """
    modality = study.text("Modality")
    if modality not in _CLASSES:
        found, mend = f"the modality {modality or 'not stated'!r}", "write the picture, without values"
        raise FormatError(str(path), found, "CT or MR, for values", mend)
    kind = Kind(_CLASSES[modality], f"{about.method} values", 9004)
    data = new_object(study, kind, about.settings, number)
    data.ImageType = ["DERIVED", "SECONDARY", about.method.partition(" ")[0].upper()]
    add_laterality(data, study)
    # At most this many, because every plane of a series repeats the slices of the scan.
    add_sources(data, study, CURVED_REFORMATION, about.words, _NAMED_BY_PLANE)
    data.ImageComments = cut(about.comments, LT)
    _set_acquisition(data, study, modality)
    data.FrameOfReferenceUID = uid_of("frame of values", data.SeriesInstanceUID)
    data.PositionReferenceIndicator = None
    _set_place(data, plane)
    _set_numbers(data, plane.values, about, modality)
    place = np.concatenate([plane.right, plane.down, plane.first, about.scaling]).astype("<f8").tobytes()
    write(sealed(data, data.PixelData, place), path)


def _set_acquisition(data: Any, study: Study, modality: str) -> None:
    """Set only those attributes of the scan that the class requires."""
    for keyword, otherwise in _ASKED[modality].items():
        setattr(data, keyword, otherwise)
        if keyword in ACQUISITION and keyword in study.header:
            data[keyword] = study.header[keyword]
    data.PatientPosition = study.text("PatientPosition") or None


def _set_place(data: Any, plane: Plane) -> None:
    data.PixelSpacing = [f"{plane.spacing:.10g}"] * 2
    data.SliceThickness = None if plane.thickness is None else f"{plane.thickness:.10g}"
    data.ImageOrientationPatient = [f"{one:.9f}" for one in (*plane.right, *plane.down)]
    data.ImagePositionPatient = [f"{one:.6f}" for one in plane.first]


def _set_numbers(data: Any, values: npt.NDArray[np.float32], about: About, modality: str) -> None:
    """Set the pixels as signed numbers of 16 bits."""
    slope, intercept = about.scaling
    stored = np.full(values.shape, _NOTHING, "<i2")
    known = np.isfinite(values)
    stored[known] = np.rint((values[known].astype(np.float64) - intercept) / slope).clip(_LOWEST, _HIGHEST)
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.Rows, data.Columns = values.shape
    data.BitsAllocated, data.BitsStored, data.HighBit, data.PixelRepresentation = 16, 16, 15, 1
    data.add_new(0x00280120, "SS", _NOTHING)
    if modality == "CT" or about.scaling != (1.0, 0.0):
        data.RescaleSlope, data.RescaleIntercept = f"{slope:.10g}", f"{intercept:.10g}"
    if modality == "CT":
        data.RescaleType = "HU"
    if about.window is not None:
        if about.window.width < 1:
            # The usual window function is not defined for windows this narrow.
            data.VOILUTFunction = "LINEAR_EXACT"
        data.WindowCenter, data.WindowWidth = f"{about.window.level:.7g}", f"{about.window.width:.7g}"
    data.PixelData = stored.tobytes()
    data["PixelData"].VR = "OW"
