"""Volumes → OME-Zarr (OME-NGFF 0.5, Zarr 3): the voxels, and coarser levels of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.paths import WRITABLE, checked_path, private_folder
from lumencut.errors import FileError, FormatError
from lumencut.files.ome_zarr.stores import zarr_package
from lumencut.scene.volume import Volume

#: Voxels of a chunk along each axis: 512 kB of 16-bit voxels.
CHUNK = 64
#: No level has fewer voxels along its longest axis.
_COARSEST = 64
#: Axes whose voxels are this much longer than the shortest side are not halved.
_ELONGATED = 1.5
_AXES = ("z", "y", "x")
#: Cosine of the largest angle between an axis of voxels and an axis of the patient.
_ALONG = 1 - 1e-6


def is_zarr_name(path: Path) -> bool:
    """Return whether a name is that of a Zarr folder."""
    return path.name.lower().endswith(".zarr")


def write_ome_zarr(volume: Volume, path: Path) -> int:
    """Write a volume as a pyramid into a new folder; return the number of its levels.

    Each level has half as many voxels along each axis as the one before, the means of its voxels.

    Raises
    ------
    FormatError
        For a grid that is not parallel to the axes of the patient, which OME-NGFF cannot state.
    FileError
        If the folder exists or cannot be written.
    MissingPackageError
        Without the extra [zarr].
    """
    place = checked_path(path, WRITABLE)
    if place.exists():
        raise FileError(str(path), "an existing file or folder", "a new folder", "choose another name")
    of_volume = _along_axes(volume)
    with private_folder(path, place.parent) as folder:
        levels = _write(volume, folder / "whole", *of_volume)
        (folder / "whole").rename(place)
    return levels


def _write(
    volume: Volume, folder: Path, voxels: npt.NDArray[Any], scale: list[float], origin: list[float]
) -> int:
    """Write the levels of voxels [z, y, x] with sides (mm) and the first centre (mm); return their number."""
    zarr = zarr_package()
    group = zarr.open_group(folder, mode="w-", zarr_format=3)
    datasets = []
    number = 0
    while True:
        array = group.create_array(
            str(number), shape=voxels.shape, chunks=tuple(min(CHUNK, n) for n in voxels.shape),
            dtype=voxels.dtype, dimension_names=_AXES,
        )  # fmt: skip
        array[...] = voxels
        datasets.append(_dataset(number, scale, origin))
        if max(voxels.shape) <= _COARSEST:
            break
        steps = [
            2 if n > 1 and s < _ELONGATED * min(scale) else 1
            for n, s in zip(voxels.shape, scale, strict=True)
        ]
        voxels = _coarser(voxels, steps)
        origin = [o + (step - 1) / 2 * s for o, step, s in zip(origin, steps, scale, strict=True)]
        scale = [step * s for step, s in zip(steps, scale, strict=True)]
        number += 1
    group.attrs["ome"] = {"version": "0.5", "multiscales": [_multiscale(volume, datasets)]}
    return number + 1


def _along_axes(volume: Volume) -> tuple[npt.NDArray[Any], list[float], list[float]]:
    """Return the voxels with axes [z, y, x] along those of LPS, their sides and the first centre (mm)."""
    nearest = np.abs(volume.direction).argmax(axis=0)
    cosines = volume.direction[nearest, range(3)]
    if (np.abs(cosines) < _ALONG).any() or len(set(nearest.tolist())) < len(nearest):
        found = f"axes along {volume.direction.round(4).T.tolist()}"
        mend = "resample it to the axes of the patient first"
        raise FormatError("grid of the volume", found, "voxels along the axes of the patient", mend)
    # Axis n of the array [k, j, i] runs along the patient's axis `nearest[2 - n]`.
    order = [2 - int(np.flatnonzero(nearest == axis)[0]) for axis in (2, 1, 0)]
    voxels = volume.array.transpose(order)
    backwards = [n for n, axis in enumerate((2, 1, 0)) if cosines[nearest == axis][0] < 0]
    voxels = np.flip(voxels, tuple(backwards)) if backwards else voxels
    side = [float(volume.spacing[nearest == axis][0]) for axis in (2, 1, 0)]
    # The least corner of all voxel centres is the first one now.
    ends = np.array([[0, 0, 0], np.asarray(volume.size) - 1])
    centers = ends @ volume.world_from_index[:3, :3].T + volume.world_from_index[:3, 3]
    first = centers.min(axis=0)
    return voxels, side, [float(first[axis]) for axis in (2, 1, 0)]


def _coarser(voxels: npt.NDArray[Any], steps: list[int]) -> npt.NDArray[Any]:
    """Return the means of blocks of voxels; the last ones of an odd axis stand for a pair of themselves."""
    sums: npt.NDArray[np.floating] = voxels.astype(np.float32 if voxels.itemsize <= 4 else np.float64)
    for axis, step in enumerate(steps):
        if step == 1:
            continue
        if sums.shape[axis] % 2:
            sums = np.concatenate([sums, sums.take([-1], axis)], axis)
        even, odd = (
            sums[tuple(slice(s, None, 2) if n == axis else slice(None) for n in range(3))] for s in (0, 1)
        )
        sums = (even + odd) / 2
    return (np.rint(sums) if voxels.dtype.kind in "iu" else sums).astype(voxels.dtype)


def _dataset(number: int, scale: list[float], origin: list[float]) -> dict[str, Any]:
    steps = [{"type": "scale", "scale": scale}, {"type": "translation", "translation": origin}]
    return {"path": str(number), "coordinateTransformations": steps}


def _multiscale(volume: Volume, datasets: list[dict[str, Any]]) -> dict[str, Any]:
    unit = {"unit": "millimeter"} if volume.states_spacing else {}
    axes = [{"name": name, "type": "space", **unit} for name in _AXES]
    return {"axes": axes, "datasets": datasets, "type": "mean"}
