"""Volumes as NRRD and NIfTI files."""

from __future__ import annotations

import gzip
import os
from pathlib import Path
from typing import Any

import numpy as np

from lumencut._files import WRITABLE, checked_path, replace_whole
from lumencut.errors import FormatError
from lumencut.volume import Volume

#: Axes of NIfTI run to the right and the front (RAS), those of volumes to the left and the back (LPS).
_RAS_FROM_LPS = np.diag([-1.0, -1.0, 1.0, 1.0])
#: The fastest level of gzip. The highest one takes six times as long and saves 0.5 % of a noisy scan.
_FAST = 1


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
    name = path.name.lower()
    if name.endswith(".nrrd"):
        replace_whole(path, lambda whole: _write_nrrd(volume, whole, mark))
    elif name.endswith((".nii", ".nii.gz")):
        replace_whole(path, lambda whole: _write_nifti(volume, whole, mark, is_packed=name.endswith(".gz")))
    else:
        raise FormatError(str(path), f"the extension {path.suffix!r}", ".nrrd, .nii or .nii.gz")


def _write_nrrd(volume: Volume, whole: Path, mark: str) -> None:
    import nrrd

    header: dict[str, Any] = {
        **({"content": mark} if mark else {}),
        "space": "left-posterior-superior",
        "space directions": volume.world_from_index[:3, :3].T,
        "space origin": volume.world_from_index[:3, 3],
        "kinds": ["domain"] * 3,
    }
    with whole.open("wb") as file:
        nrrd.write(file, volume.array.T, header, index_order="F", compression_level=_FAST)


def _write_nifti(volume: Volume, whole: Path, mark: str, *, is_packed: bool) -> None:
    from nibabel import nifti1

    # Its functions state no types.
    library: Any = nifti1
    image = library.Nifti1Image(volume.array.T, _RAS_FROM_LPS @ volume.world_from_index)
    image.header.set_xyzt_units("mm")
    image.header["descrip"] = mark.encode()
    content = image.to_bytes()
    whole.write_bytes(gzip.compress(content, _FAST) if is_packed else content)
