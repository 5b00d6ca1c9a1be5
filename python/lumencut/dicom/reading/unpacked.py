"""Packed bytes as a file that is read forwards: only requested bytes are unpacked, and none are kept."""

from __future__ import annotations

import io
import zlib
from collections.abc import Callable
from typing import Any, BinaryIO, Protocol

from lumencut.base.memory import require_memory
from lumencut.errors import FormatError

_PIECE = 1 << 20
_CHUNK = 1 << 16
_BUFFER = 1 << 17
"""Distance that parsers can seek backwards without restarting a stream (bytes)."""
TAIL = 1 << 20
"""Number of bytes read after the pixels to verify the checksum of a nearby end."""


class Stream(Protocol):
    """An unpacker."""

    def read(self, size: int, /) -> bytes:
        """Return up to size bytes, none at the end."""

    def close(self) -> None:
        """Let go of the packed bytes."""


class BoundedFile(io.BufferedReader):
    """A file that allocates no more memory than it has bytes left, or than is available."""

    def __init__(self, raw: io.RawIOBase, size: int, subject: object) -> None:
        super().__init__(raw, _BUFFER)
        self._size, self._subject = size, subject

    def read(self, size: int | None = -1, /) -> bytes:
        """Read up to size bytes, or all that is left."""
        left = max(self._size - self.tell(), 0)
        wanted = left if size is None or size < 0 else min(size, left)
        require_memory(self._subject, wanted)
        return super().read(wanted)


class Unpacked(io.RawIOBase):
    """The bytes of a packed stream, which restarts when a reader seeks backwards.

    Parameters
    ----------
    begin : callable
        Returns the stream from its first byte.
    """

    name = ""
    """Readers ask every open file for it."""

    def __init__(self, begin: Callable[[], Stream]) -> None:
        self._begin, self._stream = begin, begin()
        self._at = self._wanted = 0

    def readable(self) -> bool:
        """Return True: bytes can be read."""
        return True

    def seekable(self) -> bool:
        """Return True: the stream is seekable."""
        return True

    def tell(self) -> int:
        """Return the place of the next byte."""
        return self._wanted

    def seek(self, offset: int, whence: int = io.SEEK_SET, /) -> int:
        """Choose the place of the next byte, from the beginning or from the present one."""
        if whence == io.SEEK_END:
            raise io.UnsupportedOperation("the end is not known before all is unpacked")
        self._wanted = max(offset + (self._wanted if whence == io.SEEK_CUR else 0), 0)
        return self._wanted

    def readinto(self, buffer: Any, /) -> int:
        """Unpack the next bytes, as many as the stream gives at once."""
        self._go()
        piece = self._stream.read(min(len(buffer), _PIECE)) if self._at == self._wanted else b""
        buffer[: len(piece)] = piece
        self._at = self._wanted = self._at + len(piece)
        return len(piece)

    def close(self) -> None:
        """Let go of the packed bytes."""
        self._stream.close()
        super().close()

    def _go(self) -> None:
        """Unpack everything before the requested place."""
        if self._wanted < self._at:
            self._stream.close()
            self._stream, self._at = self._begin(), 0
        while self._at < self._wanted:
            piece = self._stream.read(min(self._wanted - self._at, _PIECE))
            if not piece:
                return
            self._at += len(piece)


class Inflating:
    """Plain bytes followed by an inflated deflate stream."""

    def __init__(self, plain: bytes, packed: BinaryIO) -> None:
        self._plain, self._packed = plain, packed
        self._decoder = zlib.decompressobj(-zlib.MAX_WBITS)

    def read(self, size: int, /) -> bytes:
        """Return up to size bytes."""
        if self._plain:
            piece, self._plain = self._plain[:size], self._plain[size:]
            return piece
        while not self._decoder.eof:
            chunk = self._decoder.unconsumed_tail or self._packed.read(_CHUNK)
            piece = self._decoder.decompress(chunk, size)
            if piece or not chunk:
                return piece
        return b""

    def close(self) -> None:
        """Close the packed file."""
        self._packed.close()


def held_items(stream: BinaryIO, subject: object, limit: int) -> io.BytesIO:
    """Return the items of encapsulated pixels, which a stream that is read forwards begins with.

    Raises
    ------
    FormatError
        For more bytes than the limit.
    """
    held = io.BytesIO()
    while (head := stream.read(8))[:4] == b"\xfe\xff\x00\xe0" and len(head) == 8:
        length = int.from_bytes(head[4:], "little")
        if held.tell() + length > limit:
            found = f"compressed pixels of more than {limit} bytes"
            raise FormatError(str(subject), found, "pixels that compression makes smaller", "write it again")
        held.write(head + stream.read(length))
    held.write(head)
    held.seek(0)
    return held
