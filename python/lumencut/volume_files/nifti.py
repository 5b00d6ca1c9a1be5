"""NIfTI-1 and -2, single files and pairs, gzipped or not: the RAS+ affine becomes LPS, voxels stay."""

from __future__ import annotations

import logging
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut._files import checked_path
from lumencut.errors import FormatError
from lumencut.volume_files.nifti_labels import LONGEST, has_extensions, label_names_in
from lumencut.volume_files.opened import Filled, Progress, VolumeFile, shown, unfollowed
from lumencut.volume_files.payload import Codec, check_length, first_bytes, read_voxels
from lumencut.volume_files.rescale import is_integral, rescaled
from lumencut.volume_files.room import require_memory
from lumencut.volume_files.straightened_notes import note_sides

LPS_FROM_RAS = np.diag([-1.0, -1.0, 1.0, 1.0])

_HEADER_BYTES = {348: "NIfTI-1", 540: "NIfTI-2"}
_PACKED = {b"BZh": "bzip2", b"\xfd7zXZ\0": "xz", b"\x28\xb5\x2f\xfd": "zstd", b"PK\3\4": "zip"}
_NUMBERS = (2, 4, 8, 16, 64, 256, 512, 768, 1024, 1280)
_COMPLEX = ("complex voxels", "write their magnitude")
_COLOUR = ("colour voxels", "write one channel")
_OTHER_TYPES = {
    0: ("voxels of no stated type", "convert the file"),
    1: ("voxels of one bit", "write bytes"),
    32: _COMPLEX,
    1792: _COMPLEX,
    2048: _COMPLEX,
    128: _COLOUR,
    2304: _COLOUR,
    1536: ("voxels of 128-bit floats", "write 64-bit floats"),
}
_SAME_AXIS = np.cos(np.radians(25))
_MILLIMETRES = {"mm": 1.0, "meter": 1000.0, "micron": 0.001}


def open_nifti(path: Path) -> VolumeFile:
    """Read the header of a NIfTI file or of either file of a pair."""
    header_path = _partner(path, ".img", ".hdr")
    notes: list[str] = []
    remarks: list[str] = []
    header, kind, paired = _header(header_path)
    data_path = _partner(header_path, ".hdr", ".img") if paired else header_path
    offset = _offset(path, header, kind, data_path == header_path, notes)
    size = _size(path, header)
    dtype = np.dtype(header.get_data_dtype())
    _mend(header, notes)
    note_sides(bytes(header["descrip"]).decode("latin-1"), notes, remarks)
    affine = LPS_FROM_RAS @ _best_affine(path, header)
    affine[:3] *= millimetres(header, notes)
    _note_forms(header, size, notes)
    slope, intercept = _scaling(path, header)
    is_scaled = (slope, intercept) != (1.0, 0.0)
    settled: np.dtype[Any] | None = dtype.newbyteorder("=")
    if is_scaled:
        floats = "float64" if dtype == np.float64 else "float32"
        exact = dtype.kind in "iu" and is_integral(slope, intercept)
        settled = None if exact else np.dtype(floats)
        kind = "integers where 64 bits hold them" if exact else f"read as {floats}"
        remarks.append(f"values are scaled by {slope:g} and shifted by {intercept:g}: {kind}")

    def load(progress: Progress, filled: Filled) -> npt.NDArray[Any]:
        codec: Codec = "zlib" if _is_gzip(data_path) else "raw"
        heard = unfollowed if is_scaled else filled
        # What a scaling needs at least, before the values tell it.
        scaled = (settled or dtype).itemsize * size[0] * size[1] * size[2] if is_scaled else 0
        stored = read_voxels(
            data_path, size[::-1], dtype, codec=codec, skip=offset, beyond=scaled, filled=heard
        )
        return rescaled(stored, slope, intercept, partial(require_memory, data_path))

    def length() -> bool:
        codec: Codec = "zlib" if _is_gzip(data_path) else "raw"
        return check_length(data_path, size[::-1], dtype, codec=codec, skip=offset)

    names = _label_names(header_path, header, offset if data_path == header_path else LONGEST)
    details = {"labels": "; ".join(f"{value} {name}" for value, name in names.items())} if names else {}
    space = _stated_space(header)
    return VolumeFile(
        path, kind, size, dtype, space, affine, load, notes, remarks=remarks,
        states_spacing=states_spacing(header), states_orientation=states_orientation(header),
        settled_type=settled, label_names=names, details=details, check_length=length,
    )  # fmt: skip


