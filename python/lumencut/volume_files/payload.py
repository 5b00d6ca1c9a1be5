"""Voxels as bytes: plain, compressed or as text, never more memory than the file really fills."""

from __future__ import annotations

import bz2
import os
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, Literal

import numpy as np
import numpy.typing as npt

from lumencut._files import checked_path
from lumencut.errors import FormatError
from lumencut.volume_files.opened import Filled, shown, unfollowed
from lumencut.volume_files.room import require_memory

Codec = Literal["raw", "zlib", "bzip2"]
"""``zlib`` stands for zlib and gzip streams alike, whichever the bytes turn out to be."""

_CHUNK = 1 << 14
_PIECE = 1 << 20
_READ = 16 << 20
_PLAIN_FILE = "a file of voxels"
_DEFLATE_LIMIT = 1032
"""No byte of a deflate stream becomes more bytes than this."""
_TRUSTED = 8
"""Sizes up to this many times the compressed file need no proof before memory is taken."""
_EMPTY_LIMIT = 1000
"""Parts of a compressed stream that hold nothing: real files have one at most, for a good end."""
_WORD_LIMIT = 400
_MAGIC = 4


def read_voxels(
    path: Path,
    shape: tuple[int, ...],
    dtype: np.dtype[Any],
    *,
    start: int = 0,
    codec: Codec = "raw",
    skip: int = 0,
    beyond: int = 0,
    filled: Filled = unfollowed,
) -> npt.NDArray[Any]:
    """Read voxels of a shape [k, j, i] that begin at byte `start` of the file.

    Parameters
    ----------
    path : Path
        File that holds the voxels.
    shape : tuple of int
        Shape of the result, slowest axis first.
    dtype : numpy.dtype
        Type on disk, byte order included.
    start : int, default 0
        First byte of the voxels, or of the compressed stream, in the file; negative: the voxels are the
        file's last bytes.
    codec : {'raw', 'zlib', 'bzip2'}, default 'raw'
        How the bytes are compressed.
    skip : int, default 0
        Bytes to leave out at the beginning of the decompressed stream.
    beyond : int, default 0
        Bytes that the caller will make of the voxels while it holds them.
    filled : callable, optional
        Told of the voxels as they come in.

    Returns
    -------
    numpy.ndarray
        The voxels, writable.

    Raises
    ------
    FormatError
        When the file holds fewer bytes than the shape needs, or the machine has less memory.
    """
    needed = dtype.itemsize
    for count in shape:
        needed *= int(count)
    if skip < 0:
        raise FormatError(str(path), f"voxels at byte {skip}", "an offset of 0 or more")
    with checked_path(path, _PLAIN_FILE).open("rb") as file:
        length = os.fstat(file.fileno()).st_size
        if start < 0 and length < needed:
            raise _too_short(path, length, needed)
        file.seek(start if start >= 0 else length - needed)
        held = max(length - file.tell(), 0)
        _require_bytes(path, codec, skip + needed, held)
        # A volume holds its voxels in the order of the machine, so those in another order are copied.
        require_memory(path, beyond + (1 if dtype.isnative else 2) * needed)
        _require_proof(path, file, codec, skip + needed, held)
        data = np.empty(needed, np.uint8)
        voxels = data.view(dtype).reshape(shape)
        told = partial(filled, voxels)
        if codec == "raw":
            file.seek(skip, 1)
            _read_plain(path, file, data, _in_slices(voxels, told))
        else:
            _decompress(_pieces(path, file, codec, skip + needed), data, skip, _in_slices(voxels, told), path)
    return voxels


def check_length(
    path: Path,
    shape: tuple[int, ...],
    dtype: np.dtype[Any],
    *,
    start: int = 0,
    codec: Codec = "raw",
    skip: int = 0,
) -> bool:
    """Tell whether the length of a file proves that it holds all voxels.

    Parameters are those of `read_voxels`.

    Raises
    ------
    FormatError
        For plain voxels that the file has no room for.
    """
    needed = dtype.itemsize
    for count in shape:
        needed *= int(count)
    length = checked_path(path, _PLAIN_FILE).stat().st_size
    held = max(length - max(start, 0) - skip, 0)
    if codec == "raw" and held < needed:
        raise _too_short(path, held, needed)
    if codec == "zlib" and needed > length * _DEFLATE_LIMIT:
        raise _too_short(path, length * _DEFLATE_LIMIT, needed, "at most ")
    return codec == "raw"


