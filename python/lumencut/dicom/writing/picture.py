"""Pictures and sequences of pictures as Secondary Capture, which every PACS shows."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.dicom.writing.objects import (
    CURVED_REFORMATION,
    LT,
    Kind,
    Target,
    add_laterality,
    add_sources,
    cut,
    new_object,
    sealed,
    write,
)
from lumencut.errors import FormatError
from lumencut.scene.study import Study

_CAPTURE = "1.2.840.10008.5.1.4.1.1.7"
_GREY_FRAMES = f"{_CAPTURE}.2"
_COLOUR_FRAMES = f"{_CAPTURE}.4"
#: Largest size of an element (bytes).
_LARGEST = 2**32 - 2**16
#: Stands for an image whose pixels are already stored.
_NO_IMAGE = np.empty((0, 0, 4), np.uint8)
#: Body parts without a face; an unstated body part may include one.
_FACELESS = ("CHEST", "ABDOMEN", "PELVIS", "AORTA", "LEG", "EXTREMITY", "HEART", "ARM", "KNEE", "FOOT", "HIP")


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture and the description for its DICOM object.

    Attributes
    ----------
    image : numpy.ndarray, uint8, shape (H, W, 4)
        The picture, RGBA; transparent pixels become black.
    method : str
        A short title, such as ``"CSR"``.
    words : str
        A description without names of files, vessels or persons.
    settings : str
        Pictures of the same method and with the same text are put into one series.
    pixel_spacing : float or None
        Side of a pixel (mm) if distances in the picture are projected ones; else None, since a ruler would be
        wrong.
    sides : tuple of (str, str) or None
        The sides of the patient at the right end of rows and at the lower end of columns, as letters of
        `lumencut.scene.orientation`; None if they do not hold in the whole picture.
    comments : str, default ""
        The text that a viewer shows, such as the name of the view.
    shows_body : bool, default False
        Whether the surface of the body may be seen.
    code : (str, str), default curved reformatting
        The method of derivation (DCM).
    film : str or None, default None
        The short title of the film whose first picture this is; None for a turntable of the method.
    """

    image: npt.NDArray[np.uint8]
    method: str
    words: str
    settings: str
    pixel_spacing: float | None
    sides: tuple[str, str] | None
    comments: str = ""
    shows_body: bool = False
    code: tuple[str, str] = CURVED_REFORMATION
    film: str | None = None


def write_picture(
    target: Target, picture: Picture, study: Study, *, number: int = 1, compress: bool = False
) -> None:
    """Write a picture as Secondary Capture.

    Parameters
    ----------
    target : Path or binary file
        The file or binary stream to write to.
    picture : Picture
        The picture.
    study : Study
        Its study.
    number : int, default 1
        Its place in the series.
    compress : bool, default False
        Compress the pixels as JPEG 2000 without loss.
    """
    kind = Kind(_CAPTURE, picture.method, 9001)
    data = _described(picture, study, kind, number)
    colours = on_black(picture.image)
    _set_colours(data, colours.tobytes(), colours.shape[:2])
    sealed(data, data.PixelData)
    write(data, target, _packed if compress else None)


def write_turning(
    path: Path, pictures: Iterable[Picture], fps: float, study: Study, *, grey: bool, compress: bool
) -> int:
    """Write pictures that follow each other as one multi-frame Secondary Capture, and return how many.

    Parameters
    ----------
    path : Path
        The file.
    pictures : iterable of Picture
        Pictures of one size; the first describes how all were made.
    fps : float
        Frames per second.
    study : Study
        Their study.
    grey : bool
        Write grey bytes instead of colours, for programs that read no colours.
    compress : bool
        Compress the pixels as JPEG 2000 without loss.
    """
    pixels, shown = bytearray(), []
    for picture in pictures:
        colours = on_black(picture.image)
        pixels += (greys(colours) if grey else colours).tobytes()
        size = colours.shape[:2]
        shown.append(replace(picture, image=_NO_IMAGE))
        if len(pixels) > _LARGEST:
            found = f"{len(shown)} frames of more than 4 GiB"
            raise FormatError(
                str(path), found, "what one DICOM object can hold", "take fewer or smaller frames"
            )
    if not shown:
        raise FormatError(str(path), "no frames", "at least one frame")
    name = shown[0].film or f"{shown[0].method} turntable"
    kind = Kind(_GREY_FRAMES if grey else _COLOUR_FRAMES, name, 9003)
    data = _described(_turning(shown), study, kind, 1)
    (_set_greys if grey else _set_colours)(data, bytes(pixels), size)
    _set_timing(data, len(shown), fps)
    sealed(data, data.PixelData, str(data.FrameTime).encode())
    write(data, path, _packed if compress else None)
    return len(shown)


