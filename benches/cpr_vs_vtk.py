"""Time of CPR: against vtkProbeFilter on the same points, and while turning around the vessel.

Both use all cores and alternate in batches; preparation per volume and vessel is not counted.

    python benches/cpr_vs_vtk.py [--runs 15]
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter

from lumencut import Reformation, Settings, Vessel, Volume, Window, cpr, phantom

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from vtk_context import image_data

BATCHES = 3
SETTINGS = Settings(window=Window(300, 900))


def milliseconds(work: Callable[[], object]) -> float:
    """Wall time of one call."""
    start = time.perf_counter()
    work()
    return (time.perf_counter() - start) * 1e3


def straightened(volume: Volume, vessel: Vessel, columns: int, rows: int) -> Reformation:
    """A straightened CPR of this size, within a pixel."""
    length = vessel.length
    spacing = length / (rows - 0.5)
    return cpr(volume, vessel, "straightened", (columns - 0.5) * spacing, spacing, settings=SETTINGS)


def probe(volume: Volume, points: np.ndarray) -> Callable[[], tuple[np.ndarray, np.ndarray]]:
    """Return a function that samples the volume at `points` with VTK."""
    source = image_data(volume)

    def sample() -> tuple[np.ndarray, np.ndarray]:
        data, positions = vtkPolyData(), vtkPoints()
        positions.SetData(numpy_to_vtk(points.reshape(-1, 3)))
        data.SetPoints(positions)
        filter_ = vtkProbeFilter()
        filter_.SetInputData(data)
        filter_.SetSourceData(source)
        filter_.Update()
        found = filter_.GetOutput().GetPointData()
        return vtk_to_numpy(found.GetScalars()), vtk_to_numpy(found.GetArray("vtkValidPointMask"))

    return sample


def against_vtk(volume: Volume, vessel: Vessel, runs: int) -> str:
    """A row: positions and values of 301 × 512 samples with Lumencut, values at these positions with VTK."""
    made = straightened(volume, vessel, 301, 512)
    sample = probe(volume, np.ascontiguousarray(made.position))
    lumencut, vtk = [], []
    for _ in range(BATCHES):
        lumencut += [milliseconds(lambda: made.rotated(0.0).value) for _ in range(runs)]
        vtk += [milliseconds(sample) for _ in range(runs)]
    found, is_valid = (array.reshape(made.value.shape) for array in sample())
    gap = np.abs(found - made.value)[is_valid == 1].max()
    width, height = made.size
    cells = [f"{width} × {height}", f"{median(lumencut):.2f}", f"{median(vtk):.2f}"]
    return "| " + " | ".join([*cells, f"{median(vtk) / median(lumencut):.1f}", f"{gap:.2g}"]) + " |"


def turning(volume: Volume, vessel: Vessel, size: tuple[int, int], runs: int, device: str) -> str:
    """A row: pictures while turning around the vessel."""
    spacing = vessel.length / (size[1] - 0.5)
    width = (size[0] - 0.5) * spacing
    made = cpr(volume, vessel, "straightened", width, spacing, settings=SETTINGS, device=device)
    _ = made.image
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        made = made.rotated(degrees=3)
        _ = made.image
        times.append((time.perf_counter() - start) * 1e3)
    stages = ", ".join(f"{name} {value:.1f}" for name, value in made.timings.items())
    cells = [
        device,
        f"{made.size[0]} × {made.size[1]}",
        f"{median(times):.1f}",
        f"{1e3 / median(times):.0f}",
        stages,
    ]
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=15, help="runs in a row; the median counts")
    parser.add_argument("--devices", default="cpu", help="devices for turning, separated by commas")
    arguments = parser.parse_args()
    made = phantom.aorta()
    volume = Volume(made.volume.array, spacing=made.volume.spacing, origin=made.volume.origin)
    vessel = max(made.tree, key=lambda one: one.length)
    cores = f"{os.cpu_count()} cores, {platform.machine()}, {arguments.runs} runs"
    print(f"{volume.size} voxels, a vessel of {vessel.length:.0f} mm, {cores}\n")
    print(
        "| samples | Lumencut (ms) | vtkProbeFilter (ms) | VTK / Lumencut | largest difference |\n|"
        + "---|" * 5
    )
    print(against_vtk(volume, vessel, arguments.runs), flush=True)
    print("\n| device | size | time (ms) | pictures per second | stages of the last (ms) |\n|" + "---|" * 5)
    for device in arguments.devices.split(","):
        for size in ((301, 512), (512, 1024)):
            print(turning(volume, vessel, size, arguments.runs, device), flush=True)


if __name__ == "__main__":
    main()
