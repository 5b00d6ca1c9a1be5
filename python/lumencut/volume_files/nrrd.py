"""NRRD (.nrrd, .nhdr): pynrrd reads the header; its space becomes LPS, voxels stay as they are."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut._files import checked_path
from lumencut.errors import FormatError
from lumencut.volume_files.opened import Filled, VolumeFile, decoded, inside, shown
from lumencut.volume_files.payload import Codec, check_length, read_numbers, read_voxels
from lumencut.volume_files.slicer_segments import (
    has_segments,
    segmentation_file,
    segments_of,
)
from lumencut.volume_files.straightened_notes import note_sides

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
_FIELDS = frozenset(
    [
        *("type", "dimension", "sizes", "encoding", "endian", "kinds", "data file", "line skip", "byte skip"),
        *("space", "space dimension", "space directions", "space origin", "space units", "spacings"),
        "axis mins",
    ]
)
_WITH_BLANK = {name.replace(" ", ""): name for name in _FIELDS if " " in name}
_HEADER_LIMIT = 1 << 20
_VALUE_LIMIT = 4096
"""Letters of a field: the parser's time grows with their square."""
_TYPES = {name: code for code, names in _NAMES.items() for name in names.split(", ")}


def open_nrrd(path: Path, chosen: Collection[int] | None = None) -> VolumeFile:
    """Read the header of an NRRD file, attached or detached.

    `chosen` are the numbers of the segments that are read of a segmentation of 3D Slicer.
    """
    header, lines, end = _header(path)
    notes: list[str] = []
    remarks: list[str] = []
    note_sides(_content(lines), notes, remarks)
    axes, layers = _axes_and_layers(path, header, is_segmentation=has_segments(lines))
    sizes = [int(size) for size in header["sizes"]]
    size = (sizes[axes[0]], sizes[axes[1]], sizes[axes[2]])
    dtype = _dtype(path, header)
    space = str(header.get("space", ""))
    affine = _affine(path, header, axes, notes)
    long = [axis for axis in range(len(sizes)) if axis in axes or sizes[axis] > 1]
    stored = [sizes[axis] for axis in long]
    read, length = _reader(path, header, end, (tuple(reversed(stored)), dtype))
    file = VolumeFile(
        path, "NRRD", size, dtype, shown(space) or "none stated", affine,
        lambda progress, filled: read(filled), notes, remarks=remarks,
        states_spacing=_states_spacing(header, axes),
        states_orientation="space directions" in header and _patient_space(header) in _TO_LPS,
        settled_type=dtype.newbyteorder("="), check_length=length,
    )  # fmt: skip
    if not has_segments(lines):
        return file
    # NumPy counts the axes of the file from its last one.
    along = next((len(long) - 1 - n for n, axis in enumerate(long) if axis not in axes), None)
    return segmentation_file(file, segments_of(lines, layers), (layers, along), chosen)


def _reader(
    path: Path, header: dict[str, Any], end: int, stored: tuple[tuple[int, ...], np.dtype[Any]]
) -> tuple[Callable[[Filled], npt.NDArray[Any]], Callable[[], bool]]:
    """What reads voxels of a shape, slowest axis first, and a type; what checks the length of the file."""
    shape, dtype = stored
    encoding = _encoding(path, header)
    lines, skip = _skips(path, header, encoding)
    data_path, start = _data_place(path, header, end)

    def read(filled: Filled) -> npt.NDArray[Any]:
        begin = _after_lines(data_path, start, lines)
        if encoding in _TEXT:
            return read_numbers(data_path, shape, dtype, start=begin + skip)
        if skip == -1:
            return read_voxels(data_path, shape, dtype, start=-1, filled=filled)
        codec = _CODECS[encoding]
        return read_voxels(data_path, shape, dtype, start=begin, codec=codec, skip=skip, filled=filled)

    def length() -> bool:
        begin = _after_lines(data_path, start, lines)
        if encoding in _TEXT:
            return False
        if skip == -1:
            return check_length(data_path, shape, dtype, start=-1)
        return check_length(data_path, shape, dtype, start=begin, codec=_CODECS[encoding], skip=skip)

    return read, length


