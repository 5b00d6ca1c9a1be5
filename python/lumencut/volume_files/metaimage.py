"""MetaImage (.mha, .mhd): always LPS; the rows of TransformMatrix are the directions of i, j, k (ITK)."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError
from lumencut.volume_files.opened import Filled, Progress, VolumeFile, decoded, inside, shown
from lumencut.volume_files.payload import Codec, check_length, read_numbers, read_voxels

_HEADER_LIMIT = 1 << 16
_MOST_DIMS = 10
_SPACING = ("ElementSpacing", "ElementSize")
_DIRECTION = ("TransformMatrix", "Rotation", "Orientation")
_SEPARATOR = re.compile("[=:]")
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
    (dims,) = _whole(path, fields, "NDims", 1)
    if not 3 <= dims <= _MOST_DIMS:
        raise FormatError(str(path), f"NDims = {dims}", "3 axes, or more of length 1")
    sizes = _whole(path, fields, "DimSize", dims)
    if any(size != 1 for size in sizes[3:]) or min(sizes) < 1:
        raise FormatError(
            str(path), f"DimSize {shown(sizes)}", "3 axes, or more of length 1", "write one time point"
        )
    if (channels := fields.get("ElementNumberOfChannels", "1")) != "1":
        raise FormatError(str(path), f"{shown(channels)} channels per voxel", "one", "write one channel")
    notes: list[str] = []
    dtype = _dtype(path, fields)
    affine = _affine(path, fields, dims, notes)
    agrees = _label_agrees(fields.get("AnatomicalOrientation", ""), affine, notes)
    size = (sizes[0], sizes[1], sizes[2])
    _note_intensity(fields, notes)
    binary = _is_true(fields, "BinaryData", default=True)
    codec: Codec = "zlib" if _is_true(fields, "CompressedData") else "raw"
    data_path, start = _data_place(path, fields, end, binary and codec == "raw")

    def load(progress: Progress, filled: Filled) -> npt.NDArray[Any]:
        if not binary:
            return read_numbers(data_path, size[::-1], dtype, start=start)
        return read_voxels(data_path, size[::-1], dtype, start=start, codec=codec, filled=filled)

    def length() -> bool:
        return binary and check_length(data_path, size[::-1], dtype, start=start, codec=codec)

    return VolumeFile(
        path, "MetaImage", size, dtype, "LPS (as every MetaImage)", affine, load, notes,
        states_spacing=any(name in fields for name in _SPACING),
        # A matrix that a label contradicts states two orientations, and none that can be relied on.
        states_orientation=agrees and any(name in fields for name in (*_DIRECTION, "AnatomicalOrientation")),
        settled_type=dtype.newbyteorder("="), check_length=length,
    )  # fmt: skip


def _fields(path: Path) -> tuple[dict[str, str], int]:
    """The header's fields and the byte behind it."""
    fields: dict[str, str] = {}
    with path.open("rb") as file:
        head = file.read(_HEADER_LIMIT)
    start = 0
    while (stop := head.find(b"\n", start)) >= 0 or start < len(head):
        stop = len(head) if stop < 0 else stop
        line = _SEPARATOR.split(decoded(head[start:stop]), maxsplit=1)
        if len(line) < 2:
            break
        fields[line[0].strip()] = line[1].strip()
        start = stop + 1
        if line[0].strip() == "ElementDataFile":
            return fields, start
    raise FormatError(str(path), "a header without ElementDataFile", "a MetaImage header")


def _whole(path: Path, fields: dict[str, str], name: str, count: int) -> list[int]:
    values = _numbers(path, fields, (name,), count, None)
    if (values != np.rint(values)).any() or (np.abs(values) > 2**40).any():
        raise FormatError(str(path), f"{name} = {shown(fields[name])}", "whole numbers")
    return [int(value) for value in values]


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
        found = "nothing" if text is None else shown(text)
        raise FormatError(str(path), f"{names[0]} = {found}", f"{count} finite numbers")
    return values


