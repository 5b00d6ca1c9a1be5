"""NRRD (.nrrd, .nhdr): pynrrd reads the header; its space becomes LPS, voxels stay as they are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut._files import checked_path
from lumencut.errors import FormatError
from lumencut.volume_files.opened import Progress, VolumeFile
from lumencut.volume_files.payload import Codec, read_numbers, read_voxels

_TO_LPS = {
    "left-posterior-superior": (1.0, 1.0, 1.0),
    "right-anterior-superior": (-1.0, -1.0, 1.0),
    "left-anterior-superior": (1.0, -1.0, 1.0),
}
_SHORT = {"lps": "left-posterior-superior", "ras": "right-anterior-superior", "las": "left-anterior-superior"}
_MILLIMETRES = {
    "mm": 1.0,
    "millimeter": 1.0,
    "cm": 10.0,
    "m": 1000.0,
    "um": 0.001,
    "µm": 0.001,
    "micron": 0.001,
}
_CODECS: dict[str, Codec] = {"raw": "raw", "gzip": "zlib", "gz": "zlib", "bzip2": "bzip2", "bz2": "bzip2"}
_TEXT = ("ascii", "text", "txt")
_NAMES = {
    "i1": "signed char, int8, int8_t",
    "u1": "uchar, unsigned char, uint8, uint8_t",
    "i2": "short, short int, signed short, signed short int, int16, int16_t",
    "u2": "ushort, unsigned short, unsigned short int, uint16, uint16_t",
    "i4": "int, signed int, int32, int32_t",
    "u4": "uint, unsigned int, uint32, uint32_t",
    "i8": "longlong, long long, long long int, signed long long, signed long long int, int64, int64_t",
    "u8": "ulonglong, unsigned long long, unsigned long long int, uint64, uint64_t",
    "f4": "float",
    "f8": "double",
}
_TYPES = {name: code for code, names in _NAMES.items() for name in names.split(", ")}


def open_nrrd(path: Path) -> VolumeFile:
    """Read the header of an NRRD file, attached or detached."""
    import nrrd

    with path.open("rb") as file:
        header: dict[str, Any] = dict(nrrd.read_header(file))
        end = file.tell()
    notes: list[str] = []
    axes = _spatial_axes(path, header)
    sizes = [int(size) for size in header["sizes"]]
    size = (sizes[axes[0]], sizes[axes[1]], sizes[axes[2]])
    dtype = _dtype(path, header)
    space = str(header.get("space", ""))
    affine = _affine(path, header, axes, notes)
    data_path, start = _data_place(path, header, end)
    encoding = str(header.get("encoding", "")).lower()
    if encoding not in _CODECS and encoding not in _TEXT:
        raise FormatError(str(path), f"encoding: {encoding or 'nothing'}", "raw, ascii, gzip or bzip2")
    skip = int(_field(header, "byte skip", 0))

    def load(progress: Progress) -> npt.NDArray[Any]:
        begin = _after_lines(data_path, start, int(_field(header, "line skip", 0)))
        if encoding in _TEXT:
            return read_numbers(data_path, size[::-1], dtype, start=begin + max(skip, 0))
        if skip == -1 and _CODECS[encoding] == "raw":
            length = dtype.itemsize * size[0] * size[1] * size[2]
            return read_voxels(data_path, size[::-1], dtype, start=data_path.stat().st_size - length)
        return read_voxels(data_path, size[::-1], dtype, start=begin, codec=_CODECS[encoding], skip=skip)

    return VolumeFile(path, "NRRD", size, dtype, space or "none stated", affine, load, notes)


def _field(header: dict[str, Any], name: str, default: Any) -> Any:
    """A field whose name may be written with or without its blank."""
    return header.get(name, header.get(name.replace(" ", ""), default))


def _spatial_axes(path: Path, header: dict[str, Any]) -> list[int]:
    """The three axes of the grid; further axes must have length 1."""
    sizes = [int(size) for size in _required(path, header, "sizes")]
    if len(sizes) != int(_required(path, header, "dimension")) or len(sizes) < 3 or min(sizes) < 1:
        raise FormatError(str(path), f"sizes: {sizes}", "3 axes, none empty")
    axes = list(range(len(sizes)))
    directions = header.get("space directions")
    if directions is not None and len(directions) == len(sizes):
        axes = [axis for axis in axes if _has_direction(directions[axis])]
    elif len(sizes) > 3:
        axes = [axis for axis in axes if sizes[axis] > 1 or len(sizes) - axis <= 3][:3]
    others = [axis for axis in range(len(sizes)) if axis not in axes[:3]]
    if len(axes) != 3 or any(sizes[axis] != 1 for axis in others):
        kinds = " ".join(str(kind) for kind in header.get("kinds", [])) or "not stated"
        found = f"several values per voxel or time points (sizes: {sizes}, kinds: {kinds})"
        raise FormatError(str(path), found, "3 axes with a direction", "write one component or time point")
    kinds = header.get("kinds", ["domain"] * len(sizes))
    odd = [str(kinds[axis]) for axis in axes if axis < len(kinds) and _is_no_grid_axis(str(kinds[axis]))]
    if odd:
        raise FormatError(
            str(path), f"an axis of kind {odd[0]}", "domain or space axes", "write one component"
        )
    return axes


def _has_direction(direction: Any) -> bool:
    return direction is not None and not np.isnan(np.asarray(direction, dtype=np.float64)).all()


def _is_no_grid_axis(kind: str) -> bool:
    return kind.lower() not in ("domain", "space", "none", "???", "")


def _required(path: Path, header: dict[str, Any], name: str) -> Any:
    if name not in header:
        raise FormatError(
            str(path), f"no field {name!r}", "an NRRD header with type, dimension, sizes, encoding"
        )
    return header[name]


def _dtype(path: Path, header: dict[str, Any]) -> np.dtype[Any]:
    name = str(_required(path, header, "type"))
    if name not in _TYPES:
        raise FormatError(str(path), f"type: {name}", "an integer or float type")
    dtype = np.dtype(_TYPES[name])
    endian = str(header.get("endian", ""))
    if dtype.itemsize == 1 or str(header.get("encoding", "")).lower() in _TEXT:
        return dtype
    if endian not in ("little", "big"):
        raise FormatError(str(path), f"endian: {endian or 'nothing'}", "little or big")
    return dtype.newbyteorder("<" if endian == "little" else ">")


def _affine(path: Path, header: dict[str, Any], axes: list[int], notes: list[str]) -> npt.NDArray[np.float64]:
    affine = np.eye(4)
    directions = header.get("space directions")
    if directions is not None:
        columns = [np.asarray(directions[axis], dtype=np.float64) for axis in axes]
        if any(column.shape != (3,) for column in columns):
            raise FormatError(str(path), f"space directions: {len(columns[0])} numbers", "3 numbers per axis")
        affine[:3, :3] = np.stack(columns, axis=1)
    else:
        spacings = np.asarray(header.get("spacings", np.full(len(header["sizes"]), np.nan)), dtype=np.float64)
        stated = np.array([spacings[axis] if axis < len(spacings) else np.nan for axis in axes])
        if not np.isfinite(stated).all():
            notes.append("no spacing stated: 1 mm assumed")
        affine[:3, :3] = np.diag(np.where(np.isfinite(stated), stated, 1.0))
    if "space origin" in header:
        affine[:3, 3] = np.asarray(header["space origin"], dtype=np.float64)
    else:
        notes.append("no space origin stated: (0, 0, 0) assumed")
    affine[:3] *= _unit(header, notes)
    return np.diag([*_signs(path, header, notes), 1.0]) @ affine


def _signs(path: Path, header: dict[str, Any], notes: list[str]) -> tuple[float, float, float]:
    """What turns the file's space into LPS."""
    space = str(header.get("space", "")).lower().removesuffix("-time")
    space = _SHORT.get(space, space)
    if space in _TO_LPS:
        return _TO_LPS[space]
    notes.append(
        f"space {space!r} names no patient axes: LPS assumed" if space else "no space stated: LPS assumed"
    )
    return 1.0, 1.0, 1.0


