"""One DICOM image → its slices: a single-frame image is one, an enhanced multi-frame image one per frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError
from lumencut.volume_files.dicom.decoding import NATIVE, PLUGINS
from lumencut.volume_files.dicom.headers import Image

_COSINE = 1e-3
"""Directions may be this far (per cosine, and in length) from orthogonal unit vectors."""
_COLOURS = (
    *("PALETTE COLOR", "RGB", "HSV", "ARGB", "CMYK", "XYB"),
    *("YBR_FULL", "YBR_FULL_422", "YBR_PARTIAL_422", "YBR_PARTIAL_420", "YBR_ICT", "YBR_RCT"),
)

# Where an enhanced multi-frame image keeps what a single-frame image has at its top level (PS3.3 C.7.6.16).
_GROUPS = {
    "ImagePositionPatient": ("PlanePositionSequence",),
    "ImageOrientationPatient": ("PlaneOrientationSequence",),
    "PixelSpacing": ("PixelMeasuresSequence",),
    "SliceThickness": ("PixelMeasuresSequence",),
    "SpacingBetweenSlices": ("PixelMeasuresSequence",),
    "RescaleSlope": ("PixelValueTransformationSequence",),
    "RescaleIntercept": ("PixelValueTransformationSequence",),
    "GantryDetectorTilt": ("CTAcquisitionDetailsSequence",),
    "StackID": ("FrameContentSequence",),
    "TemporalPositionIndex": ("FrameContentSequence",),
    "FrameAcquisitionNumber": ("FrameContentSequence",),
    "FrameAcquisitionDateTime": ("FrameContentSequence",),
    "NominalPercentageOfCardiacPhase": ("CardiacSynchronizationSequence",),
    "NominalCardiacTriggerDelayTime": ("CardiacSynchronizationSequence",),
    "EffectiveEchoTime": ("MREchoSequence",),
    "FrameType": ("CTImageFrameTypeSequence", "MRImageFrameTypeSequence", "XRay3DFrameTypeSequence"),
}


@dataclass(frozen=True, eq=False)
class Slice:
    """One grey image and its place: position, then the directions of i and j and their spacing, all LPS."""

    image: Image
    frame: int
    position: npt.NDArray[np.float64]
    along_i: npt.NDArray[np.float64]
    along_j: npt.NDArray[np.float64]
    spacing: npt.NDArray[np.float64]

    @property
    def name(self) -> str:
        """The name of its file, and the number of its frame (from 1) where the file has several."""
        return frame_name(self.image, self.frame)

    @property
    def normal(self) -> npt.NDArray[np.float64]:
        """Unit normal of the slice; slices are sorted along it."""
        return np.cross(self.along_i, self.along_j)

    def get(self, keyword: str) -> Any:
        """The value of an attribute as it holds for this frame, None if it is not stated."""
        return frame_value(self.image, self.frame, keyword)

    @cached_property
    def scaling(self) -> tuple[float, float]:
        """Slope and intercept from stored values to the volume's unit."""
        slope, intercept = self.get("RescaleSlope"), self.get("RescaleIntercept")
        return (
            1.0 if slope in (None, "") else float(slope),
            0.0 if intercept in (None, "") else float(intercept),
        )


def frame_name(image: Image, frame: int) -> str:
    """The name of a file, and the number of one of its frames (from 1) where it has several."""
    return image.source.name + (f" frame {frame + 1}" if image.frame_count > 1 else "")


def frame_value(image: Image, frame: int, keyword: str) -> Any:
    """Look an attribute up: in the frame's functional groups, in the shared ones, then at the top level."""
    own, shared = image.frame_groups, image.shared_groups
    places = ([own[frame]] if own and frame < len(own) else []) + ([shared] if shared else [])
    for place in places:
        for sequence in _GROUPS.get(keyword, ()):
            group = place.get(sequence)
            if group and keyword in group[0]:
                return group[0].get(keyword)
    return image.header.get(keyword)


def is_localizer(image: Image, frame: int) -> bool:
    """Tell a localiser (scout, topogram) by the type that the image states."""
    stated = [*_texts(image.header.get("ImageType")), *_texts(frame_value(image, frame, "FrameType"))]
    return "LOCALIZER" in stated


def _texts(value: Any) -> list[str]:
    return [value] if isinstance(value, str) else [str(one) for one in value or ()]


def slices_of(image: Image) -> list[Slice]:
    """Read where the frames of a grey image lie; localisers among them are left out if others are there."""
    frames = list(range(image.frame_count))
    wanted = [frame for frame in frames if not is_localizer(image, frame)] or frames
    return [_placed(image, frame) for frame in wanted]


