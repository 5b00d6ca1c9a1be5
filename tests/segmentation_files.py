"""DICOM segmentations of known masks, in the forms that several programs write."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from pydicom.dataset import Dataset
from pydicom.pixels import pack_bits
from pydicom.sequence import Sequence as Items
from pydicom.uid import RLELossless, SegmentationStorage

from dicom_phantom import ROOT, instance
from lumencut import Volume

FRAME_OF_REFERENCE = f"{ROOT}.2"


def _of(**members: object) -> Items:
    item = Dataset()
    for keyword, value in members.items():
        setattr(item, keyword, value)
    return Items([item])


def segmentation(
    masks: Mapping[int, Volume],
    names: Mapping[int, str],
    *,
    kind: str = "BINARY",
    order: Sequence[int] | None = None,
) -> Dataset:
    """A segmentation of one mask for each segment, all on one grid.

    Fractional masks have values from 0 to 1. `order` shuffles the frames; frames without voxels are omitted.
    """
    volume = next(iter(masks.values()))
    data = instance(1, 24, SegmentationStorage, "SEG")
    data.ImageType, data.SegmentationType, data.ContentLabel = ["DERIVED", "PRIMARY"], kind, "LUMEN"
    data.SamplesPerPixel, data.PhotometricInterpretation, data.PixelRepresentation = 1, "MONOCHROME2", 0
    _, data.Rows, data.Columns = volume.shape
    data.BitsAllocated = data.BitsStored = 1 if kind == "BINARY" else 8
    data.HighBit = data.BitsStored - 1
    if kind == "FRACTIONAL":
        data.SegmentationFractionalType, data.MaximumFractionalValue = "OCCUPANCY", 200
    data.SegmentSequence = Items(
        _of(SegmentNumber=number, SegmentLabel=name, SegmentAlgorithmType="MANUAL")[0]
        for number, name in names.items()
    )
    frames = [
        (number, k) for number, mask in masks.items() for k in range(volume.size[2]) if mask.array[k].any()
    ]
    frames = [frames[n] for n in order] if order is not None else frames
    data.SharedFunctionalGroupsSequence = [_shared(volume)]
    data.PerFrameFunctionalGroupsSequence = [_own(volume, number, k) for number, k in frames]
    data.NumberOfFrames = len(frames)
    pixels = np.stack([masks[number].array[k] for number, k in frames])
    if kind == "BINARY":
        data.PixelData = pack_bits(pixels.astype(np.uint8))
    else:
        data.PixelData = np.rint(pixels * 200).astype(np.uint8).tobytes()
    data["PixelData"].VR = "OB"
    return data


def label_map(labels: Volume, names: Mapping[int, str]) -> Dataset:
    """Write a label map as a segmentation whose pixels are the numbers of the segments."""
    data = segmentation({1: labels}, names, kind="LABELMAP")
    data.SOPClassUID = data.file_meta.MediaStorageSOPClassUID = "1.2.840.10008.5.1.4.1.1.66.7"
    for groups in data.PerFrameFunctionalGroupsSequence:
        del groups.SegmentIdentificationSequence
    stored = [k for k in range(labels.size[2]) if labels.array[k].any()]
    data.PixelData = labels.array[stored].astype(np.uint8).tobytes()
    return data


def _shared(volume: Volume) -> Dataset:
    groups, spacing, direction = Dataset(), volume.spacing, volume.direction
    cosines = [f"{x:.10f}" for x in (*direction[:, 0], *direction[:, 1])]
    groups.PlaneOrientationSequence = _of(ImageOrientationPatient=cosines)
    groups.PixelMeasuresSequence = _of(
        PixelSpacing=[f"{spacing[1]:.10g}", f"{spacing[0]:.10g}"],
        SliceThickness=f"{spacing[2]:.10g}",
        SpacingBetweenSlices=f"{spacing[2]:.10g}",
    )
    return groups


def _own(volume: Volume, segment: int, k: int) -> Dataset:
    groups = Dataset()
    corner = volume.world_from_index @ (0, 0, k, 1)
    groups.PlanePositionSequence = _of(ImagePositionPatient=[f"{x:.9f}" for x in corner[:3]])
    groups.SegmentIdentificationSequence = _of(ReferencedSegmentNumber=segment)
    return groups


def packed(data: Dataset) -> Dataset:
    """The dataset with its pixels as RLE."""
    data.compress(RLELossless, encoding_plugin="pydicom")
    return data
