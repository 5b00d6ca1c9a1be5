"""Kinds of files by their first bytes, for errors about a wrong file.

Readers of files are chosen in another module; here a file may remain unknown.
"""

from __future__ import annotations

import re
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

_HEAD = 4096
_CONVERT = "convert it to NIfTI, NRRD or MetaImage"
_LINES = (".vtp", ".fcsv", ".pth", ".swc", ".tre", ".csv", ".mrk.json")
#: For each length of the header: position and possible values of the magic bytes.
_NIFTI: dict[int, tuple[int, tuple[bytes, ...]]] = {
    348: (344, (b"n+1\0", b"ni1\0")),
    540: (4, (b"n+2\0", b"ni2\0")),
}


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
            return Kind("volume", "a folder", is_dicom=True)
        head = _head(path) if path.is_file() else b""
    except OSError:
        return None
    name = path.name.lower()
    if head:
        return _of_bytes(head, name) or _of_text(head) or _of_name(name)
    return None


def _head(path: Path) -> bytes:
    """Return the first bytes of a file, decompressed if it is gzipped."""
    with path.open("rb") as file:
        head = file.read(_HEAD)
    if not head.startswith(b"\x1f\x8b"):
        return head
    try:
        return zlib.decompressobj(zlib.MAX_WBITS | 16).decompress(head, _HEAD)
    except zlib.error:
        return b""


def _of_bytes(head: bytes, name: str) -> Kind | None:
    if head[128:132] == b"DICM":
        return Kind("volume", "a DICOM image", is_dicom=True)
    if head.startswith(b"PK\3\4") and not name.endswith(".npz"):
        return Kind("volume", "a zip archive", is_dicom=True)
    if head.startswith(b"NRRD"):
        return Kind("volume", "an NRRD volume")
    for length in (int.from_bytes(head[:4], "little"), int.from_bytes(head[:4], "big")):
        offset, magics = _NIFTI.get(length, (0, ()))
        if head[offset : offset + 4] in magics:
            return Kind("volume", "a NIfTI volume")
    if re.search(rb"^ObjectType\s*=\s*Image", head, re.MULTILINE):
        return Kind("volume", "a MetaImage volume")
    return None


def _of_text(head: bytes) -> Kind | None:
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    if text.startswith(b"{"):
        return _of_json(text)
    if text.startswith(b"<"):
        found = re.search(rb"<VTKFile[^>]*\stype\s*=\s*[\"'](\w+)", text)
        return _of_vtk(found[1] if found else b"")
    if text.startswith(b"# vtk DataFile"):
        found = re.search(rb"^\s*DATASET\s+(\w+)", text, re.MULTILINE | re.IGNORECASE)
        return _of_vtk(found[1].upper() if found else b"")
    return None


def _of_vtk(kind: bytes) -> Kind | None:
    if kind in (b"ImageData", b"STRUCTURED_POINTS"):
        return Kind("volume", "a VTK image, which is not read", _CONVERT)
    if kind in (b"PolyData", b"POLYDATA"):
        return Kind("centerlines", "VTK PolyData")
    return None


def _of_json(text: bytes) -> Kind | None:
    kind = re.search(rb"\"vtkClass\"\s*:\s*\"(\w+)\"", text)
    if kind and kind[1] == b"vtkImageData":
        return Kind("volume", "an image in the JSON of vtk.js, which is not read", _CONVERT)
    if kind and kind[1] == b"vtkPolyData":
        mend = "write it as XML, as the vtkXMLPolyDataWriter of VTK does"
        return Kind("centerlines", "PolyData in the JSON of vtk.js, which is not read", mend)
    return Kind("centerlines", "3D Slicer markups") if b'"markups"' in text else None


def _of_name(name: str) -> Kind | None:
    ending = next((ending for ending in _LINES if name.endswith(ending)), None)
    return None if ending is None else Kind("centerlines", f"a {ending} file")