def require_grey(image: Image) -> None:
    """Refuse every kind of image whose frames are not slices of single numbers."""
    subject, header = str(image.source), image.header
    if not all(isinstance(length, int) for length in (header.Rows, header.Columns)):
        raise FormatError(subject, "Rows and Columns that are no numbers", "a number each")
    photometric = str(header.get("PhotometricInterpretation") or "")
    if int(header.get("SamplesPerPixel") or 1) != 1 or not photometric.startswith("MONOCHROME"):
        kind = "a palette" if "PALETTE" in photometric else "a colour"
        named = photometric if photometric in _COLOURS else "unknown" if photometric else "not stated"
        found = f"{kind} image (PhotometricInterpretation {named})"
        raise FormatError(subject, found, "MONOCHROME2")
    if header.get("ModalityLUTSequence"):
        found = "values behind a modality look-up table"
        raise FormatError(subject, found, "RescaleSlope and RescaleIntercept")
    if image.transfer_syntax not in (*NATIVE, *PLUGINS):
        name = image.transfer_syntax.name
        found = f"pixels in {'an unknown transfer syntax' if name == image.transfer_syntax else name}"
        expected = "uncompressed, RLE, JPEG, JPEG-LS, JPEG 2000 or HTJ2K pixels"
        mend = "convert it to one of these, lossless where it can be"
        raise FormatError(subject, found, expected, mend)
    _require_bits(image)
    _require_groups(image)


def _require_bits(image: Image) -> None:
    """Refuse pixels of which it is not known how many bits they have, and whether one is a sign."""
    subject, header = str(image.source), image.header
    allocated = int(header.get("BitsAllocated") or 0)
    if allocated not in (8, 16, 32, 64):
        raise FormatError(subject, f"BitsAllocated {allocated or 'not stated'}", "8, 16, 32 or 64")
    if image.pixel_keyword != "PixelData":
        return
    if not 1 <= (stored := int(header.get("BitsStored") or 0)) <= allocated:
        raise FormatError(subject, f"BitsStored {stored or 'not stated'}", f"1 to {allocated}")
    if header.get("PixelRepresentation") not in (0, 1):
        found = "no word on whether its values have a sign"
        raise FormatError(subject, found, "PixelRepresentation 0 or 1")


def _require_groups(image: Image) -> None:
    """Refuse several frames in one file without a description of each."""
    count, groups = image.frame_count, image.frame_groups
    if count < 1 or (count > 1 and not groups):
        found = f"a multi-frame image of {count} frames without a position for each"
        mend = "convert it to single-frame or enhanced DICOM, NIfTI or NRRD"
        raise FormatError(str(image.source), found, "one slice per file, or functional groups", mend)
    if groups and len(groups) != count:
        found = f"{count} frames and functional groups for {len(groups)}"
        raise FormatError(str(image.source), found, "one group for each frame", "copy the file again")


def missing_positions(images: Sequence[Image]) -> list[str]:
    """Name the frames that do not say where they lie."""
    return [
        frame_name(image, frame)
        for image in images
        for frame in range(image.frame_count)
        if frame_value(image, frame, "ImagePositionPatient") in (None, "")
    ]


def has_positions(image: Image) -> bool:
    """Tell whether any frame says where it lies; the count that a header states may be a lie."""
    groups = len(image.frame_groups or ())
    frames = range(min(max(image.frame_count, 1), max(groups, 1)))
    return any(frame_value(image, frame, "ImagePositionPatient") not in (None, "") for frame in frames)


def _placed(image: Image, frame: int) -> Slice:
    position = _numbers(image, frame, "ImagePositionPatient", 3)
    cosines = _numbers(image, frame, "ImageOrientationPatient", 6).reshape(2, 3)
    spacing = _numbers(image, frame, "PixelSpacing", 2)
    lengths = np.linalg.norm(cosines, axis=1)
    if not (np.abs(lengths - 1) < _COSINE).all() or not abs(cosines[0] @ cosines[1]) < _COSINE:
        found = f"ImageOrientationPatient {cosines.ravel().tolist()}"
        raise FormatError(str(image.source), found, "two orthogonal unit vectors")
    if not (spacing > 0).all():
        found = f"PixelSpacing {spacing.tolist()}"
        raise FormatError(str(image.source), found, "2 positive distances in mm")
    unit = cosines / lengths[:, None]
    # PixelSpacing is (between rows, between columns); i runs along a row, hence between columns.
    placed = Slice(image, frame, position, unit[0], unit[1], spacing[::-1])
    if not np.isfinite(placed.scaling).all():
        raise FormatError(str(image.source), f"slope and intercept {placed.scaling}", "finite numbers")
    if placed.scaling[0] == 0:
        found = "RescaleSlope 0, which makes all values one"
        raise FormatError(str(image.source), found, "any other slope", "export the series again")
    return placed


def _numbers(image: Image, frame: int, keyword: str, count: int) -> npt.NDArray[np.float64]:
    stated = frame_value(image, frame, keyword)
    try:
        values = np.atleast_1d(np.asarray(() if stated is None else stated, dtype=np.float64))
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.shape != (count,) or not np.isfinite(values).all():
        # A damaged value may be any text, a patient's name too: it is not told.
        odd = f"{len(values)} numbers" if len(values) and np.isfinite(values).all() else "damaged values"
        found = f"no {keyword}" if stated in (None, "") else f"{odd} in {keyword}"
        raise FormatError(str(image.source), found, f"{count} finite numbers")
    return values
