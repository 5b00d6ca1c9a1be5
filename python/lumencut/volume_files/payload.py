"""Voxels as bytes: plain or compressed, never more memory than the file really holds."""

from __future__ import annotations

import bz2
import zlib
from pathlib import Path
from typing import Any, BinaryIO, Literal

import numpy as np
import numpy.typing as npt

from lumencut._files import checked_path
from lumencut.errors import FormatError

Codec = Literal["raw", "zlib", "bzip2"]
"""``zlib`` stands for zlib and gzip streams alike, whichever the bytes turn out to be."""

_CHUNK = 1 << 14
_PLAIN_FILE = "a file of voxels"


def read_voxels(
    path: Path,
    shape: tuple[int, ...],
    dtype: np.dtype[Any],
    *,
    start: int = 0,
    codec: Codec = "raw",
    skip: int = 0,
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
        First byte of the voxels, or of the compressed stream, in the file.
    codec : {'raw', 'zlib', 'bzip2'}, default 'raw'
        How the bytes are compressed.
    skip : int, default 0
        Bytes to leave out at the beginning of the decompressed stream.

    Returns
    -------
    numpy.ndarray
        The voxels, writable.

    Raises
    ------
    FormatError
        When the file holds fewer bytes than the shape needs.
    """
    needed = dtype.itemsize
    for count in shape:
        needed *= int(count)
    if start < 0 or skip < 0:
        raise FormatError(str(path), f"voxels at byte {min(start, skip)}", "an offset of 0 or more")
    with checked_path(path, _PLAIN_FILE).open("rb") as file:
        file.seek(start)
        if codec == "raw":
            return _plain(path, file, skip, needed).view(dtype).reshape(shape)
        return np.frombuffer(_decompressed(path, file, codec, skip, needed), dtype).reshape(shape)


def _plain(path: Path, file: BinaryIO, skip: int, needed: int) -> npt.NDArray[np.uint8]:
    available = path.stat().st_size - file.tell() - skip
    if available < needed:
        raise _too_short(path, max(available, 0), needed)
    file.seek(skip, 1)
    return np.fromfile(file, np.uint8, needed)


def _decompressed(path: Path, file: BinaryIO, codec: Codec, skip: int, needed: int) -> bytearray:
    """Decompress in small steps: a header that lies about the size must not make us allocate it."""
    data, end = bytearray(), skip + needed
    decoder = _decoder(codec)
    while (chunk := file.read(_CHUNK)) and len(data) <= end + _CHUNK:
        data += decoder.decompress(chunk)
        while decoder.eof and decoder.unused_data and len(data) < end:
            rest, decoder = decoder.unused_data, _decoder(codec)
            data += decoder.decompress(rest)
        if decoder.eof and len(data) >= end:
            break
        if decoder.eof:
            decoder = _decoder(codec)
    if len(data) < end:
        raise _too_short(path, max(len(data) - skip, 0), needed)
    if not decoder.eof and len(data) <= end + _CHUNK:
        raise FormatError(
            str(path), "a compressed stream that breaks off", "a whole one", "copy the file again"
        )
    del data[end:]
    del data[:skip]
    return data


def _decoder(codec: Codec) -> Any:
    return zlib.decompressobj(zlib.MAX_WBITS | 32) if codec == "zlib" else bz2.BZ2Decompressor()


def _too_short(path: Path, found: int, needed: int) -> FormatError:
    return FormatError(
        str(path), f"{found} bytes of voxels", f"{needed} bytes as the header says", "copy the file again"
    )


def read_numbers(
    path: Path, shape: tuple[int, ...], dtype: np.dtype[Any], *, start: int = 0
) -> npt.NDArray[Any]:
    """Read voxels written as text, of a shape [k, j, i], from byte `start` of the file."""
    with checked_path(path, _PLAIN_FILE).open("rb") as file:
        file.seek(start)
        words = file.read().split()
    count = 1
    for length in shape:
        count *= int(length)
    if len(words) != count:
        raise FormatError(str(path), f"{len(words)} numbers", f"{count} numbers as the header says")
    kind = dtype.newbyteorder("=")
    if kind.kind == "f":
        return np.array([float(word) for word in words], kind).reshape(shape)
    return np.array([int(word) for word in words], kind).reshape(shape)
