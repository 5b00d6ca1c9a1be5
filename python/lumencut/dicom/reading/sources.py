"""Where DICOM data lie: files of a folder, a single file, or the members of a zip archive."""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO

from lumencut.base.foreign_errors import printable, refusing
from lumencut.dicom.reading.unpacked import BoundedFile, Inflating, Unpacked
from lumencut.errors import FormatError

_ZIP_SIGNATURES = (b"PK\x03\x04", b"PK\x05\x06")
_ALWAYS_ALLOWED = 1 << 30
"""Unpacked bytes that any archive may claim; real slices beyond that pack far less than the ratio below."""
_ARCHIVE_RATIO = 200
_DEFLATE_LIMIT = 1032
"""No byte of a deflate stream becomes more bytes than this."""
DEFLATED, _EXPLICIT = b"1.2.840.10008.1.2.1.99", b"1.2.840.10008.1.2.1"
_META_LIMIT = 1 << 16
"""The file meta information is shorter."""


@dataclass(frozen=True, eq=False)
class Source:
    """One file that may be DICOM: on disk, or a member of an archive."""

    path: Path
    size: int
    member: str = ""
    archive: zipfile.ZipFile | None = field(default=None, repr=False)

    @property
    def name(self) -> str:
        """Its name without folders, on one printable line."""
        return printable(self.member.rpartition("/")[2] if self.member else self.path.name)

    def __str__(self) -> str:
        return f"{self.path}: {printable(self.member)}" if self.member else str(self.path)

    @property
    def is_packed(self) -> bool:
        """Whether its bytes are unpacked as they are read, so that seeking backwards is slow."""
        return self.archive is not None

    def open(self) -> BinaryIO:
        """Open it for reading; a member of an archive is unpacked as it is read."""
        if self.archive is None:
            return BoundedFile(io.FileIO(self.path), self.path.stat().st_size, self)
        return BoundedFile(Unpacked(partial(self.archive.open, self.member)), self.size, self)

    def all_attributes(self) -> Any:
        """Read all of its attributes but the pixels, as a dataset of pydicom."""
        import pydicom

        with self.open() as stream:
            return pydicom.dcmread(stream, stop_before_pixels=True, force=True)

    def attributes(self, tags: list[int]) -> Any:
        """Read some attributes of a header that was read before, as a dataset of pydicom."""
        import pydicom

        with self.open() as stream:
            return pydicom.dcmread(stream, stop_before_pixels=True, force=True, specific_tags=tags)

    def head(self, count: int) -> bytes:
        """Read its first bytes."""
        with open(self.path, "rb") if self.archive is None else self.archive.open(self.member) as file:
            return file.read(count)


def sources(path: Path) -> list[Source]:
    """List the files below a folder, the members of a zip archive, or a single file."""
    if path.is_dir():
        return [Source(file, file.stat().st_size) for file in sorted(_below(path))]
    with path.open("rb") as file:
        zipped = is_zip(file.read(4))
    return _members(path) if zipped else [Source(path, path.stat().st_size)]


def _below(folder: Path) -> Iterator[Path]:
    """The files below a folder, including linked folders, each real folder once."""
    seen: set[tuple[int, int]] = set()
    for place, folders, names in os.walk(folder, followlinks=True, onerror=_unreadable):
        state = os.stat(place)
        if (state.st_dev, state.st_ino) in seen:
            folders.clear()
            continue
        seen.add((state.st_dev, state.st_ino))
        yield from (file for name in names if (file := Path(place, name)).is_file())


def _unreadable(error: OSError) -> None:
    raise error


def is_zip(head: bytes) -> bool:
    """Return whether the first bytes are those of a zip archive."""
    return head[:4] in _ZIP_SIGNATURES


def not_dicom(source: Source) -> str:
    """Return the kind of a file that is not plain DICOM."""
    head = source.head(4)
    packed = "zip archive" if is_zip(head) else "gzipped" if head[:2] == b"\x1f\x8b" else ""
    return f"{packed}; unpack it first" if packed else "no DICOM"


def _members(path: Path) -> list[Source]:
    """The files of an archive, sorted by name; nothing is unpacked to disk."""
    with refusing(path, "zip archive", []):
        archive = zipfile.ZipFile(path)
    infos = sorted((info for info in archive.infolist() if not info.is_dir()), key=lambda one: one.filename)
    if any(info.flag_bits & 1 for info in infos):
        raise FormatError(
            str(path), "an encrypted archive", "an archive without a password", "unpack it first"
        )
    claimed = sum(info.file_size for info in infos)
    if claimed > max(_ALWAYS_ALLOWED, _ARCHIVE_RATIO * path.stat().st_size):
        found = f"an archive of {path.stat().st_size} bytes that claims to unpack to {claimed} bytes"
        expected = f"at most {_ARCHIVE_RATIO} times the size of the archive"
        raise FormatError(str(path), found, expected, "unpack it first")
    return [Source(path, info.file_size, info.filename, archive) for info in infos]


@dataclass(frozen=True, eq=False)
class Deflated(Source):
    """The inflated form of a file whose dataset is deflated."""

    packed: Source | None = None

    @property
    def is_packed(self) -> bool:
        """Whether its bytes are unpacked as they are read."""
        return True

    def open(self) -> BinaryIO:
        """Open it for reading; it is inflated as it is read."""
        return BoundedFile(Unpacked(self._begin), self.size, self)

    def head(self, count: int) -> bytes:
        """Read its first bytes."""
        with self.open() as file:
            return file.read(count)

    def _begin(self) -> Inflating:
        assert self.packed is not None, "made by `inflated`"
        head = self.packed.head(_META_LIMIT)
        plain = head[: _behind_meta(head)].replace(DEFLATED, _EXPLICIT.ljust(len(DEFLATED), b"\0"))
        stream = self.packed.open()
        stream.seek(len(plain))
        return Inflating(plain, stream)


def is_deflated(head: bytes) -> bool:
    """Return whether the dataset of a file is deflated, by its first bytes."""
    return DEFLATED in head[: _behind_meta(head)]


def inflated(source: Source) -> Deflated:
    """Return the inflated form of a file whose dataset is deflated."""
    return Deflated(source.path, _DEFLATE_LIMIT * source.size, source.member, packed=source)


def _behind_meta(head: bytes) -> int:
    """The first byte of the dataset; the first element of the preceding group states its length."""
    return min(144 + int.from_bytes(head[140:144], "little"), _META_LIMIT)