def _partner(path: Path, mine: str, other: str) -> Path:
    """The other file of a pair if this one is `mine` (``x.img.gz`` belongs to ``x.hdr.gz`` or ``x.hdr``)."""
    name = path.name
    zipped = ".gz" if name.lower().endswith(".gz") else ""
    stem = name[: len(name) - len(zipped)]
    if not stem.lower().endswith(mine):
        return path
    other = other.upper() if stem.endswith(mine.upper()) else other
    found = [path.with_name(stem[: -len(mine)] + other + tail) for tail in (zipped, "", ".gz")]
    return next((candidate for candidate in found if candidate.exists()), found[0])


def _is_gzip(path: Path) -> bool:
    with checked_path(path, "a file of voxels").open("rb") as file:
        return file.read(2) == b"\x1f\x8b"


def head_bytes(path: Path, count: int) -> bytes:
    """Give the first bytes of a file, decompressed if it is gzipped."""
    with checked_path(path, "a file with a header").open("rb") as file:
        start = file.read(8)
        for magic, name in _PACKED.items():
            if start.startswith(magic):
                found = f"a file compressed with {name}"
                raise FormatError(str(path), found, "a plain or gzipped file", "decompress it first")
        file.seek(0)
        if start[:2] == b"\x1f\x8b":
            return first_bytes(path, file, count)
        return file.read(count)


def nifti_kind(head: bytes) -> str | None:
    """Name the format that the first bytes (at least 352) of a file announce."""
    lengths = {int.from_bytes(head[:4], "little"), int.from_bytes(head[:4], "big")}
    found = lengths & set(_HEADER_BYTES)
    return _HEADER_BYTES[found.pop()] if found else None


def _header(path: Path) -> tuple[Any, str, bool]:
    """The checked header, the format's name and whether the voxels are in a file of their own."""
    from nibabel.nifti1 import Nifti1PairHeader
    from nibabel.nifti2 import Nifti2PairHeader

    head = head_bytes(path, 540)
    kind = nifti_kind(head)
    first = kind == "NIfTI-1"
    magic = (head[344:348] if first else head[4:8])[:3]
    if kind is None or magic not in (b"n+1", b"ni1", b"n+2", b"ni2"):
        found = "an Analyze 7.5 header, which states no space" if kind else "no NIfTI header"
        raise FormatError(str(path), found, "a NIfTI file", "convert it to NIfTI")
    length = 348 if first else 540
    if len(head) < length:
        raise FormatError(
            str(path), f"{len(head)} bytes", f"a header of {length} bytes", "copy the file again"
        )
    # The pair class reads no extensions, whose stated lengths could ask for any amount of memory.
    header: Any = (Nifti1PairHeader if first else Nifti2PairHeader)(head[:length], check=False)
    _require_type(path, header)
    return header, kind, magic[1:2] == b"i"


def _label_names(path: Path, header: Any, end: int) -> dict[int, str]:
    """The names of labels in the extensions of a header, which end before the voxels or with the file."""
    length = int(header["sizeof_hdr"])
    if not has_extensions(head_bytes(path, length + 4), length):
        return {}
    order = "big" if header.endianness == ">" else "little"
    return label_names_in(head_bytes(path, LONGEST), length, end, order)


def _mend(header: Any, notes: list[str]) -> None:
    """Let nibabel mend what it can. What it logs is about numbers of the header, never about its texts."""
    log = logging.Logger("mended")
    log.addHandler(_Notes(notes))
    header.check_fix(logger=log, error_level=40)


class _Notes(logging.Handler):
    """Turns log records into notes."""

    def __init__(self, notes: list[str]) -> None:
        super().__init__(logging.WARNING)
        self.notes = notes

    def emit(self, record: logging.LogRecord) -> None:
        """Keep what is said."""
        if "divisible by 16" not in (text := shown(record.getMessage())):
            self.notes.append(text)


def _require_type(path: Path, header: Any) -> None:
    """Refuse by name the types that nibabel does not know or that are no single number."""
    code = int(header["datatype"])
    if code in _NUMBERS:
        return
    found, mend = _OTHER_TYPES.get(code, (f"voxels of the unknown type {code}", "convert the file"))
    raise FormatError(str(path), found, "one integer or float of up to 64 bits per voxel", mend)


