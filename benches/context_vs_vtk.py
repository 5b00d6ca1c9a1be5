"""Time of the context against VTK's CPU ray caster: same volume, view, colours and step.

Both use all cores and alternate; preparation per volume is not counted. Unshaded pictures are equal. Shaded
ones differ: VTK shades voxels and interpolates their light, Lumencut takes the gradient at each sample.

    python benches/context_vs_vtk.py [--runs 7] [--save FOLDER]
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
import numpy.typing as npt
from PIL import Image

from lumencut import Camera, Renderer, Settings, TransferFunction, Volume, Window, phantom

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from vtk_context import Drawing

Picture = npt.NDArray[np.float64]
SIZE = (512, 512)
WINDOW = Window(300.0, 1000.0)
DVR = [
    (80.0, (110, 40, 30), 0.0),
    (250.0, (190, 60, 40), 0.12),
    (450.0, (235, 150, 110), 0.3),
    (800.0, (255, 245, 225), 0.6),
]
GREY = [(-200.0, (0, 0, 0), 0.0), (800.0, (255, 255, 255), 1.0)]
#: Lumencut's context, VTK's blend mode, transfer function, shading; VTK has no MIDA.
MODES = {
    "MIP": ("mip", "mip", GREY, False),
    "DVR": ("dvr", "dvr", DVR, False),
    "DVR, shaded": ("dvr", "dvr", DVR, True),
    "MIDA": ("mida", None, DVR, False),
    "MIDA, shaded": ("mida", None, DVR, True),
}


@dataclass
class Scene:
    """A volume, its step (mm) and a view."""

    name: str
    volume: Volume
    step: float
    camera: Camera


def scenes() -> Iterator[Scene]:
    """The phantom of an aorta, its middle 256³ voxels taken as 0.5 mm, and 256³ voxels of noise.

    Noise is the worst case of a MIP: no block can be skipped.
    """
    whole = phantom.aorta().volume
    middle = tuple(slice((n - 256) // 2, (n + 256) // 2) for n in whole.array.shape)
    crop = Volume(np.ascontiguousarray(whole.array[middle]), spacing=(0.5, 0.5, 0.5))
    plain = Volume(whole.array, spacing=whole.spacing)
    noise = np.random.default_rng(1).normal(100.0, 200.0, crop.array.shape).astype(np.int16)
    volumes = {
        "aorta's middle": (crop, 0.5),
        "aorta": (plain, float(whole.spacing.min())),
        "noise": (Volume(noise, spacing=(0.5, 0.5, 0.5)), 0.5),
    }
    for name, (volume, step) in volumes.items():
        camera = Camera.anterior(volume, SIZE).rotated(0.4).rotated(0.2, "right").zoomed(1.2)
        i, j, k = volume.size
        yield Scene(f"{name}, {i} × {j} × {k}, step {step:g} mm", volume, step, camera)


def milliseconds(work: Callable[[], object]) -> tuple[float, float]:
    """Wall time and CPU time of one call (ms)."""
    start = time.perf_counter(), time.process_time()
    work()
    return (time.perf_counter() - start[0]) * 1e3, (time.process_time() - start[1]) * 1e3


def lumencut_drawing(scene: Scene, mode: str, points: list, shading: bool) -> Callable[[], Picture]:
    """Return a function that renders the context with Lumencut."""
    renderer = Renderer(scene.volume, None)
    settings = Settings(
        context=mode,
        context_transfer=TransferFunction(points),
        context_window=WINDOW,
        # A MIP is exact: it has no step.
        context_step=None if mode == "mip" else scene.step,
        context_shading=shading,
    )

    def draw() -> Picture:
        return renderer.render(scene.camera, settings).context

    return draw


def share_of_hits(picture: Picture) -> str:
    """The share of rays with an opacity of at least half a grey value."""
    return f"{(picture[..., 3] * 255 >= 0.5).mean():.1%}"


def measure(scene: Scene, name: str, runs: int, save: Path | None) -> str:
    """One row of the table."""
    mode, vtk_mode, points, shading = MODES[name]
    draw = lumencut_drawing(scene, mode, points, shading)
    image = draw() / 255.0
    image[..., :3] *= image[..., 3:]
    pictures, times, hits = [image], {"lumencut": [], "vtk": []}, [share_of_hits(image)]
    vtk = None
    if vtk_mode:
        options = {"shading": shading, "threads": os.cpu_count()}
        vtk = Drawing(scene.volume, scene.camera, vtk_mode, points, scene.step, **options)
        pictures.append(vtk.image())
        hits.append(share_of_hits(pictures[1]))
    for _ in range(runs):
        times["lumencut"].append(milliseconds(draw))
        if vtk:
            times["vtk"].append(milliseconds(vtk.render))
    if save:
        side_by_side = np.hstack([255 * picture[..., :3] for picture in pictures])
        path = save / f"{scene.name.split(',')[0]}-{name}.png"
        Image.fromarray(side_by_side.round().astype(np.uint8)).save(path)
    wall, cores = (median(column) for column in zip(*times["lumencut"], strict=True))
    cells = [scene.name, name, f"{wall:.0f}", f"{cores:.0f}"]
    if vtk:
        gap = 255 * np.abs(pictures[0] - pictures[1])[..., :3].mean()
        other = [median(column) for column in zip(*times["vtk"], strict=True)]
        cells += [f"{other[0]:.0f}", f"{other[1]:.0f}", f"{other[0] / wall:.2f}", f"{other[1] / cores:.2f}"]
        cells += [" / ".join(hits), f"{gap:.2f}"]
    else:
        cells += ["–", "–", "–", "–", hits[0], "–"]
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Measure every mode in every scene."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=7, help="number of runs; the median counts")
    parser.add_argument("--save", type=Path, help="folder for the pictures, Lumencut on the left")
    arguments = parser.parse_args()
    print(
        f"{SIZE[0]} × {SIZE[1]} pixels, {os.cpu_count()} cores, {platform.machine()}, {arguments.runs} runs\n"
    )
    columns = ["volume", "mode", "Lumencut (ms)", "CPU time", "VTK (ms)", "CPU time"]
    columns += ["VTK / Lumencut", "CPU time", "visible rays", "mean difference"]
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    for scene in scenes():
        for name in MODES:
            print(measure(scene, name, arguments.runs, arguments.save), flush=True)


if __name__ == "__main__":
    main()