def _header(path: Path) -> tuple[dict[str, Any], list[bytes], int]:
    """The fields that place and describe the voxels, all lines, and the byte behind the header.

    pynrrd parses them. It never sees the other fields nor the key/value pairs, where whoever wrote the file
    may have put anything: it refuses files for what is in them, and quotes it.
    """
    import nrrd

    with path.open("rb") as file:
        head = file.read(_HEADER_LIMIT)
    if not head.startswith(b"NRRD"):
        raise FormatError(str(path), "a compressed NRRD file", "a plain one", "decompress it first")
    stated: dict[str, str] = {}
    lines, end = _lines(path, head)
    for line in lines[1:]:
        name, colon, value = decoded(line).partition(":")
        name = " ".join(name.lower().split())
        name = _WITH_BLANK.get(name, name)
        if line.startswith(b"#") or not colon or value.startswith("=") or name not in _FIELDS:
            continue
        if name in stated:
            raise FormatError(str(path), f"two fields {name!r}", "one", "remove one of them")
        if len(value) > _VALUE_LIMIT:
            found = f"{len(value)} letters in the field {name!r}"
            raise FormatError(str(path), found, f"at most {_VALUE_LIMIT}")
        stated[name] = value.strip()
    try:
        parsed = nrrd.read_header([lines[0].decode("latin-1"), *(f"{n}: {v}" for n, v in stated.items())])
    except (nrrd.NRRDError, ValueError, TypeError, IndexError) as error:
        if "version" in str(error):
            raise FormatError(str(path), "a newer or no NRRD version", "NRRD0001 to NRRD0005") from None
        found = "a field of the header that cannot be read"
        raise FormatError(str(path), found, "numbers as NRRD writes them") from None
    return dict(parsed), lines, end


def _content(lines: Sequence[bytes]) -> str:
    """The field "content" of a header, which says what the file is."""
    fields = (decoded(line).partition(":") for line in lines[1:])
    return next((value.strip() for name, _, value in fields if name.strip().lower() == "content"), "")


def _lines(path: Path, head: bytes) -> tuple[list[bytes], int]:
    """The lines of a header, up to an empty line or the end of the file, and the byte behind them."""
    lines, start = [], 0
    while start < len(head):
        stop = head.find(b"\n", start)
        if stop < 0 and len(head) == _HEADER_LIMIT:
            raise FormatError(str(path), f"a header of over {_HEADER_LIMIT} bytes", "an NRRD header")
        stop = len(head) if stop < 0 else stop
        line, start = head[start:stop].rstrip(), stop + 1
        if not line:
            break
        lines.append(line)
    return lines, min(start, len(head))


def _encoding(path: Path, header: dict[str, Any]) -> str:
    encoding = str(_required(path, header, "encoding")).lower()
    if encoding not in _CODECS and encoding not in _TEXT:
        mend = "write it with encoding gzip or raw"
        raise FormatError(str(path), f"encoding: {shown(encoding)}", "raw, ascii, gzip or bzip2", mend)
    return encoding


def _skips(path: Path, header: dict[str, Any], encoding: str) -> tuple[int, int]:
    """Lines and bytes to leave out before the voxels; -1 bytes stand for all but the last ones."""
    lines, skip = int(header.get("line skip", 0)), int(header.get("byte skip", 0))
    if lines < 0:
        raise FormatError(str(path), f"line skip: {lines}", "0 or more lines")
    if skip < (-1 if encoding == "raw" else 0):
        raise FormatError(str(path), f"byte skip: {skip}", "0 or more bytes, or -1 with encoding raw")
    return lines, skip