def _offset(path: Path, header: Any, kind: str, single: bool, notes: list[str]) -> int:
    """The first byte of the voxels, which in a single file lie behind the header."""
    offset, least = float(header["vox_offset"]), 352 if kind == "NIfTI-1" else 544
    if single and offset == 0:
        notes.append(f"vox_offset is 0: {least} assumed, where the header ends")
        return least
    if not offset.is_integer() or offset < (least if single else 0):
        expected = f"a whole number from {least}" if single else "a whole number from 0"
        raise FormatError(str(path), f"vox_offset {offset:g}", expected, "copy the file again")
    return int(offset)


def _size(path: Path, header: Any) -> tuple[int, int, int]:
    shape = tuple(int(length) for length in header.get_data_shape())
    if len(shape) > 3 and shape[3] > 1:
        raise FormatError(str(path), f"{shape[3]} time points", "one", "write one time point")
    if any(length != 1 for length in shape[3:]):
        raise FormatError(
            str(path), f"several components per voxel (shape {shape})", "one", "write one component"
        )
    if len(shape) < 3 or min(shape) < 1:
        raise FormatError(str(path), f"shape {shape}", "3 axes, none empty")
    return shape[0], shape[1], shape[2]


def _scaling(path: Path, header: Any) -> tuple[float, float]:
    slope, intercept = float(header["scl_slope"]), float(header["scl_inter"])
    if not np.isfinite(slope) or slope == 0:
        return 1.0, 0.0
    if not np.isfinite(intercept):
        raise FormatError(str(path), f"scl_slope {slope:g} and scl_inter {intercept:g}", "finite numbers")
    return slope, intercept


def _best_affine(path: Path, header: Any) -> npt.NDArray[np.float64]:
    """World (RAS) from index by the sform, shear and all, else by the qform, else as nibabel guesses."""
    try:
        return np.asarray(header.get_best_affine(), dtype=np.float64)
    except ValueError:
        mend = "state an sform"
        raise FormatError(str(path), "a qform that is no rotation", "a unit quaternion", mend) from None


def millimetres(header: Any, notes: list[str]) -> float:
    """Return the millimetres per unit of length that a header states; 1 where it states none."""
    unit = _unit(header)
    if not unit:
        notes.append("the unit of length is not stated: mm assumed")
    elif unit != "mm":
        notes.append(f"lengths are in {unit}s: converted to mm")
    return _MILLIMETRES.get(unit, 1.0)


def _unit(header: Any) -> str:
    """The unit of length that a header states, empty where it states none that is known."""
    try:
        unit = str(header.get_xyzt_units()[0])
    except (AttributeError, KeyError):
        return ""
    return unit if unit in _MILLIMETRES else ""


def states_spacing(header: Any) -> bool:
    """Tell whether lengths in mm are known.

    Those of a placement are mm by convention even where no unit is stated; without either they are bare
    numbers.
    """
    return _is_placed(header) or bool(_unit(header))


def states_orientation(header: Any) -> bool:
    """Tell whether a header places its axes in the patient, and no second time more than 25 degrees apart."""
    if not _is_placed(header):
        return False
    try:
        forms = [header.get_qform(coded=True)[0], header.get_sform(coded=True)[0]]
    except ValueError:  # a qform that is no rotation, beside the sform that is used
        return True
    axes = [form[:3, :3] / np.linalg.norm(form[:3, :3], axis=0) for form in forms if form is not None]
    return len(axes) == 1 or bool(((axes[0] * axes[1]).sum(axis=0) > _SAME_AXIS).all())


def _is_placed(header: Any) -> bool:
    return int(header["sform_code"]) > 0 or int(header["qform_code"]) > 0


def _stated_space(header: Any) -> str:
    if int(header["sform_code"]) > 0:
        return "RAS by sform"
    return "RAS by qform" if int(header["qform_code"]) > 0 else "none stated"


def _note_forms(header: Any, size: tuple[int, int, int], notes: list[str]) -> None:
    """Note a missing placement, or two that contradict each other."""
    by_sform, by_qform = int(header["sform_code"]) > 0, int(header["qform_code"]) > 0
    if not by_sform and not by_qform:
        notes.append(
            "no placement (qform_code = sform_code = 0): centred at the origin, i to the left, like nibabel"
        )
    if by_sform and by_qform:
        try:
            qform = header.get_qform()
        except ValueError:
            notes.append("the qform is no rotation: the sform is used")
            return
        ends = np.array([[i, j, k, 1.0] for i in (0, size[0]) for j in (0, size[1]) for k in (0, size[2])])
        apart = np.abs(ends @ (header.get_sform() - qform).T).max()
        if not apart <= 0.01:
            notes.append(f"sform and qform lie up to {apart:.3g} apart: the sform is used")