def _turning(shown: list[Picture]) -> Picture:
    """Return the description of several views: that of the first one, with only facts true for all."""
    first = shown[0]
    spacings, sides = ({getattr(one, name) for one in shown} for name in ("pixel_spacing", "sides"))
    return replace(
        first,
        words=f"{len(shown)} frames, of which the first is: {first.words}",
        comments=f"{len(shown)} frames. First: {first.comments}. Last: {shown[-1].comments}",
        pixel_spacing=first.pixel_spacing if len(spacings) == 1 else None,
        sides=first.sides if len(sides) == 1 else None,
    )


def _described(picture: Picture, study: Study, kind: Kind, number: int) -> Any:
    """Return an object with everything except pixels."""
    data = new_object(study, kind, picture.settings, number)
    add_laterality(data, study)
    data.ConversionType = "WSD"
    data.ImageType = ["DERIVED", "SECONDARY", picture.method.partition(" ")[0].upper()]
    # The attribute asks for text that identifies the patient; side letters, view and scale do not.
    data.BurnedInAnnotation = "NO"
    data.RecognizableVisualFeatures = "YES" if picture.shows_body and _may_have_face(study) else "NO"
    data.PatientOrientation = [dicom_sides(side) for side in picture.sides] if picture.sides else None
    add_sources(data, study, picture.code, picture.words)
    if picture.comments:
        data.ImageComments = cut(picture.comments, LT)
    if picture.pixel_spacing is not None:
        data.PixelSpacing = [f"{picture.pixel_spacing:.10g}"] * 2
        data.PixelSpacingCalibrationType = "GEOMETRY"
        data.PixelSpacingCalibrationDescription = "In the plane of the projection"
    return data


def _may_have_face(study: Study) -> bool:
    return study.text("BodyPartExamined").upper() not in _FACELESS


def dicom_sides(letters: str) -> str:
    """Return the letters of patient sides in DICOM form: H (head) and F (feet) instead of S and I."""
    return letters.replace("S", "H").replace("I", "F")


def on_black(image: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Return an RGBA picture (H, W, 4) in front of black, RGB (H, W, 3)."""
    if (image[..., 3] == 255).all():
        return np.ascontiguousarray(image[..., :3])
    part = image[..., 3:].astype(np.float32) / 255
    return np.rint(image[..., :3] * part).astype(np.uint8)


def greys(colours: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Return the luminance of colours (ITU-R BT.601), uint8, shape (H, W)."""
    return np.asarray(np.rint(colours @ np.array([0.299, 0.587, 0.114])), np.uint8)


def _set_colours(data: Any, pixels: bytes, size: tuple[int, ...]) -> None:
    data.SamplesPerPixel, data.PhotometricInterpretation, data.PlanarConfiguration = 3, "RGB", 0
    _set_bytes(data, pixels, size)


def _set_greys(data: Any, pixels: bytes, size: tuple[int, ...]) -> None:
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    # For grey frames the standard requires a statement that numbers are plain grey levels.
    data.RescaleIntercept, data.RescaleSlope, data.RescaleType = "0", "1", "US"
    data.PresentationLUTShape = "IDENTITY"
    _set_bytes(data, pixels, size)


def _set_bytes(data: Any, pixels: bytes, size: tuple[int, ...]) -> None:
    data.Rows, data.Columns = size
    data.BitsAllocated, data.BitsStored, data.HighBit, data.PixelRepresentation = 8, 8, 7, 0
    data.PixelData = pixels + b"\0" * (len(pixels) % 2)
    data["PixelData"].VR = "OB"


def _set_timing(data: Any, count: int, fps: float) -> None:
    """State the frame rate, and that viewers shall repeat the frames."""
    data.NumberOfFrames = count
    data.FrameIncrementPointer = 0x00181063
    data.FrameTime = f"{1000 / fps:.10g}"
    data.RecommendedDisplayFrameRate = data.CineRate = max(1, round(fps))
    data.PreferredPlaybackSequencing = 0


def _packed(data: Any) -> None:
    """Compress the pixels of an object without loss."""
    from pydicom.uid import JPEG2000Lossless

    if data.PhotometricInterpretation == "RGB":
        # JPEG 2000 transforms colours; every reader reverses that if the object names the transform.
        data.PhotometricInterpretation = "YBR_RCT"
    sealed_uid = data.SOPInstanceUID
    data.compress(JPEG2000Lossless, encoding_plugin="pylibjpeg", generate_instance_uid=False)
    assert data.SOPInstanceUID == sealed_uid, "the pixels are the same, and so is the object"
