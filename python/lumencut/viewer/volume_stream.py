"""The stream of a volume for the page: a header, then the voxels as bytes.

The stream is the magic ``LCVOLUME``, the length of the JSON (uint32, little-endian), the JSON, padded with
spaces so that the voxels begin at a multiple of 16 bytes, and the voxels, little-endian, i fastest, then j,
then k.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.foreign_errors import printable
from lumencut.base.rescale import slabs
from lumencut.scene.scan_details import ScanDetails
from lumencut.scene.volume_file import VolumeFile

MEDIA_TYPE = "application/vnd.lumencut.volume"

_MAGIC = b"LCVOLUME"
_ALIGNMENT = 16
_PIECE = 1 << 20
_SENT_AS_THEY_ARE = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64")


def sent_type(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """Return the type of sent voxels: their own type, or float32."""
    return np.dtype(dtype.name if dtype.name in _SENT_AS_THEY_ARE else np.float32).newbyteorder("<")


def header(file: VolumeFile, read_type: np.dtype[Any]) -> bytes:
    """Return the bytes before the voxels of a file with this type of voxels."""
    sent = sent_type(read_type)
    notes: Sequence[str] = file.notes
    if sent.name != read_type.name:
        notes = [*notes, f"voxels of type {read_type.name} are shown as {sent.name}"]
    header = {
        "version": 1,
        "name": printable(file.path.resolve().name),
        "size": list(file.size),
        "dtype": sent.name,
        "world_from_index": file.world_from_index.tolist(),
        "states_spacing": file.states_spacing,
        "states_orientation": file.states_orientation,
        "filled_slices": list(file.filled),
        "has_study": file.study is not None,
        "identity": _identity(file),
        "scan": _scan_record(file.scan),
        "notes": list(notes),
    }
    text = json.dumps(header, allow_nan=False).encode()
    before = len(_MAGIC) + 4
    text += b" " * (-(before + len(text)) % _ALIGNMENT)
    return _MAGIC + len(text).to_bytes(4, "little") + text


def _identity(file: VolumeFile) -> dict[str, str]:
    """Patient and modality, by which the page compares the scan with another one."""
    modality = "" if file.study is None else file.study.text("Modality")
    return {"patient": file.patient.id, "issuer": file.patient.issuer, "modality": modality}


def _scan_record(scan: ScanDetails) -> dict[str, Any]:
    """Acquisition details of a scan, by the names of the engine."""
    details = asdict(scan)
    thickness = details.pop("slice_thickness")
    return {**details, "slice_thickness_mm": thickness}


def length(file: VolumeFile, read_type: np.dtype[Any]) -> int:
    """Return the number of bytes of voxels after the header."""
    ni, nj, nk = file.size
    return ni * nj * nk * sent_type(read_type).itemsize


def pieces(voxels: npt.NDArray[Any]) -> Iterator[memoryview]:
    """Yield voxels [k, j, i] as bytes, piece by piece, without a second copy in memory."""
    sent = sent_type(voxels.dtype)
    for slab in slabs(voxels):
        with np.errstate(over="ignore"):
            data = np.ascontiguousarray(slab, sent).reshape(-1).view(np.uint8).data
        for start in range(0, len(data), _PIECE):
            yield data[start : start + _PIECE]
