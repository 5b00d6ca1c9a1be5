"""MetaImage (.mha, .mhd): always LPS; the rows of TransformMatrix are the directions of i, j, k (ITK)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError
from lumencut.volume_files.opened import Progress, VolumeFile
from lumencut.volume_files.payload import Codec, read_numbers, read_voxels

_HEADER_LIMIT = 1 << 16
_TYPES = {
    "MET_CHAR": "i1",
    "MET_UCHAR": "u1",
    "MET_SHORT": "i2",
    "MET_USHORT": "u2",
    "MET_INT": "i4",
    "MET_UINT": "u4",
    "MET_LONG": "i4",
    "MET_ULONG": "u4",
    "MET_LONG_LONG": "i8",
    "MET_ULONG_LONG": "u8",
    "MET_FLOAT": "f4",
    "MET_DOUBLE": "f8",
}


def open_metaimage(path: Path) -> VolumeFile:
    """Read the header of a MetaImage file."""
    fields, end = _fields(path)
    dims = _numbers(path, fields, ("NDims",), 1, None).astype(int)[0]
    sizes = [int(size) for size in _numbers(path, fields, ("DimSize",), dims, None)]
    if dims < 3 or any(size != 1 for size in sizes[3:]) or min(sizes) < 1:
        raise FormatError(
            str(path), f"DimSize {sizes}", "3 axes, or more of length 1", "write one time point"
        )
    if (channels := fields.get("ElementNumberOfChannels", "1")) != "1":
        raise FormatError(str(path), f"{channels} channels per voxel", "one", "write one channel")
    notes: list[str] = []
    dtype = _dtype(path, fields)
    affine = _affine(path, fields, dims, notes)
    size = (sizes[0], sizes[1], sizes[2])
    data_path, start = _data_place(path, fields, end, dtype.itemsize * sizes[0] * sizes[1] * sizes[2])

    def load(progress: Progress) -> npt.NDArray[Any]:
        if not _is_true(fields, "BinaryData", default=True):
            return read_numbers(data_path, size[::-1], dtype, start=start)
        codec: Codec = "zlib" if _is_true(fields, "CompressedData") else "raw"
        return read_voxels(data_path, size[::-1], dtype, start=start, codec=codec)

    return VolumeFile(path, "MetaImage", size, dtype, "LPS (as every MetaImage)", affine, load, notes)


def _fields(path: Path) -> tuple[dict[str, str], int]:
    """The header's fields and the byte behind it."""
    fields: dict[str, str] = {}
    with path.open("rb") as file:
        head = file.read(_HEADER_LIMIT)
    start = 0
    while (stop := head.find(b"\n", start)) >= 0 or start < len(head):
        stop = len(head) if stop < 0 else stop
        name, equals, value = head[start:stop].decode("latin-1").partition("=")
        if not equals:
            break
        fields[name.strip()] = value.strip()
        start = stop + 1
        if name.strip() == "ElementDataFile":
            return fields, start
    raise FormatError(str(path), "a header without ElementDataFile", "a MetaImage header")


def _numbers(
    path: Path, fields: dict[str, str], names: tuple[str, ...], count: int, default: npt.ArrayLike | None
) -> npt.NDArray[np.float64]:
    """The numbers of the first of several synonymous fields that is there."""
    text = next((fields[name] for name in names if name in fields), None)
    if text is None and default is not None:
        return np.asarray(default, dtype=np.float64)
    try:
        values = np.array([float(word) for word in (text or "").split()])
    except ValueError:
        values = np.empty(0)
    if values.size != count or not np.isfinite(values).all():
        found = "nothing" if text is None else f"{text!r}"
        raise FormatError(str(path), f"{names[0]} = {found}", f"{count} finite numbers")
    return values


def _is_true(fields: dict[str, str], name: str, *, default: bool = False) -> bool:
    return fields.get(name, str(default)).lower() in ("true", "1")


def _dtype(path: Path, fields: dict[str, str]) -> np.dtype[Any]:
    kind = fields.get("ElementType", "")
    if kind not in _TYPES:
        raise FormatError(str(path), f"ElementType = {kind or 'nothing'}", f"one of {', '.join(_TYPES)}")
    big = _is_true(fields, "BinaryDataByteOrderMSB") or _is_true(fields, "ElementByteOrderMSB")
    return np.dtype((">" if big else "<") + _TYPES[kind])


def _affine(path: Path, fields: dict[str, str], dims: int, notes: list[str]) -> npt.NDArray[np.float64]:
    if "ElementSpacing" not in fields and "ElementSize" not in fields:
        notes.append("no ElementSpacing: 1 mm assumed")
    spacing = _numbers(path, fields, ("ElementSpacing", "ElementSize"), dims, np.ones(dims))
    origin = _numbers(path, fields, ("Offset", "Position", "Origin"), dims, np.zeros(dims))
    names = ("TransformMatrix", "Rotation", "Orientation")
    rows = _numbers(path, fields, names, dims * dims, np.eye(dims).ravel()).reshape(dims, dims)
    if not (spacing[:3] > 0).all():
        raise FormatError(str(path), f"ElementSpacing = {spacing.tolist()}", "positive distances in mm")
    affine = np.eye(4)
    affine[:3, :3] = rows[:3, :3].T * spacing[:3]
    affine[:3, 3] = origin[:3]
    _compare_label(fields.get("AnatomicalOrientation", ""), affine, notes)
    return affine


def _compare_label(label: str, affine: npt.NDArray[np.float64], notes: list[str]) -> None:
    """Note a label (the side on which each axis begins, as ITK writes it) that contradicts the matrix."""
    axes = np.argmax(np.abs(affine[:3, :3]), axis=0)
    sides = [("RL", "AP", "IS")[axis][int(affine[axis, column] < 0)] for column, axis in enumerate(axes)]
    if len(label) == 3 and set(label) <= set("RLAPIS") and label != "".join(sides):
        notes.append(f"AnatomicalOrientation = {label}, the matrix says {''.join(sides)}: the matrix is used")


def _data_place(path: Path, fields: dict[str, str], end: int, length: int) -> tuple[Path, int]:
    """The file that holds the voxels and the byte at which they begin."""
    name = fields["ElementDataFile"]
    if name.upper().startswith("LIST") or "%" in name:
        raise FormatError(str(path), f"ElementDataFile = {name}", "voxels in one file", "write a single .mha")
    local = name.upper() == "LOCAL"
    data_path = path if local else path.parent / name
    header = int(_numbers(path, fields, ("HeaderSize",), 1, [0.0])[0])
    if header < 0:
        return data_path, max(data_path.stat().st_size - length, 0)
    return data_path, header + (end if local else 0)