def _is_true(fields: dict[str, str], name: str, *, default: bool = False) -> bool:
    """Tell as MetaIO does, by the first letter."""
    return fields.get(name, str(default))[:1] in ("T", "t", "1")


def _dtype(path: Path, fields: dict[str, str]) -> np.dtype[Any]:
    kind = fields.get("ElementType", "")
    if kind not in _TYPES:
        raise FormatError(
            str(path), f"ElementType = {shown(kind) or 'nothing'}", f"one of {', '.join(_TYPES)}"
        )
    big = _is_true(fields, "BinaryDataByteOrderMSB") or _is_true(fields, "ElementByteOrderMSB")
    return np.dtype((">" if big else "<") + _TYPES[kind])


def _affine(path: Path, fields: dict[str, str], dims: int, notes: list[str]) -> npt.NDArray[np.float64]:
    if not any(name in fields for name in _SPACING):
        notes.append("no ElementSpacing: 1 mm assumed")
    spacing = _numbers(path, fields, _SPACING, dims, np.ones(dims))
    origin = _numbers(path, fields, ("Offset", "Position", "Origin"), dims, np.zeros(dims))
    rows = _numbers(path, fields, _DIRECTION, dims * dims, np.eye(dims).ravel()).reshape(dims, dims)
    if not (spacing[:3] > 0).all():
        raise FormatError(str(path), f"ElementSpacing = {spacing.tolist()}", "positive distances in mm")
    affine = np.eye(4)
    affine[:3, :3] = rows[:3, :3].T * spacing[:3]
    affine[:3, 3] = origin[:3]
    return affine


def _label_agrees(label: str, affine: npt.NDArray[np.float64], notes: list[str]) -> bool:
    """Tell whether a label (the side on which each axis begins, as ITK writes it) goes with the matrix."""
    axes = np.argmax(np.abs(affine[:3, :3]), axis=0)
    sides = [("RL", "AP", "IS")[axis][int(affine[axis, column] < 0)] for column, axis in enumerate(axes)]
    agrees = not (len(label) == 3 and set(label) <= set("RLAPIS")) or label == "".join(sides)
    if not agrees:
        notes.append(f"AnatomicalOrientation = {label}, the matrix says {''.join(sides)}: the matrix is used")
    return agrees


def _note_intensity(fields: dict[str, str], notes: list[str]) -> None:
    """Note a scaling of the values, which ITK does not apply either."""
    for name, neutral in (
        ("ElementToIntensityFunctionSlope", 1.0),
        ("ElementToIntensityFunctionOffset", 0.0),
    ):
        try:
            odd = float(fields.get(name, neutral)) != neutral
        except ValueError:
            odd = True
        if odd:
            notes.append(f"{name} is not applied, as ITK does not")


def _data_place(path: Path, fields: dict[str, str], end: int, plain: bool) -> tuple[Path, int]:
    """The file that holds the voxels and the byte at which they begin, -1 if they are its last bytes."""
    name = fields["ElementDataFile"]
    if name.split(maxsplit=1)[:1] == ["LIST"] or "%" in name:
        raise FormatError(
            str(path), f"ElementDataFile = {shown(name)}", "voxels in one file", "write a single .mha"
        )
    local = name.upper() == "LOCAL"
    data_path = path if local else inside(path, name, "ElementDataFile")
    header = _whole(path, fields, "HeaderSize", 1)[0] if "HeaderSize" in fields else 0
    if header < (-1 if plain else 0) or (local and header not in (-1, 0, end)):
        # ITK counts from the start of the file even there, where nobody else would.
        expected = "0 or more bytes before the voxels of another file, or -1 with plain voxels"
        raise FormatError(str(path), f"HeaderSize = {header}", expected, "write a single .mha")
    return data_path, end if local and header >= 0 else header
