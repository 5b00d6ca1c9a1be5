"""OME-Zarr images for tests, written by zarr alone."""

from __future__ import annotations

from typing import Any

import numpy.typing as npt
import zarr


def write_image(
    folder: Any,
    levels: list[npt.NDArray[Any]],
    *,
    version: str = "0.5",
    axes: str = "zyx",
    unit: str | None = "millimeter",
    scale: tuple[float, float, float] = (2.0, 1.0, 0.5),
    chunks: int = 16,
    changes: dict[str, Any] | None = None,
) -> None:
    """Write arrays as levels that halve z, y and x; `scale` is that of level 0 along z, y and x."""
    group = zarr.open_group(folder, mode="w", zarr_format=2 if version == "0.4" else 3)
    datasets = []
    for number, voxels in enumerate(levels):
        sizes = [min(chunks, n) if axis in "zyx" else 1 for axis, n in zip(axes, voxels.shape, strict=True)]
        array = group.create_array(str(number), shape=voxels.shape, chunks=tuple(sizes), dtype=voxels.dtype)
        array[...] = voxels
        of_axis = {name: side * 2**number for name, side in zip("zyx", scale, strict=True)}
        shift = {name: (2**number - 1) / 2 * side for name, side in zip("zyx", scale, strict=True)}
        steps = [
            {"type": "scale", "scale": [of_axis.get(axis, 1.0) for axis in axes]},
            {"type": "translation", "translation": [shift.get(axis, 0.0) for axis in axes]},
        ]
        datasets.append({"path": str(number), "coordinateTransformations": steps})
    kinds = {"c": "channel", "t": "time"}
    stated = [
        {"name": axis, "type": kinds.get(axis, "space")} | ({"unit": unit} if unit and axis in "zyx" else {})
        for axis in axes
    ]
    image: dict[str, Any] = {"axes": stated, "datasets": datasets, **(changes or {})}
    if version == "0.4":
        group.attrs["multiscales"] = [{"version": version, **image}]
    else:
        group.attrs["ome"] = {"version": version, "multiscales": [image]}


def halved(voxels: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return the means of blocks of 2 × 2 × 2 voxels of even sizes."""
    nk, nj, ni = (n // 2 for n in voxels.shape)
    means = voxels.reshape(nk, 2, nj, 2, ni, 2).mean(axis=(1, 3, 5))
    return means.round().astype(voxels.dtype)
