"""One frame of pixels → numbers, by pydicom and the plugin that decodes its transfer syntax."""

from __future__ import annotations

import struct
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError

_SIZ_MARKER = b"\xff\x4f\xff\x51"
_JPEG_2000 = tuple(f"1.2.840.10008.1.2.4.{number}" for number in (90, 91, 201, 202, 203))
_RLE = "1.2.840.10008.1.2.5"
_JPEG = tuple(f"1.2.840.10008.1.2.4.{number}" for number in (50, 51, 57, 70, 80, 81))
_JPEG_EXTENDED = "1.2.840.10008.1.2.4.51"
NATIVE = ("1.2.840.10008.1.2", *(f"1.2.840.10008.1.2.{end}" for end in ("1", "1.99", "2")))
"""Transfer syntaxes whose pixels are not compressed, or deflated with all of the file."""
PLUGINS = {
    _RLE: "pydicom",
    **dict.fromkeys(_JPEG_2000, "pylibjpeg"),
    **dict.fromkeys(_JPEG, "gdcm"),
}
"""Transfer syntax → plugin, for those whose pixels are encapsulated."""


def decode_native(
    syntax: str, stream: BinaryIO | bytes, frame: int, options: dict[str, Any]
) -> npt.NDArray[Any]:
    """Read one frame of uncompressed pixels from a stream whose position is at the frame."""
    from pydicom.pixels.decoders.base import get_decoder

    return np.asarray(get_decoder(syntax).as_array(stream, index=frame, **options)[0])


def decode_frame(subject: str, syntax: str, frame: bytes, options: dict[str, Any]) -> npt.NDArray[Any]:
    """Decode one compressed frame."""
    if syntax in _JPEG_2000:
        _require_codestream(subject, frame, options)
    try:
        return _decoded(syntax, frame, options)
    except ImportError:
        raise
    except Exception:  # decoders raise almost any exception, with messages for programmers
        found, expected = "damaged pixels", "pixels that can be decoded"
        raise FormatError(subject, found, expected, "copy the file again") from None


def _decoded(syntax: str, frame: bytes, options: dict[str, Any]) -> npt.NDArray[Any]:
    from pydicom.encaps import encapsulate
    from pydicom.pixels.decoders.base import get_decoder

    if syntax == _JPEG_EXTENDED and options["bits_stored"] > 8:
        return _jpeg_of_12_bits(frame, options)
    single = options | {"number_of_frames": 1}
    decoder = get_decoder(syntax)
    if PLUGINS[syntax] not in decoder.available_plugins:
        raise ImportError(f"no decoder of {PLUGINS[syntax]} is installed")
    packed = encapsulate([frame], has_bot=False)
    return np.asarray(decoder.as_array(packed, index=0, decoding_plugin=PLUGINS[syntax], **single)[0])


def _jpeg_of_12_bits(frame: bytes, options: dict[str, Any]) -> npt.NDArray[Any]:
    """Decode JPEG Extended with more than 8 bits; GDCM can decode it, but not when called by pydicom."""
    import gdcm

    fragment = gdcm.Fragment()
    fragment.SetByteStringValue(frame)
    fragments = gdcm.SequenceOfFragments.New()
    fragments.AddFragment(fragment)
    element = gdcm.DataElement(gdcm.Tag(0x7FE0, 0x0010))
    element.SetValue(fragments.__ref__())
    image = gdcm.Image()
    image.SetNumberOfDimensions(2)
    image.SetDimensions((options["columns"], options["rows"], 1))
    image.SetDataElement(element)
    image.SetPhotometricInterpretation(
        gdcm.PhotometricInterpretation(gdcm.PhotometricInterpretation.MONOCHROME2)
    )
    image.SetTransferSyntax(gdcm.TransferSyntax(gdcm.TransferSyntax.GetTSType(_JPEG_EXTENDED)))
    stored, signed = options["bits_stored"], options["pixel_representation"]
    image.SetPixelFormat(gdcm.PixelFormat(1, options["bits_allocated"], stored, stored - 1, signed))
    # GDCM returns bytes as a text.
    data = image.GetBuffer().encode("utf-8", "surrogateescape")
    kind = np.dtype(("i" if signed else "u") + str(options["bits_allocated"] // 8)).newbyteorder("<")
    return np.frombuffer(data, kind).reshape(options["rows"], options["columns"])


def _require_codestream(subject: str, frame: bytes, options: dict[str, Any]) -> None:
    """Reject a codestream whose size differs from the header, before a decoder allocates memory for it."""
    start = frame.find(_SIZ_MARKER)
    fields = frame[start + 8 : start + 42]
    if start < 0 or len(fields) < 34:
        raise FormatError(subject, "pixels without a codestream", "JPEG 2000", "copy the file again")
    right, bottom, left, top = struct.unpack(">4I", fields[:16])
    components = int.from_bytes(fields[32:34], "big")
    if (right - left, bottom - top, components) != (options["columns"], options["rows"], 1):
        found = f"a codestream of {right - left} × {bottom - top} pixels, {components} values each"
        raise FormatError(subject, found, f"{options['columns']} × {options['rows']} as the header says")
