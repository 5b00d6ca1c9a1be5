"""The header of one DICOM file: the attributes needed to choose series and to read pixels."""

from __future__ import annotations

import io
import struct
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

from lumencut._lumencut import DICOM_ATTRIBUTES
from lumencut.dicom.reading.sources import DEFLATED, Source, inflated, is_deflated

Header = Any
"""A pydicom Dataset that holds the attributes below, without pixels."""

_OWN_KEYWORDS = (
    *("SpecificCharacterSet", "SOPClassUID", "PlanarConfiguration"),
    *(
        "ExtendedOffsetTable",
        "ExtendedOffsetTableLengths",
        "SharedFunctionalGroupsSequence",
        "PerFrameFunctionalGroupsSequence",
    ),
)
"""Attributes to read in addition to those that the core judges by."""
_HEAD = 1 << 17
"""Bytes that hold the header of nearly every single-frame image: parsing memory is fast and bounded."""
_PIXELS = {
    (0x7FE0, 0x0010): "PixelData",
    (0x7FE0, 0x0008): "FloatPixelData",
    (0x7FE0, 0x0009): "DoubleFloatPixelData",
}


@dataclass(frozen=True, eq=False)
class Image:
    """One DICOM file, mostly an image.

    `pixels_at` is the byte at which the value of the element of pixels begins, in the inflated file where the
    dataset is deflated; `pixel_keyword` and `pixel_vr` name that element, empty where there is none.
    """

    source: Source
    header: Header
    pixels_at: int
    pixel_keyword: str
    pixel_vr: str

    @cached_property
    def frame_count(self) -> int:
        """The stated number of frames."""
        return int(self.header.get("NumberOfFrames") or 1)

    @cached_property
    def transfer_syntax(self) -> Any:
        """The transfer syntax."""
        return transfer_syntax(self.header)


def is_dicom(head: bytes) -> bool:
    """Return whether the first bytes (at least 132) are DICOM: a preamble, or a bare identifying group."""
    return head[128:132] == b"DICM" or (head[:2] in (b"\x08\x00", b"\x02\x00") and head[3:4] == b"\x00")


def transfer_syntax(header: Header) -> Any:
    """Return the transfer syntax; files without one are plain little-endian."""
    from pydicom.uid import ExplicitVRLittleEndian, ImplicitVRLittleEndian

    stated = header.file_meta.get("TransferSyntaxUID")
    return stated or (ImplicitVRLittleEndian if header.original_encoding[0] else ExplicitVRLittleEndian)


def read_header(source: Source) -> Image | None:
    """Read the attributes of one file; None if it is not DICOM."""
    head = source.head(_HEAD)
    if not is_dicom(head):
        return None
    if is_deflated(head):
        return _deflated(source)
    return _within(source, head) or _whole(source)


def _deflated(source: Source) -> Image:
    image = _whole(inflated(source))
    image.header.file_meta.TransferSyntaxUID = DEFLATED.decode()
    return image


def _within(source: Source, head: bytes) -> Image | None:
    """Return the header if it ends within these bytes, where the pixels must begin."""
    stream = io.BytesIO(head)
    try:
        header = _parsed(stream)
    except Exception:  # truncated or damaged: reading the whole file will show it
        return None
    image = _with_pixels(source, header, head[stream.tell() : stream.tell() + 12], stream.tell())
    return image if image.pixel_keyword else None


def _whole(source: Source) -> Image:
    with source.open() as stream:
        header = _parsed(stream)
        start = stream.tell()
        return _with_pixels(source, header, stream.read(12), start)


def _parsed(stream: Any) -> Header:
    import pydicom

    return pydicom.dcmread(stream, stop_before_pixels=True, force=True, specific_tags=header_tags())


@cache
def header_tags() -> list[int]:
    """Return the tags of the attributes to read."""
    from pydicom.datadict import tag_for_keyword

    keywords = (*_OWN_KEYWORDS, *DICOM_ATTRIBUTES)
    return [tag for keyword in keywords if (tag := tag_for_keyword(keyword)) is not None]


def _with_pixels(source: Source, header: Header, element: bytes, start: int) -> Image:
    """Read the element (at byte `start`) before which the parser stopped."""
    implicit, little = header.original_encoding
    tag = struct.unpack("<HH" if little else ">HH", element[:4].ljust(4, b"\0"))
    keyword = _PIXELS.get(tag, "")
    vr = "OW" if implicit else element[4:6].decode("latin-1")
    return Image(source, header, start + (8 if implicit else 12), keyword, vr)