def _in_slices(voxels: npt.NDArray[Any], told: Callable[[int], None]) -> Callable[[int], None]:
    """A function that is told of bytes that are read, and tells on of slices that are whole."""
    size, known = max(voxels[:1].nbytes, 1), 0

    def told_of_bytes(count: int) -> None:
        nonlocal known
        if count // size > known:
            known = count // size
            told(known)

    return told_of_bytes


def first_bytes(path: Path, file: BinaryIO, count: int) -> bytes:
    """Give up to `count` first bytes of the gzip stream that begins here, which may break off after them."""
    found = bytearray()
    with suppress(FormatError):
        for piece in _pieces(path, file, "zlib", count):
            found += piece
    return bytes(found)


def _read_plain(path: Path, file: BinaryIO, data: npt.NDArray[np.uint8], told: Callable[[int], None]) -> None:
    place, room = 0, data.data
    while place < data.size:
        count = file.readinto(room[place : place + _READ])  # type: ignore[attr-defined]
        if not count:
            raise _too_short(path, place, data.size)
        place += count
        told(place)


def _require_bytes(path: Path, codec: Codec, needed: int, held: int) -> None:
    """Refuse a size that the file cannot fill."""
    if codec == "raw" and needed > held:
        raise _too_short(path, held, needed)
    if codec == "zlib" and needed > held * _DEFLATE_LIMIT:
        raise _too_short(path, held * _DEFLATE_LIMIT, needed, "at most ")


def _require_proof(path: Path, file: BinaryIO, codec: Codec, needed: int, held: int) -> None:
    """Decompress a stream that would have to grow much once, only to count its bytes."""
    if codec != "raw" and needed > _TRUSTED * held:
        start, found = file.tell(), 0
        for piece in _pieces(path, file, codec, needed):
            found += len(piece)
        if found < needed:
            raise _too_short(path, found, needed)
        file.seek(start)


def _decompress(
    pieces: Iterator[bytes],
    data: npt.NDArray[np.uint8],
    skip: int,
    told: Callable[[int], None],
    path: Path,
) -> None:
    """Fill an array with the pieces of a stream, of which the first bytes are left out."""
    place = -skip
    for piece in pieces:
        end = place + len(piece)
        if end > 0:
            data[max(place, 0) : end] = np.frombuffer(piece, np.uint8)[max(-place, 0) :]
            told(end)
        place = end
    if place < data.size:
        raise _too_short(path, max(place, 0), data.size)


def _pieces(path: Path, file: BinaryIO, codec: Codec, wanted: int) -> Iterator[bytes]:
    """Decompress up to `wanted` bytes in pieces of bounded size, whatever the stream would like to become.

    A stream may have several parts, one after the other; what follows the last is not looked at, nor is
    what follows the wanted bytes. A part that ends with them has its check sum looked at.
    """
    part, empty = Part(codec), 0
    try:
        while True:
            hungry = part.hungry
            chunk = file.read(_CHUNK) if hungry else b""
            # One byte more than is wanted: it leads a part that ends there to its check sum.
            piece = part.feed(chunk, min(wanted + 1, _PIECE))
            if piece and wanted:
                yield piece[:wanted]
            empty = 0 if piece else empty
            if len(piece) > wanted:
                return
            wanted -= len(piece)
            if part.ended:
                rest = part.rest
                rest += file.read(_CHUNK) if len(rest) < _MAGIC else b""
                empty += 1
                if not wanted or not _begins(codec, rest) or empty > _EMPTY_LIMIT:
                    return
                part = Part(codec, rest)
            elif hungry and not chunk and not piece:
                break
    except (zlib.error, OSError, EOFError) as error:
        if isinstance(error, OSError) and error.errno is not None:
            raise
        found = "a compressed stream that is damaged"
        raise FormatError(str(path), found, "a whole one", "copy the file again") from error
    if not wanted:
        found = "a compressed stream that breaks off"
        raise FormatError(str(path), found, "a whole one", "copy the file again")


