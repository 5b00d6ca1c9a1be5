"""Kinds of files by their first bytes, for errors about a wrong file.

Readers of files are chosen in another module; here a file may remain unknown.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, cast

from lumencut import _lumencut


@dataclass(frozen=True)
class Kind:
    """The kind of a file.

    Attributes
    ----------
    role : "volume" or "centerlines"
        Which of the two the file may be.
    name : str
        Its description, such as ``a NIfTI volume``.
    mend : str
        How to make it readable; empty if it is supported.
    is_dicom : bool
        Whether it can be a DICOM series.
    """

    role: Literal["volume", "centerlines"]
    name: str
    mend: str = ""
    is_dicom: bool = False


def kind_of(path: Path) -> Kind | None:
    """Return the kind of a file or folder; None if it is missing, not a plain file, or unknown."""
    try:
        if path.is_dir():
            head = None
        elif path.is_file():
            head = _head(path)
        else:
            return None
    except OSError:
        return None
    kind, role, words, mend = _lumencut.file_kind(head, path.name)
    if role == "other":
        return None
    of_role = cast('Literal["volume", "centerlines"]', role)
    return Kind(of_role, words, mend, is_dicom=kind in ("dicom", "zip", "folder"))


def extensions(role: str, *, written: bool = False) -> tuple[str, ...]:
    """Return the file name extensions of a role, such as ``.vtp``, that are read or written."""
    kinds = [(read, saved) for _, of_role, _, read, saved in _lumencut.FILE_KINDS if of_role == role]
    return tuple(one for read, saved in kinds for one in (saved if written else read))


def written_kind(path: Path, role: str) -> str | None:
    """Return the kind that is written to a file with this extension, such as ``nifti``; None if none is."""
    kinds = [(name, saved) for name, of_role, _, _, saved in _lumencut.FILE_KINDS if of_role == role]
    return next((name for name, saved in kinds if path.name.lower().endswith(tuple(saved))), None)


def _head(path: Path) -> bytes:
    """Return the first bytes of a file, decompressed if it is gzipped."""
    with path.open("rb") as file:
        head = file.read(_lumencut.FILE_HEAD)
    if not head.startswith(b"\x1f\x8b"):
        return head
    try:
        return zlib.decompressobj(zlib.MAX_WBITS | 16).decompress(head, _lumencut.FILE_HEAD)
    except zlib.error:
        return b""
