"""Multi-frame DICOM: enhanced CT with the position of every frame, and the old kind without positions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pydicom
from pydicom.dataset import Dataset
from pydicom.sequence import Sequence as Items
from pydicom.uid import EnhancedCTImageStorage, EnhancedMRImageStorage, LegacyConvertedEnhancedCTImageStorage

from dicom_codecs import Encoder
from dicom_phantom import (
    HOUNSFIELD,
    PLAIN,
    ROOT,
    Image,
    Stored,
    corner,
    cosines,
    instance,
    pixel_spacing,
    pixels,
    save,
    single,
)

_STACK, _POSITION, _TIME = 0x00209056, 0x00209057, 0x00209128
_CONTENT, _PLACE = 0x00209111, 0x00209113


def _of(**members: object) -> Items:
    """A sequence of one item."""
    item = Dataset()
    for keyword, value in members.items():
        setattr(item, keyword, value)
    return Items([item])


def _dimensions(data: Dataset, pointers: Sequence[int]) -> None:
    """State which attributes distinguish the frames."""
    uid = f"{ROOT}.9"
    data.DimensionOrganizationType = "3D"
    data.DimensionOrganizationSequence = _of(DimensionOrganizationUID=uid)
    data.DimensionIndexSequence = Items(
        _of(DimensionOrganizationUID=uid, DimensionIndexPointer=p, FunctionalGroupPointer=_CONTENT)[0]
        for p in pointers
    )


def _scaling(stored: Stored) -> Items:
    return _of(RescaleSlope=f"{stored.slope:g}", RescaleIntercept=f"{stored.intercept:g}", RescaleType="HU")


def frame_groups(image: Image, stored: Stored, place: int, phase: int | None) -> Dataset:
    """Return the attributes of one frame."""
    item = Dataset()
    index = [1, place] if phase is None else [1, phase, place]
    content = _of(StackID="1", InStackPositionNumber=place, DimensionIndexValues=index)
    if phase is not None:
        content[0].TemporalPositionIndex = phase
        content[0].FrameAcquisitionNumber = phase
    item.FrameContentSequence = content
    item.PlanePositionSequence = _of(ImagePositionPatient=corner(image.plane))
    item.PixelValueTransformationSequence = _scaling(stored)
    kind = ["ORIGINAL", "PRIMARY", "VOLUME", "NONE"]
    item.CTImageFrameTypeSequence = _of(
        FrameType=kind, PixelPresentation="MONOCHROME", VolumetricProperties="VOLUME"
    )
    return item


def enhanced(
    stack: Sequence[Image],
    scale: Callable[[int], Stored] = lambda k: HOUNSFIELD,
    order: Sequence[int] | None = None,
    phases: Sequence[int] | None = None,
    first_place: int = 1,
) -> Dataset:
    """Make one enhanced CT object; `order` is the order of the frames in the file."""
    data = instance(1, 3, EnhancedCTImageStorage)
    data.ImageType = ["ORIGINAL", "PRIMARY", "VOLUME", "NONE"]
    data.PixelPresentation, data.VolumetricProperties = "MONOCHROME", "VOLUME"
    data.AcquisitionDateTime, data.ContentLabel = "20260101120000", "VESSEL"
    data.BurnedInAnnotation, data.LossyImageCompression, data.PresentationLUTShape = "NO", "00", "IDENTITY"
    _dimensions(data, [_STACK, _POSITION] if phases is None else [_STACK, _TIME, _POSITION])
    first = stack[0]
    shared = Dataset()
    shared.PixelMeasuresSequence = _of(
        PixelSpacing=pixel_spacing(first.plane), SliceThickness="2", SpacingBetweenSlices="2"
    )
    shared.PlaneOrientationSequence = _of(ImageOrientationPatient=cosines(first.plane))
    data.SharedFunctionalGroupsSequence = Items([shared])
    order = range(len(stack)) if order is None else order
    places = [
        first_place + k if phases is None else 1 + list(phases[:k]).count(phases[k])
        for k in range(len(stack))
    ]
    data.PerFrameFunctionalGroupsSequence = Items(
        frame_groups(stack[k], scale(k), places[k], None if phases is None else phases[k]) for k in order
    )
    data.NumberOfFrames = len(stack)
    pixels(data, np.stack([scale(k).numbers(stack[k].values) for k in order]), scale(0))
    return data


def write_enhanced(
    folder: Path, data: Dataset, encoder: Encoder | None = None, name: str = "IM0001.dcm"
) -> None:
    """Write one multi-frame object."""
    path = save(data, folder / name)
    if encoder:
        encoder(path)


def write_split(folder: Path, stack: Sequence[Image]) -> None:
    """Write one enhanced CT as a concatenation of two files."""
    half = len(stack) // 2
    for number, part in enumerate((stack[:half], stack[half:]), start=1):
        data = enhanced(part, first_place=1 + (number - 1) * half)
        data.SOPInstanceUID = f"{ROOT}.3.{number}"
        data.file_meta.MediaStorageSOPInstanceUID = data.SOPInstanceUID
        data.InstanceNumber = number
        data.ConcatenationUID, data.InConcatenationNumber = f"{ROOT}.8", number
        data.InConcatenationTotalNumber, data.ConcatenationFrameOffsetNumber = 2, (number - 1) * half
        data.SOPInstanceUIDOfConcatenationSource = f"{ROOT}.3.9"
        save(data, folder / f"IM{number:04}.dcm")


def magnetic(stack: Sequence[Image]) -> Dataset:
    """The same as an enhanced MR object."""
    data = enhanced(stack)
    data.SOPClassUID = data.file_meta.MediaStorageSOPClassUID = EnhancedMRImageStorage
    data.Modality = "MR"
    for item in data.PerFrameFunctionalGroupsSequence:
        item.MRImageFrameTypeSequence = item.CTImageFrameTypeSequence
        del item.CTImageFrameTypeSequence
    return data


def nothing_shared(stack: Sequence[Image]) -> Dataset:
    """Make an enhanced CT in which every frame repeats all attributes."""
    data = enhanced(stack)
    (shared,) = data.SharedFunctionalGroupsSequence
    for item in data.PerFrameFunctionalGroupsSequence:
        item.PixelMeasuresSequence = shared.PixelMeasuresSequence
        item.PlaneOrientationSequence = shared.PlaneOrientationSequence
    data.SharedFunctionalGroupsSequence = Items([Dataset()])
    return data


def write_singles(folder: Path, stack: Sequence[Image]) -> None:
    """Write a series of enhanced CT objects of one frame each."""
    for number, image in enumerate(stack, start=1):
        data = enhanced([image], first_place=number)
        data.SOPInstanceUID = f"{ROOT}.3.{number}"
        data.file_meta.MediaStorageSOPInstanceUID, data.InstanceNumber = data.SOPInstanceUID, number
        save(data, folder / f"IM{number:04}.dcm")


def write_legacy(folder: Path, stack: Sequence[Image]) -> None:
    """Write a legacy-converted enhanced CT with all attributes of the single frames."""
    data = enhanced(stack)
    data.SOPClassUID = data.file_meta.MediaStorageSOPClassUID = LegacyConvertedEnhancedCTImageStorage
    data.ImageType = ["ORIGINAL", "PRIMARY", "AXIAL", "NONE"]
    for number, item in enumerate(data.PerFrameFunctionalGroupsSequence, start=1):
        # No dimensions and no stack here, so only the positions can order the frames.
        item.FrameContentSequence = _of(FrameAcquisitionNumber=1)
        item.ConversionSourceAttributesSequence = _of(
            ReferencedSOPClassUID="1.2.840.10008.5.1.4.1.1.2", ReferencedSOPInstanceUID=f"{ROOT}.7.{number}"
        )
    del data.DimensionIndexSequence, data.DimensionOrganizationSequence, data.DimensionOrganizationType
    save(data, folder / "IM0001.dcm")


def write_legacy_by_highdicom(folder: Path, stack: Sequence[Image]) -> None:
    """Have highdicom convert single frames; needs that package."""
    from highdicom.legacy import LegacyConvertedEnhancedCTImage

    sources = [single(one, number, stored=HOUNSFIELD) for number, one in enumerate(stack, start=1)]
    made = LegacyConvertedEnhancedCTImage(sources, f"{ROOT}.1.4", 4, f"{ROOT}.4.1", 1)
    pydicom.dcmwrite(folder / "IM0001.dcm", made, enforce_file_format=True)


def write_old_multiframe(folder: Path, stack: Sequence[Image]) -> None:
    """Write ten frames without positions, as angiography devices do."""
    data = instance(1, 3, "1.2.840.10008.5.1.4.1.1.12.1", "XA")
    data.ImageType = ["ORIGINAL", "PRIMARY", "SINGLE PLANE"]
    data.NumberOfFrames, data.FrameIncrementPointer, data.FrameTime = 10, 0x00181063, "66"
    data.ImagerPixelSpacing = pixel_spacing(stack[0].plane)
    pixels(data, np.stack([PLAIN.numbers(one.values) for one in stack[:10]]), PLAIN)
    save(data, folder / "IM0001.dcm")