class Part:
    """One part of a compressed stream: takes input when hungry, gives output in bounded pieces."""

    def __init__(self, codec: Codec, first: bytes = b"") -> None:
        self._is_zlib, self._first = codec == "zlib", first
        self._decoder: Any = (
            zlib.decompressobj(zlib.MAX_WBITS | 32) if self._is_zlib else bz2.BZ2Decompressor()
        )

    @property
    def hungry(self) -> bool:
        """Nothing is left of the input."""
        held = self._decoder.unconsumed_tail if self._is_zlib else not self._decoder.needs_input
        return not self._first and not held

    @property
    def ended(self) -> bool:
        """The part is whole, its check sum right."""
        return bool(self._decoder.eof)

    @property
    def rest(self) -> bytes:
        """Input behind the end."""
        return bytes(self._decoder.unused_data)

    def feed(self, data: bytes, limit: int) -> bytes:
        """Decompress input (empty unless hungry) to at most `limit` bytes."""
        data, self._first = self._first or data, b""
        if self._is_zlib:
            data = self._decoder.unconsumed_tail or data
        return bytes(self._decoder.decompress(data, limit))


def _begins(codec: Codec, data: bytes) -> bool:
    return data.startswith(b"\x1f\x8b" if codec == "zlib" else b"BZh")


def _too_short(path: Path, found: int, needed: int, limit: str = "") -> FormatError:
    return FormatError(
        str(path),
        f"{limit}{found} bytes of voxels",
        f"{needed} bytes as the header says",
        "copy the file again",
    )


def read_numbers(
    path: Path, shape: tuple[int, ...], dtype: np.dtype[Any], *, start: int = 0
) -> npt.NDArray[Any]:
    """Read voxels written as text, of a shape [k, j, i], from byte `start` of the file."""
    count = 1
    for length in shape:
        count *= int(length)
    kind, found = dtype.newbyteorder("="), 0
    with checked_path(path, _PLAIN_FILE).open("rb") as file:
        held = max(os.fstat(file.fileno()).st_size - start, 0)
        if held < 2 * count - 1:
            raise _too_short(path, held, 2 * count - 1)
        file.seek(start)
        require_memory(path, count * kind.itemsize)
        values = np.empty(count, kind)
        for words in _words(path, file):
            found += len(words)
            if found <= count:
                values[found - len(words) : found] = _parsed(path, words, kind)
    if found != count:
        raise FormatError(str(path), f"{found} numbers", f"{count} numbers as the header says")
    return values.reshape(shape)


def _words(path: Path, file: BinaryIO) -> Iterator[list[bytes]]:
    """The words of a text, of some kilobytes at a time: as objects they take twenty times the file."""
    begun = b""
    while chunk := file.read(_CHUNK):
        words = (begun + chunk).split()
        begun = words.pop() if words and not chunk[-1:].isspace() else b""
        if len(begun) > _WORD_LIMIT:
            raise FormatError(str(path), "a word of many letters among the voxels", "numbers")
        yield words
    yield [begun] if begun else []


def _parsed(path: Path, words: list[bytes], kind: np.dtype[Any]) -> npt.NDArray[Any]:
    try:
        if kind.kind == "f":
            return np.array([float(word) for word in words], kind)
        whole = [int(word) for word in words]
    except ValueError:
        raise FormatError(str(path), "voxels that are no numbers", f"numbers of type {kind}") from None
    limits = np.iinfo(kind)
    if whole and not limits.min <= min(whole) <= max(whole) <= limits.max:
        found = f"voxels from {min(whole)} to {max(whole)}"
        raise FormatError(str(path), shown(found), f"{limits.min} to {limits.max}, as {kind} holds")
    return np.array(whole, kind)
