"""Moving pictures written frame by frame: WebP and APNG, with one frame in memory at a time.

Pillow encodes each frame as a separate picture; its chunks are copied into the animation, according to the
WebP container specification and the third edition of the PNG specification. (Pillow itself needs all frames
at once.)
"""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Iterable, Iterator
from typing import IO, TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from PIL.Image import Image

# Lossless files are five times larger; at this quality no difference is visible.
_WEBP = {"quality": 90, "method": 4}
#: Flags of the chunk VP8X: an animation with transparency.
_HAS_ANIMATION, _HAS_ALPHA = 0x02, 0x10
#: Flag of the chunk ANMF: the frame replaces the previous one.
_REPLACES = 0x02
_SIGNATURE = b"\x89PNG\r\n\x1a\n"


class MovingPicture(Protocol):
    """A file of frames; `close` completes it."""

    def __init__(self, file: IO[bytes]) -> None: ...

    def add(self, picture: Image, milliseconds: int) -> None:
        """Add a frame; all frames have the same size."""

    def close(self) -> None:
        """Complete the headers of the animation; the file stays open."""


class WebP:
    """An animation that repeats without end, slightly lossy."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file, self._flags, self._size = file, _HAS_ANIMATION, (0, 0)

    def add(self, picture: Image, milliseconds: int) -> None:
        """Add a frame; all frames have the same size."""
        if self._size == (0, 0):
            self._size = picture.size
            self._file.write(self._head(0))
            self._file.write(_riff_chunk(b"ANIM", bytes(6)))
        parts = list(_riff_chunks(_encoded(picture, "WEBP", **_WEBP)))
        if any(name == b"ALPH" for name, _ in parts):
            self._flags |= _HAS_ALPHA
        width, height = (_three_bytes(side - 1) for side in picture.size)
        frame = bytes(6) + width + height + _three_bytes(milliseconds) + bytes([_REPLACES])
        self._file.write(_riff_chunk(b"ANMF", frame + b"".join(_riff_chunk(*part) for part in parts)))

    def close(self) -> None:
        """Write the header again, now that the length of the file is known."""
        length = self._file.tell()
        self._file.seek(0)
        self._file.write(self._head(length - 8))

    def _head(self, length: int) -> bytes:
        width, height = (_three_bytes(max(side - 1, 0)) for side in self._size)
        extended = _riff_chunk(b"VP8X", bytes([self._flags, 0, 0, 0]) + width + height)
        return b"RIFF" + struct.pack("<I", length) + b"WEBP" + extended


class Apng:
    """An animated PNG that repeats without end; lossless."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file, self._frames, self._sequence, self._place = file, 0, 0, 0

    def add(self, picture: Image, milliseconds: int) -> None:
        """Add a frame; all frames have the same size."""
        # The first chunk states the pixel type of all frames, and a later frame may be transparent.
        parts = list(_png_chunks(_encoded(picture.convert("RGBA"), "PNG")))
        if not self._frames:
            self._file.write(_SIGNATURE + _png_chunk(b"IHDR", parts[0][1]))
            self._place = self._file.tell()
            self._write_count()
        control = struct.pack(">5I2H2B", self._next(), *picture.size, 0, 0, milliseconds, 1000, 0, 0)
        self._file.write(_png_chunk(b"fcTL", control))
        for name, data in parts:
            if name == b"IDAT" and not self._frames:
                self._file.write(_png_chunk(name, data))
            elif name == b"IDAT":
                self._file.write(_png_chunk(b"fdAT", struct.pack(">I", self._next()) + data))
        self._frames += 1

    def close(self) -> None:
        """Write the end of the file, and the number of frames near its beginning."""
        self._file.write(_png_chunk(b"IEND", b""))
        self._file.seek(self._place)
        self._write_count()

    def _write_count(self) -> None:
        self._file.write(_png_chunk(b"acTL", struct.pack(">2I", self._frames, 0)))

    def _next(self) -> int:
        self._sequence += 1
        return self._sequence - 1


def _encoded(picture: Image, kind: str, **options: Any) -> bytes:
    content = io.BytesIO()
    picture.save(content, kind, **options)
    return content.getvalue()


def _riff_chunk(name: bytes, data: bytes) -> bytes:
    return name + struct.pack("<I", len(data)) + data + bytes(len(data) % 2)


def _riff_chunks(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Return the chunks of a WebP file that hold the picture and its transparency."""
    place = 12
    while place < len(content):
        name, length = struct.unpack_from("<4sI", content, place)
        if name in (b"ALPH", b"VP8 "):
            yield name, content[place + 8 : place + 8 + length]
        place += 8 + length + length % 2


def _png_chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def _png_chunks(content: bytes) -> Iterable[tuple[bytes, bytes]]:
    place = len(_SIGNATURE)
    while place < len(content):
        length, name = struct.unpack_from(">I4s", content, place)
        yield name, content[place + 8 : place + 8 + length]
        place += 12 + length


def _three_bytes(number: int) -> bytes:
    return number.to_bytes(3, "little")
