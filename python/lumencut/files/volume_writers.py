"""Volumes as NRRD and NIfTI files."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from lumencut import _lumencut
from lumencut.base.file_kinds import written_kind
from lumencut.base.paths import WRITABLE, checked_path, replace_whole
from lumencut.base.rescale import slabs
from lumencut.errors import FormatError
from lumencut.scene.volume import Volume

#: Types of numbers that both formats have; others become float32.
_NUMBERS = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64")


def write_volume(volume: Volume, path: str | os.PathLike[str], mark: str = "") -> None:
    """Write a volume as ``.nrrd``, ``.nii`` or ``.nii.gz``; the file appears only when complete.

    Parameters
    ----------
    volume : Volume
        The volume.
    path : path-like
        The file.
    mark : str, default ""
        A short text (at most 79 letters of ASCII) on what the file holds, for the field of its header.

    Raises
    ------
    FormatError
        For another extension.
    FileError
        If the file cannot be written.
    """
    path = checked_path(path, WRITABLE)
    kind = written_kind(path, "volume")
    if kind is None:
        raise FormatError(str(path), f"the extension {path.suffix!r}", _lumencut.WRITTEN_VOLUMES)
    is_nrrd = kind == "nrrd"
    header = "nrrd.gz" if is_nrrd else kind
    is_packed = is_nrrd or path.name.lower().endswith(".gz")
    replace_whole(path, lambda whole: _write(volume, whole, header, mark, is_packed=is_packed))


def _write(volume: Volume, whole: Path, kind: str, mark: str, *, is_packed: bool) -> None:
    """Write the header of a kind, and the voxels in slabs; NRRD packs the voxels alone."""
    array = volume.array
    name = array.dtype.name if array.dtype.name in _NUMBERS else "float32"
    rows = volume.world_from_index[:3].tolist()
    header = _lumencut.volume_header(kind, volume.size, rows, name, mark)
    packer = _lumencut.GzipPacker() if is_packed else None
    with whole.open("wb") as file:
        file.write(packer.pack(header) if packer and not kind.startswith("nrrd") else header)
        for slab in slabs(array):
            content = np.ascontiguousarray(slab, np.dtype(name)).tobytes()
            file.write(packer.pack(content) if packer else content)
        if packer:
            file.write(packer.end())
