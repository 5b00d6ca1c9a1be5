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
PLUGINS = {
    _RLE: "pydicom",
    **dict.fromkeys(_JPEG_2000, "pylibjpeg"),
    **dict.fromkeys(_JPEG, "gdcm"),
}
"""Transfer syntax → plugin, for those whose pixels are encapsulated."""


def decode_native(
    syntax: str, stream: BinaryIO | bytes, frame: int, options: dict[str, Any]
) -> npt.NDArray[Any]:
    """Read one frame of pixels that are not compressed; a stream stands at the first of all frames."""
    from pydicom.pixels.decoders.base import get_decoder

    return np.asarray(get_decoder(syntax).as_array(stream, index=frame, **options)[0])


def decode_frame(subject: str, syntax: str, frame: bytes, options: dict[str, Any]) -> npt.NDArray[Any]:
    """Decode one compressed frame."""
    from pydicom.encaps import encapsulate
    from pydicom.pixels.decoders.base import get_decoder

    if syntax in _JPEG_2000:
        _require_codestream(subject, frame, options)
    single = options | {"number_of_frames": 1}
    decoder = get_decoder(syntax)
    packed = encapsulate([frame], has_bot=False)
    return np.asarray(decoder.as_array(packed, index=0, decoding_plugin=PLUGINS[syntax], **single)[0])


def _require_codestream(subject: str, frame: bytes, options: dict[str, Any]) -> None:
    """Refuse a codestream of another size than the header's before its decoder sets memory aside."""
    start = frame.find(_SIZ_MARKER)
    fields = frame[start + 8 : start + 42]
    if start < 0 or len(fields) < 34:
        raise FormatError(subject, "pixels without a codestream", "JPEG 2000", "copy the file again")
    right, bottom, left, top = struct.unpack(">4I", fields[:16])
    components = int.from_bytes(fields[32:34], "big")
    if (right - left, bottom - top, components) != (options["columns"], options["rows"], 1):
        found = f"a codestream of {right - left} × {bottom - top} pixels, {components} values each"
        raise FormatError(subject, found, f"{options['columns']} × {options['rows']} as the header says")