def _axes_and_layers(path: Path, header: dict[str, Any], *, is_segmentation: bool) -> tuple[list[int], int]:
    """The three axes of the grid, and the length of another one: 1 but for a segmentation in layers."""
    sizes = [int(size) for size in _required(path, header, "sizes")]
    if len(sizes) != int(_required(path, header, "dimension")) or len(sizes) < 3 or min(sizes) < 1:
        raise FormatError(str(path), f"sizes: {shown(sizes)}", "3 axes, none empty")
    axes = list(range(len(sizes)))
    directions = header.get("space directions")
    if directions is not None and len(directions) == len(sizes):
        axes = [axis for axis in axes if _has_direction(directions[axis])]
    elif len(sizes) > 3:
        axes = [axis for axis in axes if sizes[axis] > 1 or len(sizes) - axis <= 3][:3]
    others = [axis for axis in range(len(sizes)) if axis not in axes[:3]]
    long = [sizes[axis] for axis in others if sizes[axis] != 1]
    if len(axes) != 3 or len(long) > int(is_segmentation):
        kinds = shown(" ".join(str(kind) for kind in header.get("kinds", []))) or "not stated"
        found = f"several values per voxel or time points (sizes: {shown(sizes)}, kinds: {kinds})"
        raise FormatError(str(path), found, "3 axes with a direction", "write one component or time point")
    kinds = header.get("kinds", ["domain"] * len(sizes))
    odd = [str(kinds[axis]) for axis in axes if axis < len(kinds) and _is_no_grid_axis(str(kinds[axis]))]
    if odd:
        raise FormatError(
            str(path), f"an axis of kind {shown(odd[0])}", "domain or space axes", "write one component"
        )
    return axes, long[0] if long else 1


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
    name = str(_required(path, header, "type")).lower()
    if name not in _TYPES:
        raise FormatError(str(path), f"type: {shown(name)}", "an integer or float type")
    dtype = np.dtype(_TYPES[name])
    endian = str(header.get("endian", "")).lower()
    if dtype.itemsize == 1 or str(header.get("encoding", "")).lower() in _TEXT:
        return dtype
    if endian not in ("little", "big"):
        raise FormatError(str(path), f"endian: {shown(endian) or 'nothing'}", "little or big")
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
        stated = _spacings(header, axes)
        if not np.isfinite(stated).all():
            notes.append("no spacing stated: 1 mm assumed")
        affine[:3, :3] = np.diag(np.where(np.isfinite(stated), stated, 1.0))
    if "space origin" in header:
        origin = np.asarray(header["space origin"], dtype=np.float64)
        if origin.shape != (3,):
            raise FormatError(str(path), f"space origin: {origin.size} numbers", "3 numbers")
        affine[:3, 3] = origin
    else:
        unused = ", axis mins are not used" if "axis mins" in header else ""
        notes.append(f"no space origin stated{unused}: (0, 0, 0) assumed")
    affine[:3] *= _unit(header, notes)
    return np.diag([*_signs(path, header, notes), 1.0]) @ affine


def _spacings(header: dict[str, Any], axes: list[int]) -> npt.NDArray[np.float64]:
    """The spacing of each axis of the grid, NaN where none is stated."""
    spacings = np.asarray(header.get("spacings", np.full(len(header["sizes"]), np.nan)), dtype=np.float64)
    return np.array([spacings[axis] if axis < len(spacings) else np.nan for axis in axes])


def _states_spacing(header: dict[str, Any], axes: list[int]) -> bool:
    """Tell whether lengths in mm are known: stated, and not in a unit that nobody knows."""
    is_stated = "space directions" in header or bool(np.isfinite(_spacings(header, axes)).all())
    return is_stated and _space_unit(header) in ("", *_MILLIMETRES)


def _patient_space(header: dict[str, Any]) -> str:
    """The name of the space in full."""
    space = str(header.get("space", "")).lower().removesuffix("-time")
    return _SHORT.get(space, space)


def _signs(path: Path, header: dict[str, Any], notes: list[str]) -> tuple[float, float, float]:
    """What turns the file's space into LPS."""
    space = _patient_space(header)
    if space in _TO_LPS:
        return _TO_LPS[space]
    notes.append(
        f"space {shown(space)!r} names no patient axes: LPS assumed"
        if space
        else "no space stated: LPS assumed"
    )
    return 1.0, 1.0, 1.0


def _unit(header: dict[str, Any], notes: list[str]) -> float:
    """Millimetres per unit of the file."""
    unit = _space_unit(header)
    if not unit:
        return 1.0
    if unit not in _MILLIMETRES:
        notes.append(f"space units {shown(unit)!r} are not known: mm assumed")
    elif _MILLIMETRES[unit] != 1.0:
        notes.append(f"lengths are in {unit}: converted to mm")
    return _MILLIMETRES.get(unit, 1.0)


def _space_unit(header: dict[str, Any]) -> str:
    """The unit of the first axis of the space, in the singular where that is known; empty for none."""
    stated = [str(unit).strip('" ').lower() for unit in header.get("space units", [])][:1]
    if not stated or stated[0] in ("", "???"):
        return ""
    singular = stated[0].removesuffix("s")
    return singular if stated[0] not in _MILLIMETRES and singular in _MILLIMETRES else stated[0]


def _data_place(path: Path, header: dict[str, Any], end: int) -> tuple[Path, int]:
    """The file that holds the voxels and the byte at which they, or the lines to skip, begin."""
    if "data file" not in header:
        return path, end
    name = str(header["data file"])
    if name.split(maxsplit=1)[:1] == ["LIST"] or "%" in name:
        raise FormatError(
            str(path), f"data file: {shown(name)}", "voxels in one file", "write a single .nrrd"
        )
    return inside(path, name, "data file"), 0


def _after_lines(path: Path, start: int, lines: int) -> int:
    if lines <= 0:
        return start
    with checked_path(path, "a file of voxels").open("rb") as file:
        file.seek(start)
        for _ in range(min(lines, path.stat().st_size)):
            if not file.readline():
                break
        return file.tell()
