"""DICOM segmentations (SEG) → label maps: the numbers of segments as labels, with their names."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.foreign_errors import Progress, printable, refusing
from lumencut.base.memory import require_memory
from lumencut.base.overlaps import Overlaps, put, refuse_overlaps
from lumencut.dicom.reading.decoding import NATIVE, PLUGINS
from lumencut.dicom.reading.files import File
from lumencut.dicom.reading.headers import Image
from lumencut.dicom.reading.judging import DicomChoice
from lumencut.dicom.reading.pixels import PixelReader
from lumencut.dicom.reading.segment_frames import SegmentFrame, SegmentGrid, segment_grid
from lumencut.dicom.reading.stack import Slice
from lumencut.errors import FormatError
from lumencut.scene.patients import Patient
from lumencut.scene.volume_file import Filled, VolumeFile

_SEGMENTATIONS = ("1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.66.7")
"""Segmentation Storage, and Label Map Segmentation Storage."""
_LARGEST_NUMBER = 65535


def is_segmentation(image: Image) -> bool:
    """Return whether an object is a segmentation, by its class."""
    return str(image.header.get("SOPClassUID") or "") in _SEGMENTATIONS


def wanted_segmentation(path: Path, files: Sequence[File], wanted: DicomChoice) -> Image | None:
    """Return the segmentation that is meant: asked for as a series, or the only image; None for none.

    Raises
    ------
    FormatError
        For several segmentations without a choice.
    """
    images = [file.image for file in files if file.image is not None and file.image.header.get("Rows")]
    found = [image for image in images if is_segmentation(image)]
    if wanted.series is not None:
        found = [image for image in found if wanted.series in _names_of_series(image)]
    elif len(found) < len(images):
        return None
    if len(found) > 1:
        named = ", ".join(image.source.name for image in found[:5])
        mend = "name the file of one"
        raise FormatError(str(path), f"{len(found)} segmentations: {named}", "one segmentation", mend)
    return found[0] if found else None


def _names_of_series(image: Image) -> tuple[str, str]:
    header = image.header
    return str(header.get("SeriesInstanceUID") or ""), str(header.get("SeriesNumber") or "")


def segment_names(dataset: Any) -> dict[int, str]:
    """Return the name of each segment by its number."""
    names = {}
    for item in dataset.get("SegmentSequence") or ():
        number = int(item.get("SegmentNumber") or 0)
        if number:
            names[number] = printable(str(item.get("SegmentLabel") or "").strip()) or f"segment {number}"
    return names


def open_segmentation(path: Path, image: Image, segments: Collection[int] | None) -> VolumeFile:
    """Read the headers of a segmentation.

    Parameters
    ----------
    path : Path
        Names the file in errors.
    image : Image
        The segmentation.
    segments : collection of int, optional
        The numbers of the segments that are read; by default all.

    Raises
    ------
    FormatError
        For segments that are not there, frames that are no even stack, and pixels that cannot be decoded.
    """
    subject, notes = str(image.source), list[str]()
    with refusing(image.source, "DICOM segmentation", notes):
        dataset = image.source.all_attributes()
        names = segment_names(dataset)
        _check(subject, image, names, segments)
        grid = segment_grid(subject, dataset)
        kind = str(dataset.get("SegmentationType") or "BINARY")
        most = int(dataset.get("MaximumFractionalValue") or 255) if kind == "FRACTIONAL" else 1
        frame_of_reference = str(dataset.get("FrameOfReferenceUID") or "")
    if kind == "FRACTIONAL":
        what = str(dataset.get("SegmentationFractionalType") or "fraction").lower()
        notes.append(
            f"a fractional segmentation: a voxel belongs to a segment where its {what} is 0.5 or more"
        )
    dtype = np.dtype(np.uint8 if max(names, default=0) <= 255 else np.uint16)
    reader = _Reader(image, grid, names, segments, most, dtype)
    details = {
        "segmentation": kind.lower(),
        "segments": "; ".join(f"{n} {name}" for n, name in names.items()),
    }
    return VolumeFile(
        path, "DICOM segmentation", grid.size, dtype, "LPS (as every DICOM)", grid.world_from_index,
        lambda progress, filled: reader.read(progress, filled, notes), notes,
        details=details, settled_type=dtype, frame_of_reference=frame_of_reference, label_names=names,
        is_segmentation=True, patient=Patient.in_header(dataset),
    )  # fmt: skip


def _check(subject: str, image: Image, names: dict[int, str], segments: Collection[int] | None) -> None:
    """Reject what is invalid without reading any frame."""
    known = ", ".join(f"{number} {name}" for number, name in names.items())
    for number in segments or ():
        if number not in names:
            raise FormatError(subject, f"no segment {number}", f"segments of the file: {known or 'none'}")
    if max(names, default=0) > _LARGEST_NUMBER:
        raise FormatError(subject, f"segment {max(names)}", f"numbers up to {_LARGEST_NUMBER}")
    syntax = image.transfer_syntax
    if syntax not in (*NATIVE, *PLUGINS):
        mend = "write it uncompressed (Explicit VR Little Endian)"
        raise FormatError(subject, f"pixels as {printable(syntax.name)}", "pixels that can be decoded", mend)


class _Reader:
    """Places the frames of a segmentation into a label map."""

    def __init__(
        self,
        image: Image,
        grid: SegmentGrid,
        names: dict[int, str],
        segments: Collection[int] | None,
        most: int,
        dtype: np.dtype[Any],
    ) -> None:
        self._image, self._grid, self._names, self._dtype = image, grid, names, dtype
        self._segments = None if segments is None else set(segments)
        self._half = most / 2
        self._overlaps = Overlaps()

    def read(self, progress: Progress, filled: Filled, notes: list[str]) -> npt.NDArray[Any]:
        """Return the labels [k, j, i]; segments that overlap are refused."""
        ni, nj, nk = self._grid.size
        require_memory(self._image.source, ni * nj * nk * self._dtype.itemsize)
        labels = np.zeros((nk, nj, ni), self._dtype)
        frames = [f for f in self._grid.frames if not f.segment or self._is_wanted(f.segment)]
        for done, (frame, pixels) in enumerate(zip(frames, self._pixels(frames, notes), strict=True), 1):
            self._place(frame, pixels, labels[frame.k])
            progress(done, len(frames))
        refuse_overlaps(self._image.source, self._names, self._overlaps)
        filled(labels, nk)
        return labels

    def _is_wanted(self, segment: int) -> bool:
        return self._segments is None or segment in self._segments

    def _place(self, frame: SegmentFrame, pixels: npt.NDArray[Any], labels: npt.NDArray[Any]) -> None:
        if not frame.segment:
            wanted = pixels != 0 if self._segments is None else np.isin(pixels, list(self._segments))
            labels[wanted] = pixels[wanted]
            return
        inside = pixels >= self._half
        put(labels, inside, frame.segment, self._overlaps)

    def _pixels(self, frames: Sequence[SegmentFrame], notes: list[str]) -> Any:
        """The stored pixels [j, i] of each frame."""
        header = self._image.header
        if int(header.BitsAllocated) == 1 and not self._image.transfer_syntax.is_encapsulated:
            yield from self._bits([frame.number for frame in frames])
            return
        with PixelReader([Slice(self._image, f.number, f.k, (1.0, 0.0)) for f in frames], notes) as reader:
            for _ in frames:
                yield reader.next()

    def _bits(self, numbers: Sequence[int]) -> Any:
        """Frames of one bit per pixel, which follow each other without a gap: one may begin within a byte."""
        ni, nj, _ = self._grid.size
        count, image = ni * nj, self._image
        needed = (count * image.frame_count + 7) // 8
        with image.source.open() as stream:
            stream.seek(image.pixels_at)
            packed = stream.read(needed)
        if len(packed) < needed:
            found = f"{len(packed)} bytes of pixels"
            expected = f"{needed} for {image.frame_count} frames as the header says"
            raise FormatError(str(image.source), found, expected, "copy the file again")
        for number in numbers:
            start = number * count
            stored = np.frombuffer(packed, np.uint8, (start + count + 7) // 8 - start // 8, start // 8)
            yield np.unpackbits(stored, bitorder="little")[start % 8 :][:count].reshape(nj, ni)
