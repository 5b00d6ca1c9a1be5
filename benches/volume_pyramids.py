"""Views and lines of a scan larger than memory: ``python benches/volume_pyramids.py FOLDER [VOXELS]``.

A helix of contrast in VOXELS³ voxels (4096 by default) of 0.01 mm; only chunks with contrast are stored.
FOLDER keeps the image for the next run.
"""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import zarr

from lumencut import (
    Camera,
    Renderer,
    Settings,
    Vessel,
    VesselTree,
    Window,
    cpr,
    read_volume,
    set_threads,
    trace,
)

SIDE = 0.01
CHUNK = 64
#: Radius of the vessel and of the helix, and number of its turns, as shares of the volume.
RADIUS, HELIX, TURNS = 0.011, 0.29, 1.4
BRIGHT = 400
WINDOW = Window(200, 600)


def centerline(count: int, points: int) -> npt.NDArray[np.float64]:
    """Return points (x, y, z) of the helix in voxels of the finest level."""
    way = np.linspace(0.05, 0.95, points)
    angle = 2 * np.pi * TURNS * way
    return count * np.stack([0.5 + HELIX * np.cos(angle), 0.5 + HELIX * np.sin(angle), way], axis=1)


def voxels(count: int, low: npt.NDArray[np.int64], high: npt.NDArray[np.int64], level: int) -> Any:
    """Return the voxels of a box of a level: horizontal disks around the helix."""
    z, y, x = (
        ((np.arange(a, b) + 0.5) * 2**level - 0.5).reshape([-1 if n == axis else 1 for n in range(3)])
        for axis, (a, b) in enumerate(zip(low, high, strict=True))
    )
    angle = 2 * np.pi * TURNS * z / count
    distance = np.hypot(x - count * (0.5 + HELIX * np.cos(angle)), y - count * (0.5 + HELIX * np.sin(angle)))
    share = np.clip((count * RADIUS - distance) / 2**level + 0.5, 0, 1)
    return (BRIGHT * share * ((z > 0.05 * count) & (z < 0.95 * count))).astype(np.int16)


def write(folder: Path, count: int) -> None:
    """Write the image; chunks without contrast are left out."""
    group, datasets, level = zarr.open_group(folder, mode="w", zarr_format=3), [], 0
    steps = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3), axis=-1).reshape(-1, 3) * count * RADIUS
    near = (centerline(count, 8000)[:, None, ::-1] + steps).reshape(-1, 3)
    while count >> level >= CHUNK:
        size = (count >> level,) * 3
        array = group.create_array(str(level), shape=size, chunks=(CHUNK,) * 3, dtype="int16", fill_value=0)
        for chunk in np.unique((near // (CHUNK << level)).astype(np.int64), axis=0):
            low = chunk * CHUNK
            if (
                (chunk >= 0).all()
                and (low < size).all()
                and (box := voxels(count, low, low + CHUNK, level)).any()
            ):
                array[tuple(slice(a, a + CHUNK) for a in low)] = box
        scale, shift = [SIDE * 2**level] * 3, [SIDE * (2**level - 1) / 2] * 3
        grid = [{"type": "scale", "scale": scale}, {"type": "translation", "translation": shift}]
        datasets.append({"path": str(level), "coordinateTransformations": grid})
        level += 1
    axes = [{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"]
    group.attrs["ome"] = {"version": "0.5", "multiscales": [{"axes": axes, "datasets": datasets}]}


def main(folder: Path, count: int) -> None:
    """Print the time, the voxels read and the memory of each step."""
    set_threads(2)
    if not folder.exists():
        write(folder, count)
    print("| step | time (s) | read (MB) | most memory (MB) |\n|---|---|---|---|")
    start = time.perf_counter()
    scan = read_volume(folder)
    points = centerline(count, 2000) * SIDE
    renderer = Renderer(scan, VesselTree([Vessel(points, count * RADIUS * SIDE)]), "cpu")

    def row(step: str, make: Callable[[], Any], begun: float | None = None) -> None:
        begun, before = begun or time.perf_counter(), scan.bytes_read
        make()
        taken, most = time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
        print(f"| {step} | {taken:.2f} | {(scan.bytes_read - before) / 1e6:.0f} | {most:.0f} |")

    whole = Camera.anterior(renderer.scene, (512, 512))
    close = Camera(points[1000], whole.direction, whole.up, (512, 512), SIDE)
    cut = Settings(context=None, window=WINDOW)
    row("open, and the first view of all", lambda: renderer.render(whole), start)
    row("the next view", lambda: renderer.render(whole.rotated(0.1)))
    row("the cut at the finest level", lambda: renderer.render(close, cut))
    row("the same, turned by 6°", lambda: renderer.render(close.rotated(0.1), cut))
    row("the same with MIDA", lambda: renderer.render(close))
    row("a line between two clicks 100 points apart", lambda: trace(scan, points[[1000, 1100]]))
    vessel = Vessel(points[950:1150], count * RADIUS * SIDE)
    row(
        "straightened CPR at the finest level", lambda: cpr(scan, vessel, width=2.0, pixel_spacing=SIDE).image
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 4096)
