"""The stored pixels of the slices of a stack, in their order.

Uncompressed pixels are read here. Compressed ones are decoded in separate processes, or here if there are
few and their decoder reports damage by an ordinary error.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from types import TracebackType
from typing import Any, BinaryIO

import numpy.typing as npt

from lumencut.base.foreign_errors import refusing
from lumencut.dicom.reading.decoding import PLUGINS, decode_frame, decode_native
from lumencut.dicom.reading.headers import Image
from lumencut.dicom.reading.stack import Slice
from lumencut.dicom.reading.unpacked import TAIL, held_items
from lumencut.dicom.reading.workers import Request, Workers
from lumencut.errors import FormatError

_ALWAYS_ALLOWED = 16 << 20
"""Bytes always allowed per frame: an empty one of 2048 × 2048 pixels is packed to a hundred bytes."""
_COMPRESSION_LIMIT = 10_000
"""No codec compresses a real slice by this factor; a header that claims more is wrong."""
_FEW = 40
"""Up to this number, frames are decoded here about as fast as the first process starts."""


class PixelReader:
    """Reads the pixels of slices one after the other; a context that ends its workers."""

    def __init__(self, slices: Sequence[Slice], notes: list[str]) -> None:
        self._slices, self._notes = iter(slices), notes
        self._last: _OpenImage | None = None
        self._workers: Workers | None = None
        # Sending unpacked RLE frames between processes takes longer than unpacking them here.
        packed = [one for one in slices if PLUGINS.get(one.image.transfer_syntax) in ("gdcm", "pylibjpeg")]
        if len(packed) > _FEW or any(PLUGINS[one.image.transfer_syntax] == "gdcm" for one in packed):
            self._workers = Workers(map(self._request, packed), len(packed) // 8 + 1)

    def __enter__(self) -> PixelReader:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._workers is not None:
            self._workers.close()
        if self._last is not None:
            self._last.stream.close()

    def next(self) -> npt.NDArray[Any]:
        """Give the pixels [j, i] of the next slice."""
        one = next(self._slices)
        if not one.image.transfer_syntax.is_encapsulated:
            pixels = self._opened(one.image).native(one.frame)
        elif self._workers is not None and PLUGINS[one.image.transfer_syntax] != "pydicom":
            pixels = self._workers.next()
        else:
            request = self._request(one)
            pixels = decode_frame(request.subject, request.syntax, request.frame, request.options)
        shape = int(one.image.header.Rows), int(one.image.header.Columns)
        if pixels.shape != shape or pixels.dtype.kind not in "iuf":
            shown = f"pixels of shape {pixels.shape} and type {pixels.dtype}"
            raise FormatError(str(one.image.source), shown, f"{shape[0]} rows of {shape[1]} numbers")
        return pixels

    def _request(self, one: Slice) -> Request:
        image, subject = one.image, str(one.image.source)
        with refusing(image.source, "DICOM", self._notes):
            claimed = _frame_bytes(image)
            frame = self._opened(image).compressed(one.frame)
            if claimed > max(_ALWAYS_ALLOWED, len(frame) * _COMPRESSION_LIMIT):
                raise _too_short(image, len(frame))
            return Request(subject, str(image.transfer_syntax), frame, _options(image), 4 * claimed)

    def _opened(self, image: Image) -> _OpenImage:
        """Return the open file of an image; it stays open while its slices are read."""
        if self._last is None or self._last.image is not image:
            if self._last is not None:
                self._last.stream.close()
            self._last = _OpenImage(image)
        return self._last


def check_pixels(images: Iterable[Image]) -> bool:
    """Return whether the sizes of files prove that each image has all of its pixels.

    Raises
    ------
    FormatError
        For an image without pixels, and one whose file has no room for them.
    """
    is_proven = True
    for image in images:
        if not image.pixel_keyword:
            raise _no_pixels(image)
        if image.transfer_syntax.is_encapsulated or image.pixels_at is None:
            is_proven = False
            continue
        held = image.source.size - image.pixels_at
        if held < _frame_bytes(image) * image.frame_count:
            raise _too_short(image, held)
    return is_proven


class _OpenImage:
    """The open file of an image, positioned at the first pixel."""

    def __init__(self, image: Image) -> None:
        if not image.pixel_keyword:
            raise _no_pixels(image)
        self.image = image
        self.stream = image.source.open()
        self._compressed: list[bytes] | None = None
        self._next = 0
        self._held: bytes | None = None
        self.stream.seek(image.pixels_at)

    def native(self, frame: int) -> npt.NDArray[Any]:
        image, length = self.image, _frame_bytes(self.image)
        syntax, options = str(image.transfer_syntax), _options(image)
        if not image.source.is_packed:
            held = image.source.size - self.stream.tell()
            if held < length * image.frame_count:
                raise _too_short(image, held)
            return decode_native(syntax, self.stream, frame, options)
        # Frames in their order are read one by one; otherwise, or with odd lengths, all frames are kept in
        # memory.
        if self._held is None and frame == self._next and length % 2 == 0:
            self._next += 1
            return decode_native(syntax, self._read(length, 1), 0, options | {"number_of_frames": 1})
        if self._held is None:
            self.stream.seek(image.pixels_at)
            self._held = self._read(length * image.frame_count, image.frame_count)
        return decode_native(syntax, self._held, frame, options)

    def _read(self, needed: int, frames: int) -> bytes:
        """The bytes of some frames of a packed file; after the last one the checksum is verified."""
        # An odd number of bytes is followed by a padding byte.
        pixels = self.stream.read(needed + needed % 2)
        if len(pixels) < needed:
            raise _too_short(self.image, len(pixels))
        if frames == self.image.frame_count or self._next == self.image.frame_count:
            self.stream.read(TAIL)
        return pixels

    def compressed(self, frame: int) -> bytes:
        from pydicom.encaps import generate_frames

        if self._compressed is None:
            image = self.image
            header, count = image.header, image.frame_count
            offsets = header.get("ExtendedOffsetTable"), header.get("ExtendedOffsetTableLengths")
            stream: BinaryIO = self.stream
            if image.source.is_packed:
                limit = count * max(_ALWAYS_ALLOWED, 2 * _frame_bytes(image))
                stream = held_items(self.stream, image.source, limit)
                self.stream.read(TAIL)
            frames = generate_frames(
                stream,
                number_of_frames=count,
                extended_offsets=offsets if all(offsets) else None,
            )
            self._compressed = list(frames)
        if frame >= len(self._compressed):
            found = f"{len(self._compressed)} frames"
            expected = f"{self.image.frame_count} frames as the header says"
            raise FormatError(str(self.image.source), found, expected, "copy the file again")
        return self._compressed[frame]


def _options(image: Image) -> dict[str, Any]:
    """Return the parameters of the decoder in types of JSON."""
    header = image.header
    options = {
        "rows": int(header.Rows),
        "columns": int(header.Columns),
        "samples_per_pixel": 1,
        "photometric_interpretation": str(header.PhotometricInterpretation),
        "bits_allocated": int(header.BitsAllocated),
        "number_of_frames": image.frame_count,
        "pixel_keyword": image.pixel_keyword,
        "pixel_vr": image.pixel_vr,
    }
    if image.pixel_keyword == "PixelData":
        options["bits_stored"] = int(header.BitsStored)
        options["pixel_representation"] = int(header.get("PixelRepresentation") or 0)
    return options


def _frame_bytes(image: Image) -> int:
    header = image.header
    return int(header.Rows) * int(header.Columns) * int(header.BitsAllocated) // 8


def _no_pixels(image: Image) -> FormatError:
    return FormatError(str(image.source), "no pixels", "an image with pixels", "copy the file again")


def _too_short(image: Image, held: int) -> FormatError:
    header = image.header
    frames = f"{image.frame_count} × " if image.frame_count > 1 else ""
    expected = f"{frames}{header.Columns} × {header.Rows} pixels as the header says"
    return FormatError(str(image.source), f"{held} bytes of pixels", expected, "copy the file again")