def _unit(header: dict[str, Any], notes: list[str]) -> float:
    """Millimetres per unit of the file."""
    stated = [str(unit).strip('" ').lower() for unit in header.get("space units", [])][:1]
    if not stated or stated[0] in ("", "???"):
        return 1.0
    unit = stated[0] if stated[0] in _MILLIMETRES else stated[0].removesuffix("s")
    if unit not in _MILLIMETRES:
        notes.append(f"space units {stated[0]!r} are not known: mm assumed")
    elif _MILLIMETRES[unit] != 1.0:
        notes.append(f"lengths are in {unit}: converted to mm")
    return _MILLIMETRES.get(unit, 1.0)


def _data_place(path: Path, header: dict[str, Any], end: int) -> tuple[Path, int]:
    """The file that holds the voxels and the byte at which they, or the lines to skip, begin."""
    name = _field(header, "data file", None)
    if name is None:
        return path, end
    if not isinstance(name, str) or name.startswith("LIST") or "%" in name:
        raise FormatError(str(path), f"data file: {name}", "voxels in one file", "write a single .nrrd")
    return path.parent / name, 0


def _after_lines(path: Path, start: int, lines: int) -> int:
    if lines <= 0:
        return start
    with checked_path(path, "a file of voxels").open("rb") as file:
        file.seek(start)
        for _ in range(min(lines, path.stat().st_size)):
            if not file.readline():
                break
        return file.tell()
